// What the page asks and what it is answered: the types of every verb of studio/session, and the interface that both kinds of
// source fulfil (ServerSource: the studio; RecordedSource: the file that `oriel view` writes).
//
// Buildings have numbers, features have indices in their building. Lengths are in metres, but vertices and boxes are in
// millimetres from the origin of the picture. Lines and columns begin at 1; columns are UTF-16 units, as strings of JavaScript have them.

export type Vec3 = [number, number, number];
export type BoxMm = [number, number, number, number, number, number];
/** A feature: the number of its building and its index there. */
export type Part = [building: number, feature: number];

export interface Issue { code: string; severity: 'error' | 'warning' | 'note'; sentence: string; file?: string }

// ---- state, geometry, surfaces ----

export interface PackInfo { name: string; path: string | null; text: string; hash: string; is_writable: boolean }
export interface BuildingEntry {
  id: string; file: string; features: number; issues: Issue[];
  /** The smallest corner of the building's box in the picture, and the size of the box. */
  at_m: Vec3; size_m: Vec3;
  /** How far it lies from the others where that is too far for one picture, and whether it lay upon others and stands beside them. */
  away_m?: number; is_moved?: boolean;
  /** False while it is not segmented yet: it has no geometry. */
  is_loaded: boolean;
  /** True if it is no closed body. */
  is_open: boolean;
}
export interface StateAnswer {
  program: string; pack: PackInfo; buildings: BuildingEntry[]; has_truth: boolean;
  corrections: string; scales: number[]; lods: string[]; issues: Issue[]; loading: {done: number; all: number};
  /** True where there are no files, but samples that can be opened. */
  offers_samples?: boolean;
}

/** The polygons of a building in flat lists (scene/shape.ts reads them). Vertex v lies at base_mm + vertices_mm[3 v, 3 v + 1, 3 v + 2]. */
export interface Shape {
  number: number; base_mm: Vec3; vertices_mm: ArrayLike<number>; storeys_mm: number[];
  /** For each polygon the end of its rings in corner_ends, and of its owners in owners; for each ring the end of its corners. */
  ring_ends: ArrayLike<number>; owner_ends: ArrayLike<number>; corner_ends: ArrayLike<number>;
  /** Vertices; features, of each polygon the smallest first. */
  corners: ArrayLike<number>; owners: ArrayLike<number>;
  /** WallSurface, RoofSurface … by polygon, where the source knows it beforehand. */
  surfaces?: string[];
}
export interface Feature { id: string; name: string; kind: string; parent: number }
export interface SurfacesAnswer { types: string[]; why: string[] }

// ---- pack ----

export interface Edit { line: number; column: number; end_line: number; end_column: number; text: string }
export interface Fix { title: string; edits: Edit[] }
export interface Finding {
  code: string; severity: 'error' | 'warning' | 'note'; sentence: string; advice: string;
  line: number; column: number; end_line: number; end_column: number; fixes: Fix[];
}
export interface ClassEntry { name: string; parent: string | null; line: number; is_abstract?: boolean }
export interface ParamEntry {
  name: string; value: number; unit: string; text: string; from: number | null; to: number | null; reason: string; line: number;
}
export interface Change { building: number; feature: number; before: number; after: number }
export interface ClassScore {
  name: string; precision: number; recall: number; f1: number; found: number; missed: number; wrong: number;
}
export interface ConfusionCell {
  truth: string; label: string; count: number; parts: Part[]; missed: [building: number, object: string][];
}
export interface RuleScore { rule: string; right: number; wrong: number; line: number }
export interface Score { macro_f1: number; classes: ClassScore[]; confusion: ConfusionCell[]; rules: RuleScore[] }
export interface PackAnswer {
  /** Of the labels; the next question names it as `since`. None with errors. */
  number?: number; version: number; is_good: boolean; findings: Finding[]; classes: ClassEntry[]; params: ParamEntry[];
  labels: Record<string, number[]>; changed: Change[]; changed_count: number; counts: {class: string; count: number}[];
  unknown: number; doubtful: Part[]; score: Score | null; ms: number;
}
export interface PackQuestion { text: string; version: number; params?: Record<string, string>; since: number }

