// Teaching: practise, record, trim, look at it again, give it to the learner.

import { announce, byId, freshName, make, percent, short } from "./dom";
import { Hand } from "./hand";
import { keep, kept } from "./keep";
import { Letters } from "./letters";
import { Library } from "./library";
import { Movement, Player } from "./player";
import { Asked, Assessed, FromPage, FromServer, Pose, Welcome } from "./protocol";
import { Requests } from "./requests";
import { SceneFacts, Stage } from "./stage";
import { drawCurves } from "./charts";
import { Take, assess, duration, tidied } from "./take";

type State = "practice" | "countdown" | "recording" | "settling" | "assessing" | "assessed";

const LONGEST_RECORDING = 30; // seconds
const COUNT = 600; // milliseconds for each of 3, 2, 1
const SPEEDS = [1, 1.25, 1.5, 2, 3, 4, 6];

export class Teaching {
  state: State = "practice";
  readonly hand: Hand;
  private readonly letters: Letters;
  private readonly requests: Requests;
  private readonly library: Library;
  private take: Take | null = null;
  private worth: Assessed | null = null;
  private undos: (() => void)[] = [];
  private began = 0;
  private workBegan = 0;
  private saved = 0;
  private connected = true;
  private counting = 0;
  private timer = 0;

  constructor(
    private readonly stage: Stage,
    private readonly player: Player,
    private readonly welcome: Welcome,
    private readonly send: (message: FromPage) => boolean,
    private readonly asking: (asked: Asked | null) => void,
  ) {
    const plane = () => byId<HTMLSelectElement>("plane").value || "level";
    this.hand = new Hand(stage, welcome, plane, send, () => this.busy, (pose) => this.posed(pose));
    this.letters = new Letters(send);
    const atWork = () => this.take !== null || this.state !== "practice";
    this.requests = new Requests(send, this.letters, atWork, (asked) => this.asked(asked));
    this.library = new Library(send, (take) => this.adopt(take), (undo) => this.undoable(undo));
    this.bind();
    const scene = welcome.scene as unknown as SceneFacts | null;
    byId<HTMLSelectElement>("tempo").value = String(scene?.tempo ?? 1);
    this.hand.pass(scene?.tempo ?? 1);
    this.joints();
    const draft = kept<Take | null>("draft", null);
    if (draft) {
      announce("A take from before was found. It was not given to the learner.");
      this.adopt(draft);
    }
    this.draw();
  }

  get asked_(): Asked | null {
    return this.requests.asked;
  }

  private get busy(): boolean {
    return this.state === "recording" || this.state === "settling";
  }

  /** In control, perhaps again: go on where the connection was lost. */
  begin(): void {
    this.connected = true;
    const halfway = this.busy;
    this.send({ what: "reset", joints: halfway ? this.hand.joints : null });
    this.letters.again();
    if (halfway) {
      this.hand.again();
      announce("Connected again: the recording goes on.");
    } else {
      this.hand.begin(this.welcome.joints.map((joint) => joint.home));
      if (this.take) this.judge(this.take);
    }
  }

  lost(): void {
    this.connected = false;
    this.hand.wait();
    if (this.busy) announce("The connection is lost. Go on: what you draw is kept.");
  }

  hear(message: FromServer): void {
    if (message.what === "pose") this.hand.hear(message);
    else if (message.what === "assessed") this.assessed(message);
    else if (message.what === "desk") this.requests.hear(message);
    else if (message.what === "said") {
      const words = this.letters.hear(message);
      if (words) announce(words[0].toUpperCase() + words.slice(1));
    } else if (message.what === "exported") this.library.exported(message.text);
    else if (message.what === "imported") {
      this.library.imported(message);
      announce(`${message.takes.length} demonstrations of ${message.teacher} came from the file.`);
    }
  }

  // Recording.

  record(): void {
    if (this.state === "recording") return this.stop();
    if (this.state === "countdown" || this.state === "settling") return;
    this.setAside();
    this.player.leave();
    this.player.load(null, null, []);
    this.state = "countdown";
    this.workBegan ||= performance.now();
    this.home();
    let left = 3;
    const count = () => {
      if (this.state !== "countdown") return;
      byId("countdown").hidden = left === 0;
      byId("countdown").textContent = String(left);
      if (left === 0) return this.start();
      left -= 1;
      this.counting = window.setTimeout(count, COUNT);
    };
    announce("Get ready.");
    count();
    this.draw();
  }

  private start(): void {
    this.state = "recording";
    this.began = this.hand.time();
    this.hand.begin(this.welcome.joints.map((joint) => joint.home));
    this.timer = window.setInterval(() => this.watchRecording(), 200);
    announce("Recording: lead the arm, then stop.");
    this.draw();
  }

  private watchRecording(): void {
    const now = this.hand.time();
    byId("badge").textContent = `● ${(now - this.began).toFixed(1)} s`;
    if (performance.now() - this.saved > 500) {
      this.saved = performance.now();
      keep("draft", this.made());
    }
    if (this.state === "recording" && now - this.began > LONGEST_RECORDING) this.stop();
    if (this.state === "settling" && this.hand.settled) this.finish();
  }

