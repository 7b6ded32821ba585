// The person's hand: pointer, keys and sliders become samples that lead the arm.
// Times are the browser's own; samples that have not been answered are kept and sent again.

import { Lead, Pose, Welcome } from "./protocol";
import { Place, Stage } from "./stage";

const IN_FLIGHT = 4; // messages that may wait for an answer
const AT_ONCE = 300; // samples in a message
const SETTLING = 2.5; // seconds for which the world goes on after the last move
const KEY_SPEED = 0.45; // metres a second by the keyboard; flat scenes: of a metre of arm
const TURN_SPEED = 0.9; // of a joint, in its unit a second

interface Sample {
  by: "tip" | "joints";
  row: number[];
}

export class Hand {
  /** Samples as they were drawn: time, then where the pointer was in the scene. */
  raw: number[][] = [];
  /** Positions of the joints in answer to them: time, then joints. */
  led: number[][] = [];
  joints: number[] = [];
  dragging = false;
  private queue: Sample[] = [];
  private unanswered: Lead[] = [];
  private number = 0;
  private first = 0;
  private last: Sample | null = null;
  private target: Place | null = null;
  private through: Place | null = null;
  private offset: Place = [0, 0, 0];
  private held: Place | null = null; // where the handle was led to
  private pressed = new Set<string>();
  private chosen = 0;
  private moved = -Infinity;
  private before = 0;
  private origin: [number, number] = [0, 0]; // of the world's time, and of ours
  private tempo = 1;
  private looping = false;
  private latest = -Infinity;
  private waiting = false;

  /**
   * @param send Sends a message, if there is a connection.
   * @param busy Whether time must pass even if nobody moves: while recording.
   * @param posed Is told that the arm has moved.
   */
  constructor(
    private readonly stage: Stage,
    private readonly welcome: Welcome,
    private readonly plane: () => string,
    private readonly send: (message: Lead) => boolean,
    private readonly busy: () => boolean,
    private readonly posed: (pose: Pose) => void,
  ) {
    this.joints = welcome.joints.map((joint) => joint.home);
  }

  /** The world's time at one of ours, in s: it passes as fast as was chosen. */
  time(now = performance.now() / 1000): number {
    return this.origin[0] + (now - this.origin[1]) * this.tempo;
  }

  /** Let the world's time pass so many times as fast as ours, from now on. */
  pass(tempo: number): void {
    const now = performance.now() / 1000;
    this.origin = [this.time(now), now];
    this.tempo = tempo;
  }

  get settled(): boolean {
    return !this.queue.length && !this.unanswered.length;
  }

  // Pointer.

  grasp(event: PointerEvent): boolean {
    if (!this.stage.grasps(event.clientX, event.clientY)) return false;
    const handle = this.stage.handle;
    if (!handle) return false;
    this.through = handle;
    const under = this.stage.under(event.clientX, event.clientY, this.plane(), handle);
    // A tip that is grasped beside its middle does not jump, nor one that hangs below where it
    // was led to; a mallet comes to the pointer.
    const held = this.held;
    this.offset =
      under && held && !this.stage.flat
        ? [held[0] - under[0], held[1] - under[1], held[2] - under[2]]
        : [0, 0, 0];
    this.dragging = true;
    this.drag(event);
    return true;
  }

  drag(event: PointerEvent): void {
    if (!this.dragging || !this.through) return;
    const events = event.getCoalescedEvents?.() ?? [];
    for (const one of events.length ? events : [event]) {
      const under = this.stage.under(one.clientX, one.clientY, this.plane(), this.through);
      if (!under) continue;
      this.target = [0, 1, 2].map((i) => under[i] + this.offset[i]) as Place;
      this.add({ by: "tip", row: [this.time(one.timeStamp / 1000), ...this.target] });
    }
  }

  release(): void {
    this.dragging = false;
  }

  // Keys and sliders.

  press(key: string): boolean {
    if (/^[1-9]$/.test(key)) {
      this.chosen = Math.min(Number(key) - 1, this.joints.length - 1);
      return true;
    }
    if (!["w", "a", "s", "d", "arrowup", "arrowdown"].includes(key)) return false;
    this.pressed.add(key);
    this.wake();
    return true;
  }

