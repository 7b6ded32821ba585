// Charts: errors over movements, outcomes, choices, and the curves of a demonstration.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { make, short, sized } from "./dom";
import { COLOURS, KINDS, interestColour, modeColours, timeColour } from "./palette";
import { Curves, GoalMark, GoalPoint, Kind, Region, RunFacts } from "./protocol";

/** Errors of each kind over movements, on a logarithmic scale where that is possible. */
export class ErrorChart {
  private chart: uPlot | null = null;
  private names = "";

  constructor(private readonly box: HTMLElement) {
    new ResizeObserver(() => this.chart?.setSize(this.size())).observe(box);
  }

  show(run: RunFacts): void {
    const columns = run.errors.map((_, i) => run.evaluations.map((row) => row[i + 1]));
    const one = run.errors.length === 2 && run.errors.includes("total");
    const shown = run.errors.map((name, i) => ({ name, i })).filter((e) => !one || e.name !== "total");
    const data = [run.evaluations.map((row) => row[0]), ...shown.map((e) => columns[e.i])];
    const names = shown.map((e) => e.name).join();
    if (!this.chart || this.names !== names) {
      this.chart?.destroy();
      this.names = names;
      const series = shown.map((e, i) => ({
        label: e.name,
        stroke: e.name === "total" ? "#222" : KINDS[i % KINDS.length],
        width: 2,
        dash: e.name === "total" ? [6, 4] : undefined,
        points: { show: true, size: 6 },
        value: (_: uPlot, value: number | null) => (value === null ? "–" : short(value)),
      }));
      const axis = { stroke: "#55606c", grid: { stroke: "#e6ebef", width: 1 }, ticks: { show: false } };
      this.chart = new uPlot(
        {
          ...this.size(),
          series: [{ label: "movements" }, ...series],
          scales: { x: { time: false }, y: { range: (_, __, max) => [0, (max || 1) * 1.08] } },
          axes: [axis, { ...axis, size: 52 }],
          cursor: { drag: { setScale: false } },
        },
        data as uPlot.AlignedData,
        this.box,
      );
    } else this.chart.setData(data as uPlot.AlignedData);
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(200, this.box.clientWidth), height: Math.max(120, this.box.clientHeight - 34) };
  }
}

const MARGIN = { left: 46, right: 12, top: 10, bottom: 34 };

/** What was reached, of one kind: points by time, regions by interest, goals, demonstrations. */
export class OutcomeMap {
  kind: Kind | null = null;
  points: number[][] = [];
  request: GoalPoint | null = null;
  picked: GoalPoint | null = null;
  reached: number[] | null = null;
  private run: RunFacts | null = null;

  constructor(private readonly canvas: HTMLCanvasElement) {
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  show(run: RunFacts): void {
    this.run = run;
    this.draw();
  }

  /** The point of the kind that a pointer is at. */
  at(x: number, y: number): number[] | null {
    const frame = this.frame();
    if (!frame || !this.kind) return null;
    const box = this.canvas.getBoundingClientRect();
    const u = (x - box.left - MARGIN.left) / frame.width;
    const v = 1 - (y - box.top - MARGIN.top) / frame.height;
    if (u < 0 || u > 1 || v < 0 || v > 1) return null;
    return this.kind.low.map((low, i) => {
      const share = i === 0 ? u : i === 1 ? v : 0.5;
      return low + share * (this.kind!.high[i] - low);
    });
  }

  draw(): void {
    const { context, width, height } = sized(this.canvas);
    const { run, kind } = this;
    if (!run || !kind || width < 80) return;
    const frame = { width: width - MARGIN.left - MARGIN.right, height: height - MARGIN.top - MARGIN.bottom };
    const flat = kind.low.length === 1;
    const end = Math.max(run.movements, 1);
    const place = (point: number[], when: number): [number, number] => [
      MARGIN.left + ((point[0] - kind.low[0]) / (kind.high[0] - kind.low[0])) * frame.width,
      MARGIN.top +
        (1 - (flat ? when / end : (point[1] - kind.low[1]) / (kind.high[1] - kind.low[1]))) * frame.height,
    ];
    context.save();
    context.beginPath();
    context.rect(MARGIN.left, MARGIN.top, frame.width, frame.height);
    context.clip();
    context.fillStyle = "#fbfcfd";
    context.fillRect(MARGIN.left, MARGIN.top, frame.width, frame.height);
    this.regions(context, run.regions.filter((r) => r.kind === kind.kind), place, flat, end);
    const size = this.points.length > 1500 ? 1.4 : this.points.length > 300 ? 2 : 2.8;
    for (const [when, x, y] of this.points) {
      const [px, py] = place([x, y], when);
      context.fillStyle = timeColour(when / end);
      context.beginPath();
      context.arc(px, py, size, 0, 2 * Math.PI);
      context.fill();
    }
    this.marks(context, run, kind, place, end);
    context.restore();
    this.axes(context, kind, frame, flat ? `movement` : "", end);
  }

  private frame(): { width: number; height: number } | null {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth < 80) return null;
    return {
      width: clientWidth - MARGIN.left - MARGIN.right,
      height: clientHeight - MARGIN.top - MARGIN.bottom,
    };
  }

