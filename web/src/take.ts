// A take: what was drawn, trimmed and timed, before it is given to the learner.

import { Assess, GoalPoint } from "./protocol";

export interface Take {
  id: string;
  samples: number[][]; // time in s, then joints
  raw: number[][];
  start: number; // shares of its length
  end: number;
  speed: number;
  goal: GoalPoint | null;
  seconds: number; // the person's time
}

const STILL = 1e-3; // movement of a joint below which the arm is taken to be still
const KEEP = 0.05; // seconds kept before the first movement

/** The length of what is kept, in s, as it will be played. */
export function duration(take: Take): number {
  const { samples } = take;
  if (samples.length < 2) return 0;
  const whole = samples[samples.length - 1][0] - samples[0][0];
  return ((take.end - take.start) * whole) / take.speed;
}

/** Trim what is still before and after the movement; play it fast enough to be possible. */
export function tidied(take: Take, longest: number, speeds: number[]): Take {
  const { samples } = take;
  if (samples.length < 3) return take;
  const apart = (a: number[], b: number[]) => Math.max(...a.slice(1).map((x, i) => Math.abs(x - b[i + 1])));
  const first = samples[0];
  const last = samples[samples.length - 1];
  const begins = samples.findIndex((row) => apart(row, first) > STILL);
  if (begins < 0) return take;
  let ends = samples.length - 1;
  while (ends > begins && apart(samples[ends], last) <= STILL) ends -= 1;
  const whole = last[0] - first[0];
  const start = Math.max(0, (samples[begins][0] - KEEP - first[0]) / whole);
  const end = Math.min(1, (samples[ends][0] + KEEP - first[0]) / whole);
  const trimmed = { ...take, start, end, speed: 1 };
  const speed = speeds.find((one) => duration({ ...trimmed, speed: one }) <= longest);
  return { ...trimmed, speed: speed ?? speeds[speeds.length - 1] };
}

/** The question what a take is worth. */
export function assess(take: Take): Assess {
  const { samples } = take;
  const begin = samples[0]?.[0] ?? 0;
  const whole = (samples[samples.length - 1]?.[0] ?? 0) - begin;
  const within = (row: number[]) =>
    row[0] >= begin + take.start * whole - 1e-9 && row[0] <= begin + take.end * whole + 1e-9;
  const { id, speed, goal } = take;
  const kept = samples.filter(within).slice(0, 6000);
  const raw = take.raw.filter(within).slice(0, 6000);
  return { what: "assess", take: id, samples: kept, raw, speed, goal };
}
