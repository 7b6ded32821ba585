// Replays a movement in the scene, with a ghost beside it if there is one.

import { byId } from "./dom";
import { Stage } from "./stage";

export interface Movement {
  times: number[];
  frames: number[][][];
  outcome: Record<string, number[]>;
}

/** The frame at a moment, between two that are given. */
function frameAt(movement: Movement, moment: number): number[][] {
  const { times, frames } = movement;
  let after = times.findIndex((time) => time >= moment);
  if (after < 0) after = times.length - 1;
  if (after === 0) return frames[0];
  const share = (moment - times[after - 1]) / (times[after] - times[after - 1]);
  return frames[after].map((point, i) =>
    point.map((x, k) => {
      const before = frames[after - 1][i][k];
      return before + Math.min(share, 1) * (x - before);
    }),
  );
}

export class Player {
  private movement: Movement | null = null;
  private ghost: Movement | null = null;
  private moment = 0;
  private began = 0;
  private running = false;

  constructor(
    private readonly stage: Stage,
    private readonly left: () => void,
  ) {
    byId("play").onclick = () => (this.running ? this.stop() : this.play());
    byId<HTMLInputElement>("seek").oninput = (event) => {
      this.running = false;
      const share = Number((event.target as HTMLInputElement).value) / 1000;
      this.moment = share * this.end;
      this.draw();
    };
  }

  /** Whether the scene shows a replay, not the arm as it is led. */
  get showing(): boolean {
    return this.movement !== null && (this.running || this.moment > 0);
  }

  private get end(): number {
    const last = (movement: Movement | null) => movement?.times[movement.times.length - 1] ?? 0;
    return Math.max(last(this.movement), last(this.ghost));
  }

  load(movement: Movement | null, ghost: Movement | null, words: string[]): void {
    this.movement = movement;
    this.ghost = ghost;
    this.running = false;
    this.moment = 0;
    byId("player").hidden = movement === null;
    const legend = byId("legend");
    legend.hidden = movement === null || !words.length;
    legend.replaceChildren(
      ...words.map((word, i) => {
        const chip = document.createElement("span");
        chip.className = i === 0 ? "of-shown" : "of-ghost";
        chip.textContent = word;
        return chip;
      }),
    );
  }

  play(): void {
    if (!this.movement) return;
    if (this.moment >= this.end) this.moment = 0;
    this.running = true;
    byId("play").textContent = "❚❚ Pause";
    const rate = () => Number(byId<HTMLSelectElement>("rate").value);
    this.began = performance.now();
    const step = () => {
      if (!this.running) return;
      const now = performance.now();
      this.moment = Math.min(this.end, this.moment + ((now - this.began) / 1000) * rate());
      this.began = now;
      this.draw();
      if (this.moment >= this.end) this.stop();
      else requestAnimationFrame(step);
    };
    step();
  }

  stop(): void {
    this.running = false;
    byId("play").textContent = "▶ Replay";
  }

  /** Leave the replay: the scene shows the arm again. */
  leave(): void {
    if (!this.showing) return;
    this.stop();
    this.moment = 0;
    this.left();
  }

  private draw(): void {
    if (!this.movement) return;
    const ghost = this.ghost ? frameAt(this.ghost, this.moment) : null;
    this.stage.pose(frameAt(this.movement, this.moment), ghost);
    byId<HTMLInputElement>("seek").value = String(Math.round((1000 * this.moment) / (this.end || 1)));
  }
}
