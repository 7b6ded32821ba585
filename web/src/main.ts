// The page: brings together what is watched and what is taught.

import "./style.css";
import { ErrorChart, OutcomeMap, Strip, modeTable } from "./charts";
import { Connection } from "./connection";
import { announce, byId, freshName, make, percent, short } from "./dom";
import { keep, kept, pageName } from "./keep";
import { Movement, Player } from "./player";
import { FromServer, Outcomes, Recalled, RunFacts, Welcome } from "./protocol";
import { SceneFacts, Stage } from "./stage";
import { Teaching } from "./teach";

const person = byId<HTMLInputElement>("person");
person.value = kept("person", "");

const stage = new Stage(byId("stage"));
const player = new Player(stage, () => void (teaching && stage.pose(resting())));
const errors = new ErrorChart(byId("error-chart"));
const map = new OutcomeMap(byId<HTMLCanvasElement>("map"));
const strip = new Strip(byId<HTMLCanvasElement>("strip"), byId("strip-legend"));

const runs = new Map<number, RunFacts>();
const outcomes = new Map<string, number[][]>();
let shownRun = 0;
let shownKind = "";
let welcome: Welcome | null = null;
let teaching: Teaching | null = null;
let mine = false;
let latest: number[][] = [];

const connection = new Connection(
  pageName(freshName),
  () => person.value || "somebody",
  hear,
  (open, words) => {
    byId("link").dataset.state = open ? "on" : "off";
    byId("link").textContent = words;
    if (!open) {
      mine = false;
      teaching?.lost();
    }
  },
);

function hear(message: FromServer): void {
  switch (message.what) {
    case "welcome":
      return begin(message);
    case "role":
      return role(message.mine, message.holder, message.pages);
    case "runfacts":
      runs.set(message.run, message);
      return showRuns();
    case "outcomes":
      return collect(message);
    case "recalled":
      return recalled(message);
    case "refused":
      return announce(message.words);
    case "pose":
      latest = message.points;
  }
  teaching?.hear(message);
}

function begin(message: Welcome): void {
  welcome = message;
  if (message.scene) stage.show(message.scene as unknown as SceneFacts);
  byId("stage-card").hidden = !message.scene;
  const planes = byId<HTMLSelectElement>("plane");
  const offered = (message.scene as unknown as SceneFacts | null)?.planes ?? [];
  if (!planes.options.length)
    for (const plane of offered) planes.append(make("option", { value: plane }, plane));
  planes.parentElement!.hidden = offered.length < 2;
  document.body.classList.toggle("teaches", message.teaches);
  byId("tab-teach").hidden = !message.teaches;
  if (message.teaches && !teaching) {
    teaching = new Teaching(stage, player, message, (one) => connection.send(one), (asked) => {
      map.request = asked?.goal ?? null;
      if (asked?.goal) showKind(asked.goal.kind);
      map.draw();
    });
    view("teach");
  } else if (!teaching) view("watch");
  if (message.teaches) connection.send({ what: "control", take: true });
}

function role(isMine: boolean, holder: string, pages: number): void {
  const button = byId<HTMLButtonElement>("control");
  button.textContent = isMine ? "Give up control" : holder ? `${holder} is teaching` : "Take control";
  button.disabled = !isMine && holder !== "";
  byId("link").textContent = pages > 1 ? `connected, ${pages} pages` : "connected";
  document.body.classList.toggle("mine", isMine);
  if (isMine && !mine) teaching?.begin();
  mine = isMine;
}

// Watching.

function view(name: string): void {
  document.body.dataset.view = name;
  for (const tab of document.querySelectorAll<HTMLElement>("[role=tab]"))
    tab.setAttribute("aria-selected", String(tab.dataset.view === name));
  if (name === "watch") byId<HTMLInputElement>("suggest").checked = false;
}

