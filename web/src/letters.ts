// What the person has given, until the run has taken it up: kept by the browser, sent again when
// the connection or the server comes back, under the same name so that it counts once.

import { byId, make, percent } from "./dom";
import { keep, kept } from "./keep";
import { Accept, Decline, FromPage, Said, Skip } from "./protocol";
import { Take, assess } from "./take";

type Given = Accept | Decline | Skip;

interface Letter {
  message: Given;
  take: Take | null;
  words: string;
}

export class Letters {
  private waiting: Letter[] = kept<Letter[]>("letters", []);
  private readonly lines = new Map<string, HTMLElement>();

  /** @param send Sends a message, if there is a connection. */
  constructor(private readonly send: (message: FromPage) => boolean) {
    for (const letter of this.waiting) this.line(letter.message.id, letter.words, "not sent yet");
  }

  give(message: Given, take: Take | null, words: string): void {
    this.waiting.push({ message, take, words });
    this.store();
    this.line(message.id, words, "sending…");
    this.send(message);
  }

  /** The page is in control again: send what nobody has confirmed. */
  again(): void {
    for (const { message, take } of this.waiting) {
      if (take) this.send(assess(take));
      this.send(message);
    }
  }

  /** @returns What to tell the person, if there is something. */
  hear(said: Said): string | null {
    const letter = this.waiting.find((one) => one.message.id === said.id);
    const known = this.lines.has(said.id);
    if (letter && (said.state === "taken" || said.state === "refused")) {
      this.waiting = this.waiting.filter((one) => one !== letter);
      this.store();
    }
    if (!known) return said.state === "refused" || said.words ? said.words : null;
    let words = { sent: "sent", taken: "taken up", ended: "tried", refused: "refused" }[said.state];
    if (said.words) words = `${words}: ${said.words}`;
    if (said.state === "ended" && said.before !== null && said.after !== null) {
      words = `learned: error ${percent(said.before)} → ${percent(said.after)}`;
      this.lines.get(said.id)!.classList.add("learned");
    }
    this.lines.get(said.id)!.lastElementChild!.textContent = words;
    return said.state === "sent" ? null : words;
  }

  private line(id: string, what: string, state: string): void {
    const line = make("li", {}, make("span", {}, what), make("em", {}, state));
    this.lines.set(id, line);
    const list = byId("letters");
    list.prepend(line);
    while (list.children.length > 6) list.lastElementChild!.remove();
  }

  private store(): void {
    keep("letters", this.waiting.length ? this.waiting : null);
  }
}