// ---- explain ----

export interface ConditionRow {
  text: string; found: string; asked: string; holds: boolean | null; line: number | null; depth: number; missed_by?: string; without_value?: string[];
  /** Of a term of a score, which neither holds nor fails: 0 to 1, and how much it counts. */
  score?: number | null; weight?: number;
}
export interface RuleReason {
  rule: string; label: string; holds: boolean | null; line: number | null; conditions: ConditionRow[];
  /** File and line as text, where there is no editor to open. */
  place: string;
}
export interface NearestMiss { label: string; rule: string; line: number | null; sentence: string }
export interface Flip { sentence: string; param: string; value: string; line: number | null }
export interface RelationEntry { name: string; features: number[]; meaning?: string }
export interface AttributeEntry { name: string; value: string; unit: string; meaning: string }
export interface Correction { building: number; feature: number; class: string; by?: string; why?: string }
export interface ExplainAnswer {
  sentence: string; label: string | null; rule: string | null; rule_line: number | null; why: RuleReason[]; why_not: NearestMiss[];
  flip: Flip | null; relations: RelationEntry[]; attributes: AttributeEntry[]; correction: Correction | null;
  /** The verdict in the words of `oriel explain`. */
  head: string;
}

// ---- language ----

export interface LanguageQuestion {
  verb: 'complete' | 'hover' | 'definition' | 'rename' | 'format' | 'outline' | 'fixes';
  text: string; line: number; column: number; name?: string;
}
export interface CompletionItem {
  label: string; kind: string; detail: string; documentation: string; insert: string; from_column: number;
}
export interface CompleteAnswer { items: CompletionItem[] }
export interface HoverAnswer { text: string; line: number; column: number; end_line: number; end_column: number }
export interface DefinitionAnswer { line: number; column: number; end_line: number; end_column: number }
export interface RenameAnswer { edits: Edit[]; findings?: Finding[] }
export interface FormatAnswer { text?: string; findings?: Finding[] }
export interface OutlineItem {
  kind: 'class' | 'rule' | 'param' | 'macro' | string; name: string; parent: string | null; line: number; end_line: number;
}
export interface OutlineAnswer { items: OutlineItem[] }
export interface FixesAnswer { fixes: Fix[] }

// ---- curve, search, corrections, ask, learn ----

export interface CurveAnswer { values: number[]; f1: number[]; at: number }
export interface SearchAnswer { parts: Part[]; buildings: number[]; findings: Finding[] }
export interface CorrectQuestion { building: number; feature: number; class: string | null; by?: string; why?: string }
export interface CorrectionsAnswer { path: string; list: Correction[] }
export interface AskAnswer { parts: {building: number; feature: number; sentence: string}[] }
/** A change of a rule that would pay: `text` is the whole pack with it alone, '' where it cannot be made, which `why_not` explains. */
export interface RuleProposal { what: string; rule: string; gain: number; held_out_gain: number; yaml?: string; text?: string; why_not?: string }
export interface AcceptAnswer { text: string; why_not: string }
export interface LearnQuestion { objective?: string; params?: string[]; propose?: boolean; stop?: boolean }
export interface LearnAnswer {
  state: 'idle' | 'running' | 'done' | 'failed'; done: number; all: number; text: string; summary: string; issues: Issue[];
  /** The whole report, as `oriel learn` prints it, and changes of rules that would pay; nothing of them is in `text`. */
  report?: string; proposals?: RuleProposal[];
}

// ---- scale, save, disk, truth ----

