/** What the server tells of itself when a connection opens. */

export interface KeyFacts {
  readonly type: "number" | "numbers" | "choice" | "points" | "text";
  readonly unit?: string | null;
  readonly default?: unknown;
  readonly minimum?: number;
  readonly maximum?: number;
  readonly choices?: readonly string[];
}

export interface BehaviourFacts {
  readonly name: string;
  readonly summary: string;
  /** Keys of the case file with their defaults. */
  readonly parameters: Readonly<Record<string, unknown>>;
}

export interface Hello {
  readonly kind: "hello";
  readonly version: string;
  readonly mujoco: boolean;
  readonly ffmpeg: boolean;
  readonly kinds: readonly string[];
  readonly limits: { readonly message_bytes: number; readonly grid_points: number; readonly map_grid: number };
  /** In which formats the server writes what. */
  readonly exports: Readonly<Record<string, readonly string[]>>;
  readonly behaviours: readonly BehaviourFacts[];
  readonly keys: Readonly<Record<string, Readonly<Record<string, KeyFacts | Readonly<Record<string, KeyFacts>>>>>>;
}