  /** Stop recording, or the countdown, or the replay. */
  stop(): void {
    if (this.state === "countdown") {
      window.clearTimeout(this.counting);
      byId("countdown").hidden = true;
      this.state = "practice";
      announce("Stopped before it began.");
    } else if (this.state === "recording") {
      this.state = "settling";
      this.hand.release();
      announce("Stopped.");
      if (this.hand.settled) this.finish();
    } else this.player.leave();
    this.draw();
  }

  /** The pointer was lifted: in some worlds that ends the movement. */
  released(): void {
    const scene = this.welcome.scene as unknown as SceneFacts | null;
    if (scene?.ends === "release" && this.state === "recording") this.stop();
  }

  private made(): Take {
    const from = this.began;
    const { led, raw } = this.hand;
    const shift = (row: number[]) => [Math.round((row[0] - from) * 1e5) / 1e5, ...row.slice(1)];
    return {
      id: freshName(),
      samples: led.filter((row) => row[0] >= from).map(shift),
      raw: raw.filter((row) => row[0] >= from).map(shift),
      start: 0,
      end: 1,
      speed: 1,
      goal: this.requests.asked?.goal ?? null,
      seconds: (performance.now() - this.workBegan) / 1000,
    };
  }

  private finish(): void {
    window.clearInterval(this.timer);
    const take = tidied(this.made(), this.welcome.longest, SPEEDS);
    if (take.samples.length < 3) {
      this.state = "practice";
      announce("Nothing was drawn.");
      keep("draft", null);
      return this.draw();
    }
    this.judge(take);
  }

  // Takes.

  private adopt(take: Take): void {
    this.setAside();
    this.judge({ ...take, id: freshName(), goal: this.requests?.asked?.goal ?? take.goal });
  }

  private judge(take: Take): void {
    this.take = take;
    this.state = "assessing";
    keep("draft", take);
    this.send(assess(take));
    this.draw();
  }

  private assessed(worth: Assessed): void {
    if (!this.take || worth.take !== this.take.id || this.busy || this.state === "countdown") return;
    this.worth = worth;
    this.state = "assessed";
    const shown = worth.shown as unknown as Movement | null;
    const fitted = worth.fitted as unknown as Movement | null;
    this.player.load(shown, fitted, ["you", "as the learner would do it"]);
    this.draw();
    drawCurves(byId("curves"), worth.curves, worth.unit);
    if (worth.problem) announce(worth.problem);
    else {
      announce(`Reached ${points(worth.outcome)}. Accept it with →, redo with ←.`);
      this.player.play();
    }
  }

  accept(): void {
    if (this.state !== "assessed" || !this.take || !this.worth || this.worth.problem) return;
    const asked = this.requests.asked;
    const words = points(this.worth.outcome);
    this.letters.give(
      {
        what: "accept",
        id: freshName(),
        take: this.take.id,
        plan: asked?.plan ?? null,
        seconds: Math.min(this.take.seconds, 86400),
      },
      this.take,
      words,
    );
    this.clear();
    this.home();
    announce(`Given to the learner: ${words}.`);
  }

  redo(): void {
    if (!this.take) return;
    this.setAside();
    this.clear();
    this.home();
    announce("Discarded. Undo brings it back.");
  }

  keepIt(): void {
    if (!this.take || !this.worth) return;
    this.library.add(this.take, points(this.worth.outcome));
    announce("Kept in the library.");
  }

  undo(): void {
    this.undos.pop()?.();
    this.draw();
  }

  home(): void {
    if (this.busy) return;
    this.player.leave();
    this.send({ what: "reset", joints: null });
    this.hand.begin(this.welcome.joints.map((joint) => joint.home));
  }

  replay(): void {
    this.player.play();
  }

  decline(): void {
    this.requests.choose();
  }

  skip(): void {
    this.requests.skip();
  }

  private setAside(): void {
    const take = this.take;
    if (take) this.undoable(() => this.judge(take));
  }

  private clear(): void {
    this.take = this.worth = null;
    this.state = "practice";
    this.workBegan = 0;
    keep("draft", null);
    this.player.leave();
    this.player.load(null, null, []);
    this.draw();
  }

  private undoable(undo: () => void): void {
    this.undos = [...this.undos.slice(-30), undo];
    byId<HTMLButtonElement>("undo").disabled = false;
  }

  // The page.

  private asked(asked: Asked | null): void {
    this.stage.aim(asked?.shapes ?? []);
    this.asking(asked);
    if (asked) this.workBegan = performance.now();
    if (this.take && asked && this.state === "assessed") this.judge({ ...this.take, goal: asked.goal });
  }

  private posed(pose: Pose): void {
    if (!this.player.showing) this.stage.pose(pose.points);
    const sliders = byId("joints").querySelectorAll<HTMLInputElement>("input");
    sliders.forEach((slider, i) => {
      if (document.activeElement !== slider) slider.value = String(this.hand.joints[i]);
      slider.closest("label")!.classList.toggle("stuck", pose.stuck.includes(i));
      slider.closest("label")!.classList.toggle("chosen", i === this.hand.joint);
    });
  }