export interface ScaledPolygon { source: number; rings: number[][]; feature: number; surface: string }
export interface ScaleAnswer {
  vertices_mm: number[]; polygons: ScaledPolygon[]; outcomes: {feature: number; operator: string; sentence: string}[];
  issues: Issue[]; is_valid: boolean;
  /** What a reader should know of how it was drawn; may be empty. */
  note?: string;
}
/** What a scale that is drawn is at: labelling, drawing, checking or repairing. */
export interface ScaleProgress { state: 'idle' | 'running'; stage?: string }
export type ScaleQuestion = {building: number; scale: number} | {building: number; lod: string};
export interface SaveQuestion { text: string; hash: string; path?: string; force?: boolean }
export interface SaveAnswer { hash: string; path: string }
export interface DiskAnswer { hash: string; is_changed: boolean }
export interface TruthObject { building: number; class: string; id: string; box_mm: BoxMm; polygons?: number[] }
export interface TruthAnswer { objects: TruthObject[] }

/** A refusal: its sentence is fit to be shown. `body` is the whole answer (409 of `save`: error, disk_text, disk_hash). */
export class SourceError extends Error {
  constructor(message: string, readonly status: number, readonly body: Record<string, unknown> = {}) { super(message); }
  get isSuperseded(): boolean { return this.body['superseded'] === true; }
}

/** One method a verb. What a source cannot do throws SourceError with status 501; `can` says so beforehand. */
export interface Source {
  readonly can: {edit: boolean; explain: boolean; search: boolean; scale: boolean; truth: boolean};
  state(): Promise<StateAnswer>;
  geometry(buildings: number[]): Promise<Shape[]>;
  features(buildings: number[]): Promise<{buildings: {number: number; features: Feature[]}[]}>;
  surfaces(building: number): Promise<SurfacesAnswer>;
  pack(question: PackQuestion): Promise<PackAnswer>;
  /** Called when the program behind the source has been started again, and reads the buildings anew. */
  onRestart: (() => void) | null;
  /** `quick`: without the flip, which may take seconds. */
  explain(building: number, feature: number, quick?: boolean, signal?: AbortSignal): Promise<ExplainAnswer>;
  language(question: LanguageQuestion & {verb: 'complete'}): Promise<CompleteAnswer>;
  language(question: LanguageQuestion & {verb: 'hover'}): Promise<HoverAnswer | null>;
  language(question: LanguageQuestion & {verb: 'definition'}): Promise<DefinitionAnswer | null>;
  language(question: LanguageQuestion & {verb: 'rename'}): Promise<RenameAnswer>;
  language(question: LanguageQuestion & {verb: 'format'}): Promise<FormatAnswer>;
  language(question: LanguageQuestion & {verb: 'outline'}): Promise<OutlineAnswer>;
  language(question: LanguageQuestion & {verb: 'fixes'}): Promise<FixesAnswer>;
  curve(param: string, ofClass?: string): Promise<CurveAnswer>;
  search(text: string): Promise<SearchAnswer>;
  correct(question: CorrectQuestion): Promise<{count: number}>;
  corrections(): Promise<CorrectionsAnswer>;
  ask(count: number): Promise<AskAnswer>;
  learn(question: LearnQuestion): Promise<LearnAnswer>;
  /** Makes the change of a proposal, by its place in the list, in a text of the pack. */
  acceptProposal(index: number, text: string): Promise<AcceptAnswer>;
  scale(question: ScaleQuestion, signal?: AbortSignal): Promise<ScaleAnswer>;
  scaleProgress(): Promise<ScaleProgress>;
  /** Ends the scale that is drawn; who asked for it gets a superseded refusal. */
  stopScale(): Promise<unknown>;
  save(question: SaveQuestion): Promise<SaveAnswer>;
  disk(): Promise<DiskAnswer>;
  /** Writes the sample houses into a folder and opens them. */
  openSamples(): Promise<{folder: string}>;
  truth(buildings: number[]): Promise<TruthAnswer>;
}
