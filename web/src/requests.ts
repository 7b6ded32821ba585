// The request card, and when one may be asked.

import { announce, byId, freshName, make, percent, short } from "./dom";
import { Asked, Desk, FromPage } from "./protocol";
import { Letters } from "./letters";

const NEARLY_OVER = 40; // seconds left at which a person who is at work is given more time

export class Requests {
  private desk: Desk | null = null;
  private heard = 0;
  private drawn = -1;
  private extended = -1;

  /**
   * @param atWork Whether the person is drawing an answer.
   * @param changed Is told when another request, or none, is before the person.
   */
  constructor(
    private readonly send: (message: FromPage) => boolean,
    private readonly letters: Letters,
    private readonly atWork: () => boolean,
    private readonly changed: (asked: Asked | null) => void,
  ) {
    byId("skip").onclick = () => this.skip();
    byId("decline").onclick = () => this.choose();
    byId("more-time").onclick = () => this.extend();
    byId<HTMLFormElement>("reasons").onsubmit = (event) => {
      event.preventDefault();
      this.decline(byId<HTMLSelectElement>("reason").value);
    };
    for (const button of document.querySelectorAll<HTMLButtonElement>("#availability button"))
      button.onclick = () => this.arrange({ status: button.dataset.status as "now" });
    for (const id of ["time-limit", "per-hour"])
      byId<HTMLInputElement>(id).onchange = () =>
        this.arrange({
          time_limit: Number(byId<HTMLInputElement>("time-limit").value),
          per_hour: Math.round(Number(byId<HTMLInputElement>("per-hour").value)),
        });
    window.setInterval(() => this.tick(), 500);
  }

  get asked(): Asked | null {
    return this.desk?.requests[0] ?? null;
  }

  hear(desk: Desk): void {
    this.desk = desk;
    this.heard = performance.now();
    for (const button of document.querySelectorAll<HTMLButtonElement>("#availability button"))
      button.setAttribute("aria-checked", String(button.dataset.status === desk.status));
    const limit = byId<HTMLInputElement>("time-limit");
    const budget = byId<HTMLInputElement>("per-hour");
    if (document.activeElement !== limit) limit.value = String(Math.round(desk.time_limit));
    if (document.activeElement !== budget) budget.value = String(desk.per_hour);
    byId("budget-left").textContent = `${desk.left} left this hour`;
    this.draw();
    this.tick();
  }

  skip(): void {
    const asked = this.asked;
    if (asked) this.letters.give({ what: "skip", id: freshName(), plan: asked.plan }, null, "Skipped");
  }

  /** Show the reasons for declining. */
  choose(): void {
    if (!this.asked) return;
    const form = byId<HTMLFormElement>("reasons");
    form.hidden = !form.hidden;
    if (!form.hidden) byId("reason").focus();
  }

  private decline(reason: string): void {
    const asked = this.asked;
    byId<HTMLFormElement>("reasons").hidden = true;
    if (asked)
      this.letters.give({ what: "decline", id: freshName(), plan: asked.plan, reason }, null, `Declined: ${reason}`);
  }

  private extend(): void {
    if (this.asked) this.send({ what: "extend", id: freshName(), plan: this.asked.plan });
  }

  private arrange(change: Partial<{ status: "now" | "busy" | "away"; time_limit: number; per_hour: number }>): void {
    const desk = this.desk;
    if (!desk) return;
    const { status, time_limit, per_hour } = { ...desk, ...change };
    this.send({ what: "arrange", id: freshName(), status: status as "now", time_limit, per_hour });
  }

  private draw(): void {
    const asked = this.asked;
    const plan = asked?.plan ?? -1;
    byId("request-buttons").hidden = asked === null;
    byId("request").classList.toggle("waiting", asked !== null);
    if (plan === this.drawn && asked) return;
    if (plan !== this.drawn) {
      byId<HTMLFormElement>("reasons").hidden = true;
      this.changed(asked);
      if (asked) announce(`${asked.who} asks: ${goalWords(asked)}.`);
      else if (this.drawn >= 0) announce("The request is over.");
    }
    this.drawn = plan;
    byId("asked").replaceChildren(...(asked ? this.card(asked) : [this.nothing()]));
  }

  private nothing(): HTMLElement {
    const desk = this.desk;
    let words = "Nothing is asked at the moment. Show something unasked, or suggest a goal on the map.";
    if (desk && desk.status !== "now") words = `You are ${desk.status}: it explores by itself.`;
    else if (desk && !desk.left) words = "Your budget for this hour is spent: it explores by itself.";
    else if (desk && !desk.going) words = "The run has stopped. What you show now waits for it.";
    return make("p", { class: "hint" }, words);
  }

  private card(asked: Asked): HTMLElement[] {
    const fact = (name: string, value: string) => [make("dt", {}, name), make("dd", {}, value)];
    const facts = make(
      "dl",
      { class: "facts" },
      ...(asked.goal
        ? fact("misses it now by", asked.error === null ? "all: never tried" : percent(asked.error))
        : []),
      ...(asked.gain !== null
        ? fact(
            "expected gain",
            `${percent(asked.gain)} a movement with you` +
              (asked.alone === null ? "" : `, ${percent(asked.alone)} alone`),
          )
        : []),
      ...fact("else it would", `try ${asked.replaces}`),
      ...fact("waits", ""),
    );
    facts.lastElementChild!.id = "waits";
    return [
      make("p", { class: "question" }, make("strong", {}, asked.who), " asks you: ", goalWords(asked), "?"),
      facts,
    ];
  }

  private tick(): void {
    const asked = this.asked;
    const waits = document.getElementById("waits");
    if (!asked || !waits) return;
    const passed = (performance.now() - this.heard) / 1000;
    const left = Math.max(0, asked.left - passed);
    waits.textContent = `${Math.round(asked.waiting + passed)} s, ${Math.round(left)} s more`;
    if (left < NEARLY_OVER && this.atWork() && this.extended !== asked.plan + asked.left) {
      this.extended = asked.plan + asked.left;
      this.extend();
    }
  }
}

/** What is asked, in words. */
export function goalWords(asked: Asked): string {
  if (!asked.goal) return "show me anything that I should know";
  const point = asked.goal.point.map((x) => short(Math.round(x * 1000) / 1000)).join(", ");
  return `how do I reach ${asked.goal.kind} (${point})`;
}