  private regions(
    context: CanvasRenderingContext2D,
    regions: Region[],
    place: (point: number[], when: number) => [number, number],
    flat: boolean,
    end: number,
  ): void {
    const values = regions.map((r) => r.interest);
    const least = Math.min(...values);
    const range = Math.max(...values) - least;
    context.strokeStyle = "rgba(120,90,30,0.25)";
    context.lineWidth = 1;
    for (const region of regions) {
      const [x0, y0] = place(region.low, 0);
      const [x1, y1] = place(region.high, flat ? end : 0);
      context.fillStyle = interestColour(range > 0 ? Math.sqrt((region.interest - least) / range) : 0.3);
      context.fillRect(x0, y1, x1 - x0, y0 - y1);
      context.strokeRect(x0, y1, x1 - x0, y0 - y1);
    }
  }

  private marks(
    context: CanvasRenderingContext2D,
    run: RunFacts,
    kind: Kind,
    place: (point: number[], when: number) => [number, number],
    end: number,
  ): void {
    const colours = modeColours(run.modes.map((m) => m.name));
    const of = (mark: GoalMark) => mark.kind === kind.kind;
    context.lineWidth = 1.6;
    run.goals.filter(of).forEach((mark, i, all) => {
      const [x, y] = place(mark.point, end - (all.length - i) * (end / 200));
      context.strokeStyle = colours[run.modes[mark.number]?.name] ?? "#555";
      context.beginPath();
      context.moveTo(x - 3.5, y);
      context.lineTo(x + 3.5, y);
      context.moveTo(x, y - 3.5);
      context.lineTo(x, y + 3.5);
      context.stroke();
    });
    for (const mark of run.shown.filter(of)) {
      const [x, y] = place(mark.point, mark.number);
      context.beginPath();
      context.moveTo(x, y - 6);
      context.lineTo(x + 6, y);
      context.lineTo(x, y + 6);
      context.lineTo(x - 6, y);
      context.closePath();
      context.fillStyle = COLOURS.float;
      context.strokeStyle = "white";
      context.fill();
      context.stroke();
    }
    for (const [goal, colour] of [
      [this.request, COLOURS.goal],
      [this.picked, COLOURS.ghost],
    ] as const) {
      if (goal?.kind !== kind.kind) continue;
      const [x, y] = place(goal.point, end / 2);
      context.strokeStyle = colour;
      context.lineWidth = 3;
      context.beginPath();
      context.arc(x, y, 9, 0, 2 * Math.PI);
      context.stroke();
    }
    if (this.reached && this.picked?.kind === kind.kind) {
      const [x, y] = place(this.reached, end / 2);
      context.fillStyle = COLOURS.ghost;
      context.beginPath();
      context.arc(x, y, 4, 0, 2 * Math.PI);
      context.fill();
    }
  }