  private bind(): void {
    const tempo = byId<HTMLSelectElement>("tempo");
    tempo.onchange = () => this.hand.pass(Number(tempo.value));
    byId("record").onclick = () => this.record();
    byId("home").onclick = () => this.home();
    byId("undo").onclick = () => this.undo();
    byId("accept").onclick = () => this.accept();
    byId("redo").onclick = () => this.redo();
    byId("keep").onclick = () => this.keepIt();
    for (const id of ["trim-start", "trim-end", "speed"])
      byId<HTMLInputElement>(id).onchange = () => this.trim();
  }

  private trim(): void {
    const take = this.take;
    if (!take) return;
    this.setAside();
    const share = (id: string) => Number(byId<HTMLInputElement>(id).value) / 1000;
    const start = Math.min(share("trim-start"), 0.98);
    const end = Math.max(share("trim-end"), start + 0.01);
    this.judge({ ...take, start, end, speed: Number(byId<HTMLSelectElement>("speed").value) });
  }

  private joints(): void {
    const box = byId("joints");
    const { joints, unit } = this.welcome;
    if (joints.length < 3) return; // a mallet and one joint are led by the pointer alone
    box.replaceChildren(
      ...joints.map((joint, i) => {
        const slider = make("input", {
          type: "range",
          min: String(joint.low),
          max: String(joint.high),
          step: "any",
          value: String(joint.home),
        }) as HTMLInputElement;
        slider.oninput = () => this.hand.slide(i, Number(slider.value));
        return make("label", { title: `${joint.name}, in ${unit} (${i + 1})` }, joint.name, slider);
      }),
    );
  }

  private draw(): void {
    const { state, take, worth } = this;
    document.body.dataset.state = state;
    this.stage.zoom(this.busy || state === "countdown");
    const recording = state === "recording" || state === "countdown";
    byId("record").textContent = recording ? "■ Stop" : take ? "● Record again" : "● Record";
    byId("badge").hidden = !this.busy;
    byId("assessed").hidden = !take || this.busy || state === "countdown";
    byId<HTMLButtonElement>("undo").disabled = !this.undos.length;
    byId<HTMLButtonElement>("accept").disabled = state !== "assessed" || !!worth?.problem;
    byId<HTMLButtonElement>("keep").disabled = state !== "assessed" || !!worth?.problem;
    byId("accept").textContent = this.requests?.asked ? "Accept →" : "Give it unasked →";
    byId("hint").textContent = this.hint();
    if (!take || byId("assessed").hidden) return;
    byId<HTMLInputElement>("trim-start").value = String(Math.round(1000 * take.start));
    byId<HTMLInputElement>("trim-end").value = String(Math.round(1000 * take.end));
    byId<HTMLSelectElement>("speed").value = String(take.speed);
    this.drawWorth(take, state === "assessed" ? worth : null);
  }

  private drawWorth(take: Take, worth: Assessed | null): void {
    const fact = (name: string, value: string, kind = "") => [
      make("dt", {}, name),
      make("dd", kind ? { class: kind } : {}, value),
    ];
    const rows = [...fact("lasts", `${short(duration(take))} s`)];
    if (!worth) rows.push(...fact("reaches", "computing…"));
    else if (worth.problem) rows.push(...fact("problem", worth.problem, "problem"));
    else {
      rows.push(...fact("you reached", points(worth.outcome)));
      if (worth.distance !== null) rows.push(...fact("off the goal by", percent(worth.distance)));
      rows.push(...fact("the learner’s copy", points(worth.reached) || "reaches nothing"));
      rows.push(...fact("correspondence error", `${short(worth.residual)} ${worth.unit}`));
    }
    byId("worth").replaceChildren(...rows);
  }

  private hint(): string {
    if (!this.connected) return "No connection; what you draw is kept.";
    if (this.state === "countdown") return "Recording begins in a moment.";
    const release = (this.welcome.scene as unknown as SceneFacts | null)?.ends === "release";
    if (this.state === "recording" && release)
      return "Swing the arm and let go to throw; hold it still first to place the ball.";
    if (this.state === "recording") return "Lead the arm, then stop with space.";
    if (this.state === "assessed" && this.worth && !this.worth.problem)
      return "A miss is worth keeping too: the learner sees what it led to.";
    if (this.take) return "";
    const most = `Movements last up to ${short(this.welcome.longest)} s; slower ones are played faster.`;
    return this.stage.flat ? `Practise by dragging in the scene. ${most}` : `Practise: drag the tip of the rod. ${most}`;
  }
}

function points(outcome: Record<string, number[]>): string {
  return Object.entries(outcome)
    .map(([kind, point]) => `${kind} (${point.map((x) => short(Math.round(x * 1000) / 1000)).join(", ")})`)
    .join(", ");
}