function showRuns(): void {
  const list = byId("runs");
  if (runs.size > 1)
    list.replaceChildren(
      ...[...runs.values()].map((run) => {
        const chip = make("button", { "aria-pressed": String(run.run === shownRun) }, run.title);
        chip.onclick = () => {
          shownRun = run.run;
          showRuns();
        };
        return chip;
      }),
    );
  const run = runs.get(shownRun);
  if (!run) return;
  const done = run.target ? `${short(run.movements)} of ${short(run.target)} movements` : `${short(run.movements)} movements`;
  byId("title").textContent = `${run.title} · ${done}${run.finished ? ", finished" : ""}`;
  document.title = `sgim: ${run.title}`;
  if (run.problem) announce(run.problem);
  byId("error-unit").textContent = run.unit ? `in ${run.unit}` : "";
  if (run.evaluations.length) errors.show(run);
  byId("error-chart").classList.toggle("empty", !run.evaluations.length);
  strip.show(run);
  modeTable(byId("modes"), run);
  requestsLine(run);
  if (!run.kinds.some((kind) => kind.kind === shownKind)) showKind(run.kinds[0]?.kind ?? "");
  else showKind(shownKind);
}

function requestsLine(run: RunFacts): void {
  const { asked, answered, declined, expired, unasked } = run.requests;
  const parts = [
    asked && `asked ${asked} times`,
    answered && `answered ${answered}`,
    declined && `declined ${declined}`,
    expired && `not answered ${expired}`,
    unasked && `shown unasked ${unasked}`,
    run.seconds && `${short(Math.round(run.seconds))} s of your time`,
  ];
  byId("requests-line").textContent = parts.filter(Boolean).join(" · ");
}

function showKind(name: string): void {
  shownKind = name;
  const run = runs.get(shownRun);
  if (!run) return;
  byId("kinds").replaceChildren(
    ...(run.kinds.length > 1 ? run.kinds : []).map((kind) => {
      const chip = make("button", { "aria-pressed": String(kind.kind === name) }, kind.kind);
      chip.onclick = () => showKind(kind.kind);
      return chip;
    }),
  );
  map.kind = run.kinds.find((kind) => kind.kind === name) ?? null;
  map.points = outcomes.get(`${shownRun}/${name}`) ?? [];
  map.show(run);
  const legend = [
    "dots: reached, dark early, bright late",
    run.regions.length ? "shades: where it expects to gain" : "",
    run.shown.length ? "diamonds: demonstrations" : "",
    "crosses: latest goals",
  ];
  byId("map-legend").textContent = legend.filter(Boolean).join(" · ");
}

function collect(message: Outcomes): void {
  const key = `${message.run}/${message.kind}`;
  outcomes.set(key, message.afresh ? message.points : [...(outcomes.get(key) ?? []), ...message.points]);
  if (message.run === shownRun && message.kind === shownKind) {
    map.points = outcomes.get(key)!;
    map.draw();
  }
}

byId("map").onclick = (event) => {
  const point = map.at(event.clientX, event.clientY);
  if (!point || !map.kind) return;
  const goal = { kind: map.kind.kind, point };
  if (byId<HTMLInputElement>("suggest").checked) {
    connection.send({ what: "suggest", id: freshName(), ...goal });
    announce(`Suggested ${goal.kind} (${point.map(short).join(", ")}).`);
    return;
  }
  map.picked = goal;
  map.reached = null;
  map.draw();
  connection.send({ what: "recall", run: shownRun, ...goal });
};

function recalled(message: Recalled): void {
  if (message.problem) {
    byId("recalled").textContent = message.problem;
    return;
  }
  const expected = message.expected.map(short).join(", ");
  byId("recalled").textContent =
    `Best known: ${message.goal.kind} (${expected}), off by ${percent(message.error ?? 0)}.`;
  map.reached = message.expected;
  map.draw();
  const movement = message.movement as unknown as Movement | null;
  if (!movement || (teaching && teaching.state !== "practice")) return;
  if (!teaching?.asked_) stage.aim(message.shapes);
  player.load(movement, null, ["best known movement"]);
  player.play();
}

