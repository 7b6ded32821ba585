// Made by: python -m sgim.web.typescript web/src/protocol.ts. Do not edit.

export const VERSION = 1;

export interface Asked {
  plan: number;
  teacher: string;
  who: string;
  mode: string;
  goal: GoalPoint | null;
  shapes: Record<string, unknown>[];
  error: number | null;
  gain: number | null;
  alone: number | null;
  replaces: string;
  movements: number;
  waiting: number;
  left: number;
}

export interface Assessed {
  what: "assessed";
  take: string;
  problem: string;
  outcome: Record<string, number[]>;
  reached: Record<string, number[]>;
  distance: number | null;
  residual: number;
  unit: string;
  duration: number;
  shown: Record<string, unknown> | null;
  fitted: Record<string, unknown> | null;
  curves: Curves[];
}

export interface Curves {
  joint: string;
  times: number[];
  shown: number[];
  fitted: number[];
}

export interface Desk {
  what: "desk";
  requests: Asked[];
  status: string;
  time_limit: number;
  per_hour: number;
  left: number;
  going: boolean;
}

export interface Exported {
  what: "exported";
  text: string;
}

export interface Imported {
  what: "imported";
  takes: ImportedTake[];
  teacher: string;
}

export interface ImportedTake {
  take: string;
  samples: number[][];
}

export interface Joint {
  name: string;
  low: number;
  high: number;
  home: number;
}

export interface Pose {
  what: "pose";
  number: number;
  joints: number[][];
  points: number[][];
  held: number[];
  stuck: number[];
}

export interface Refused {
  what: "refused";
  words: string;
}

export interface Role {
  what: "role";
  mine: boolean;
  holder: string;
  pages: number;
}

export interface Said {
  what: "said";
  id: string;
  state: "sent" | "taken" | "ended" | "refused";
  words: string;
  before: number | null;
  after: number | null;
}

export interface Welcome {
  what: "welcome";
  version: number;
  teaches: boolean;
  teacher: string;
  scene: Record<string, unknown> | null;
  joints: Joint[];
  unit: string;
  shortest: number;
  longest: number;
}

export interface Accept {
  what: "accept";
  id: string;
  take: string;
  plan: number | null;
  seconds: number;
}

export interface Arrange {
  what: "arrange";
  id: string;
  status: "now" | "busy" | "away";
  time_limit: number;
  per_hour: number;
}

export interface Assess {
  what: "assess";
  take: string;
  samples: number[][];
  raw: number[][];
  speed: number;
  goal: GoalPoint | null;
}

export interface Control {
  what: "control";
  take: boolean;
}

export interface Decline {
  what: "decline";
  id: string;
  plan: number;
  reason: string;
}

export interface Export {
  what: "export";
  takes: string[];
}

export interface Extend {
  what: "extend";
  id: string;
  plan: number;
}

export interface Hello {
  what: "hello";
  version: number;
  page: string;
  name: string;
}

export interface Import {
  what: "import";
  text: string;
}

export interface Lead {
  what: "lead";
  number: number;
  by: "tip" | "joints";
  samples: number[][];
}

export interface Recall {
  what: "recall";
  run: number;
  kind: string;
  point: number[];
}

export interface Reset {
  what: "reset";
  joints: number[] | null;
}

export interface Skip {
  what: "skip";
  id: string;
  plan: number;
}

export interface Suggest {
  what: "suggest";
  id: string;
  kind: string;
  point: number[];
}

export interface GoalMark {
  kind: string;
  point: number[];
  number: number;
}

export interface Kind {
  kind: string;
  names: string[];
  units: string[];
  low: number[];
  high: number[];
}

export interface ModeFacts {
  name: string;
  episodes: number;
  movements: number;
  progress: number;
  lately: number;
}

export interface Outcomes {
  what: "outcomes";
  run: number;
  kind: string;
  afresh: boolean;
  points: number[][];
}

export interface Recalled {
  what: "recalled";
  run: number;
  goal: GoalPoint;
  problem: string;
  expected: number[];
  error: number | null;
  movement: Record<string, unknown> | null;
  shapes: Record<string, unknown>[];
}

export interface Region {
  kind: string;
  low: number[];
  high: number[];
  interest: number;
}

export interface RunFacts {
  what: "runfacts";
  run: number;
  title: string;
  experiment: string;
  movements: number;
  target: number;
  finished: boolean;
  unit: string;
  kinds: Kind[];
  evaluations: number[][];
  errors: string[];
  modes: ModeFacts[];
  strip: number[][];
  goals: GoalMark[];
  shown: GoalMark[];
  regions: Region[];
  requests: Record<string, number>;
  seconds: number;
  problem: string;
}

export interface GoalPoint {
  kind: string;
  point: number[];
}

export type FromPage = Hello | Control | Reset | Lead | Assess | Accept | Decline | Skip | Extend | Suggest | Arrange | Recall | Export | Import;

export type FromServer = Welcome | Role | RunFacts | Outcomes | Desk | Pose | Assessed | Said | Recalled | Exported | Imported | Refused;