  lift(key: string): void {
    this.pressed.delete(key);
    if (!this.pressed.size) this.target = null;
  }

  get joint(): number {
    return this.chosen;
  }

  slide(joint: number, value: number): void {
    const joints = [...this.joints];
    joints[joint] = value;
    this.joints = joints;
    this.add({ by: "joints", row: [this.time(), ...joints] });
  }

  // Sending.

  /** The world begins anew: what was on its way does not count any more. */
  begin(joints: number[]): void {
    this.waiting = false;
    this.queue = [];
    this.unanswered = [];
    this.first = this.number + 1;
    this.raw = [];
    this.led = [];
    this.joints = [...joints];
    this.target = null;
    this.last = { by: "joints", row: [0, ...joints] };
    this.wake();
  }

  /** The connection is lost: what is drawn waits. */
  wait(): void {
    this.waiting = true;
  }

  /** Connected again: send once more what was not answered, before anything new. */
  again(): void {
    this.waiting = false;
    for (const lead of this.unanswered) this.send(lead);
    this.wake();
  }

  hear(pose: Pose): void {
    if (pose.number >= 0 && pose.number < this.first) return; // from before it began anew
    this.unanswered = this.unanswered.filter((lead) => lead.number > pose.number);
    this.led.push(...pose.joints);
    this.held = pose.held as Place;
    const latest = pose.joints[pose.joints.length - 1];
    if (latest) this.joints = latest.slice(1);
    this.posed(pose);
  }

  wake(): void {
    this.moved = performance.now() / 1000;
    if (this.looping) return;
    this.looping = true;
    this.before = this.moved;
    const step = () => {
      this.step();
      const idle = performance.now() / 1000 - this.moved > SETTLING && this.settled;
      if (idle && !this.busy() && !this.dragging && !this.pressed.size) this.looping = false;
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  private add(sample: Sample): void {
    this.raw.push(sample.row);
    this.push(sample);
    this.wake();
  }

  /** Times must increase, but a pointer's moment may lie before the one that was sent last. */
  private push(sample: Sample): void {
    this.latest = Math.max(sample.row[0], this.latest + 2e-5);
    this.queue.push({ by: sample.by, row: [this.latest, ...sample.row.slice(1)] });
  }

  private step(): void {
    const now = performance.now() / 1000;
    const passed = Math.min(now - this.before, 0.1);
    this.before = now;
    if (this.pressed.size) this.byKeys(now, passed);
    // With nobody moving, time passes for a while all the same: the line swings, the puck flies.
    const goesOn = this.busy() || this.dragging || now - this.moved < SETTLING;
    if (goesOn && !this.queue.length && this.last && !this.unanswered.length)
      this.push({ by: this.last.by, row: [this.time(now), ...this.last.row.slice(1)] });
    while (!this.waiting && this.queue.length && this.unanswered.length < IN_FLIGHT) {
      const by = this.queue[0].by;
      let count = this.queue.findIndex((sample) => sample.by !== by);
      if (count < 0) count = this.queue.length;
      const samples = this.queue.splice(0, Math.min(count, AT_ONCE));
      this.last = samples[samples.length - 1];
      this.number += 1;
      const rows = samples.map((sample) => sample.row);
      const lead: Lead = { what: "lead", number: this.number, by, samples: rows };
      this.unanswered.push(lead);
      if (!this.send(lead)) break;
    }
  }

  private byKeys(now: number, passed: number): void {
    const one = (key: string) => (this.pressed.has(key) ? 1 : 0);
    const turned = one("arrowup") - one("arrowdown");
    if (turned) {
      const joint = this.welcome.joints[this.chosen];
      const value = this.joints[this.chosen] + turned * passed * TURN_SPEED;
      this.slide(this.chosen, Math.min(joint.high, Math.max(joint.low, value)));
      return;
    }
    const right = one("d") - one("a");
    const up = one("w") - one("s");
    if (!right && !up) return;
    this.target ??= this.held;
    if (!this.target) return;
    const by = this.stage.step(right, up, this.plane());
    const speed = KEY_SPEED * (this.stage.flat ? 2 : 1) * passed;
    this.target = [0, 1, 2].map((i) => this.target![i] + speed * by[i]) as Place;
    this.add({ by: "tip", row: [this.time(now), ...this.target] });
  }
}