  private axes(
    context: CanvasRenderingContext2D,
    kind: Kind,
    frame: { width: number; height: number },
    vertical: string,
    end: number,
  ): void {
    const named = (i: number) => `${kind.names[i]}${kind.units[i] ? ` (${kind.units[i]})` : ""}`;
    context.strokeStyle = "#c4ced6";
    context.lineWidth = 1;
    context.strokeRect(MARGIN.left + 0.5, MARGIN.top + 0.5, frame.width - 1, frame.height - 1);
    context.fillStyle = "#55606c";
    context.font = "11px system-ui, sans-serif";
    const bottom = MARGIN.top + frame.height;
    context.textAlign = "left";
    context.fillText(short(kind.low[0]), MARGIN.left, bottom + 14);
    context.textAlign = "right";
    context.fillText(short(kind.high[0]), MARGIN.left + frame.width, bottom + 14);
    context.fillText(short(vertical ? 0 : kind.low[1]), MARGIN.left - 5, bottom);
    context.fillText(short(vertical ? end : kind.high[1]), MARGIN.left - 5, MARGIN.top + 9);
    context.textAlign = "center";
    context.fillText(named(0), MARGIN.left + frame.width / 2, bottom + 26);
    context.save();
    context.translate(12, MARGIN.top + frame.height / 2);
    context.rotate(-Math.PI / 2);
    context.fillText(vertical || named(1), 0, 0);
    context.restore();
  }
}

/** Shares of the modes over time. */
export class Strip {
  private run: RunFacts | null = null;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly legend: HTMLElement,
  ) {
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  show(run: RunFacts): void {
    this.run = run;
    const colours = modeColours(run.modes.map((m) => m.name));
    this.legend.replaceChildren(
      ...run.modes.map((mode) => {
        const patch = make("i");
        patch.style.background = colours[mode.name];
        return make("span", { class: "chip" }, patch, mode.name);
      }),
    );
    this.draw();
  }

  private draw(): void {
    const { context, width, height } = sized(this.canvas);
    const run = this.run;
    if (!run || !run.strip.length) return;
    const colours = Object.values(modeColours(run.modes.map((m) => m.name)));
    const end = run.strip[run.strip.length - 1][0] || 1;
    let left = 0;
    for (const [upto, ...counts] of run.strip) {
      const right = Math.round((upto / end) * width);
      const total = counts.reduce((sum, count) => sum + count, 0) || 1;
      let y = height;
      counts.forEach((count, mode) => {
        const part = (count / total) * height;
        context.fillStyle = colours[mode];
        context.fillRect(left, y - part, right - left, part);
        y -= part;
      });
      left = right;
    }
  }
}

/** What each mode came to, as a table. */
export function modeTable(table: HTMLElement, run: RunFacts): void {
  const cell = (text: string, tag = "td") => make(tag, {}, text);
  const head = make("tr", {}, ...["mode", "episodes", "movements", "gain a movement, lately"].map((t) => cell(t, "th")));
  const rows = run.modes.map((mode) =>
    make(
      "tr",
      {},
      cell(mode.name, "th"),
      cell(short(mode.episodes)),
      cell(short(mode.movements)),
      cell(short(mode.lately)),
    ),
  );
  table.replaceChildren(make("thead", {}, head), make("tbody", {}, ...rows));
}

/** The person's movement and the learner's, joint by joint (figure 3.2.2). */
export function drawCurves(box: HTMLElement, curves: Curves[], unit: string): void {
  box.replaceChildren();
  for (const curve of curves) {
    const canvas = make("canvas", { "aria-hidden": "true" }) as HTMLCanvasElement;
    box.append(make("figure", {}, canvas, make("figcaption", {}, `${curve.joint} (${unit})`)));
    const { context, width, height } = sized(canvas);
    const all = [...curve.shown, ...curve.fitted];
    const middle = (Math.max(...all) + Math.min(...all)) / 2;
    const half = Math.max((Math.max(...all) - Math.min(...all)) / 2, 0.05) * 1.15;
    const end = curve.times[curve.times.length - 1] || 1;
    const line = (values: number[], colour: string, wide: number) => {
      context.strokeStyle = colour;
      context.lineWidth = wide;
      context.beginPath();
      values.forEach((value, i) => {
        context.lineTo((curve.times[i] / end) * width, ((middle + half - value) / (2 * half)) * height);
      });
      context.stroke();
    };
    line(curve.shown, COLOURS.arm, 3);
    line(curve.fitted, COLOURS.ghost, 1.8);
  }
}