function resting(): number[][] {
  return latest;
}

// Pointer and keys.

const canvas = byId("stage");
let orbiting: PointerEvent | null = null;

canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  if (teaching && mine && document.body.dataset.view === "teach") {
    player.leave();
    if (teaching.hand.grasp(event)) {
      event.preventDefault();
      return;
    }
  }
  if (!stage.flat) orbiting = event;
});
canvas.addEventListener("pointermove", (event) => {
  if (teaching?.hand.dragging) teaching.hand.drag(event);
  else if (orbiting && event.pointerId === orbiting.pointerId) {
    stage.turn((event.clientX - orbiting.clientX) / 150, (event.clientY - orbiting.clientY) / 150);
    orbiting = event;
  } else if (teaching && mine) canvas.classList.toggle("near", stage.grasps(event.clientX, event.clientY));
});
for (const name of ["pointerup", "pointercancel"])
  canvas.addEventListener(name, () => {
    if (teaching?.hand.dragging) {
      teaching.hand.release();
      teaching.released();
    }
    orbiting = null;
  });
canvas.addEventListener(
  "wheel",
  (event) => {
    if (stage.flat) return;
    event.preventDefault();
    stage.turn(0, 0, Math.exp(-event.deltaY / 600));
  },
  { passive: false },
);
byId("view-reset").onclick = () => stage.lookAgain();

for (const tab of document.querySelectorAll<HTMLElement>("[role=tab]"))
  tab.onclick = () => view(tab.dataset.view ?? "watch");

byId("control").onclick = () => connection.send({ what: "control", take: !mine });
person.onchange = () => {
  keep("person", person.value);
  connection.hello();
};

const actions: Record<string, () => void> = {
  " ": () => teaching?.record(),
  arrowright: () => teaching?.accept(),
  arrowleft: () => teaching?.redo(),
  escape: () => teaching?.stop(),
  r: () => teaching?.replay(),
  h: () => teaching?.home(),
  n: () => teaching?.skip(),
  x: () => teaching?.decline(),
  u: () => teaching?.undo(),
  p: () => {
    const planes = byId<HTMLSelectElement>("plane");
    planes.selectedIndex = (planes.selectedIndex + 1) % Math.max(1, planes.options.length);
    announce(`Dragging in the plane: ${planes.value}.`);
  },
};

window.addEventListener("keydown", (event) => {
  const target = event.target as HTMLElement;
  const key = event.key.toLowerCase();
  if (key === "z" && (event.ctrlKey || event.metaKey)) {
    if (target.tagName !== "INPUT") teaching?.undo();
    return;
  }
  if (event.ctrlKey || event.metaKey || event.altKey || !teaching) return;
  if (key !== "escape" && ["INPUT", "SELECT", "TEXTAREA"].includes(target.tagName)) return;
  if (target.tagName === "BUTTON" && (key === " " || key === "enter")) return;
  if (mine && teaching.hand.press(key)) {
    player.leave();
    event.preventDefault();
  } else if (key in actions && !event.repeat) {
    event.preventDefault();
    actions[key]();
  }
});
window.addEventListener("keyup", (event) => teaching?.hand.lift(event.key.toLowerCase()));
window.addEventListener("blur", () => {
  for (const key of ["w", "a", "s", "d", "arrowup", "arrowdown"]) teaching?.hand.lift(key);
});

// For tests, to read only: where the tip is in the page, and what the page is doing.
Object.defineProperty(window, "sgim", {
  value: Object.freeze({
    tip: () => (stage.handle ? stage.pixel(stage.handle) : null),
    pixel: (x: number, y: number, z: number) => stage.pixel([x, y, z]),
    state: () => teaching?.state ?? "watching",
    joints: () => [...(teaching?.hand.joints ?? [])],
    control: () => mine,
    drawn: () => stage.drawn,
    version: () => welcome?.version ?? null,
  }),
});
