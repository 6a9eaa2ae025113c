// What the page knows, in one place. Parts of the page read `store.value`, change it by `set`, and are called when a field that
// they watch has changed. Changes of one turn of the event loop come as one call.
import type {
  BuildingEntry, Change, ClassEntry, Feature, Finding, Issue, ParamEntry, PackInfo, Part, Score, Shape, TruthObject
} from './source';

/** What is chosen: a feature, a surface (the index of a polygon of the building), or a whole building. */
export interface Selection { building: number; feature?: number; polygon?: number }

/** Which labels are shown: a class number, or -1 for what has no label. */
export interface Filter { hidden: ReadonlySet<number> }

export type ColourMode = 'colour' | 'pattern' | 'heat';

export interface Values {
  program: string;
  pack: PackInfo;
  buildings: BuildingEntry[];
  loading: {done: number; all: number};
  has_truth: boolean;
  /** What is wrong with files as a whole. */
  issues: Issue[];
  offers_samples: boolean;
  corrections: string;
  scales: number[];
  lods: string[];
  /** Geometry that is at hand, by the building's number. The map is replaced when some comes or goes (loading/). */
  geometry: ReadonlyMap<number, Shape>;
  /** Names and kinds of features, by the building's number: those that were asked for (App.feature). */
  features: ReadonlyMap<number, Feature[]>;

  /** The pack's text as it stands in the editor, and the version of the last answer to it. */
  text: string;
  version: number;
  is_good: boolean;
  findings: Finding[];
  classes: ClassEntry[];
  params: ParamEntry[];
  /** Class numbers of the features (-1 unknown), by the building's number: those of the last good pack. */
  labels: ReadonlyMap<number, number[]>;
  counts: {class: string; count: number}[];
  unknown: number;
  doubtful: Part[];
  score: Score | null;
  changed: Change[];
  changed_count: number;
  ms: number;

  selection: Selection | null;
  /** The building that alone is in the picture; null: all are. */
  only: number | null;
  /** Several parts at once: what a search or a cell of the confusion table has found. */
  found: Part[];
  found_title: string;
  hover: Selection | null;
  filter: Filter;
  colours: ColourMode;
  /** What the heat map shows: a kind of part, or a class by its number. */
  heat: 'unknown' | 'doubtful' | 'wrong' | 'changed' | number;
  truth: TruthObject[];
  shows_truth: boolean;
  shows_changes: boolean;
  shows_hidden_lines: boolean;
  shows_relations: boolean;
  is_measuring: boolean;
  /** The name of a relation whose lines alone are drawn, or null for all of the chosen feature. */
  relation: string | null;
  is_dark: boolean;
  /** A sentence for the reader (status line, read aloud), and whether it tells of something that went wrong. */
  message: string;
  is_message_grave: boolean;
}

export const kInitial: Values = {
  program: '', pack: {name: '', path: null, text: '', hash: '', is_writable: false}, buildings: [],
  loading: {done: 0, all: 0}, has_truth: false, issues: [], offers_samples: false, corrections: '', scales: [], lods: [], geometry: new Map(), features: new Map(),
  text: '', version: 0, is_good: true, findings: [], classes: [], params: [], labels: new Map(), counts: [], unknown: 0,
  doubtful: [], score: null, changed: [], changed_count: 0, ms: 0,
  selection: null, only: null, found: [], found_title: '', hover: null, filter: {hidden: new Set()}, colours: 'colour', heat: 'unknown', truth: [],
  shows_truth: false, shows_changes: true, shows_hidden_lines: false, shows_relations: true, is_measuring: false, relation: null,
  is_dark: false, message: '', is_message_grave: false
};

const kMessageMs = 8000;

type Watcher = {keys: ReadonlySet<keyof Values>; call: () => void};

export class Store {
  value: Readonly<Values>;
  private readonly watchers: Watcher[] = [];
  private changedKeys = new Set<keyof Values>();

  constructor(initial: Values = kInitial) { this.value = initial; }

  set(changes: Partial<Values>): void {
    const keys = (Object.keys(changes) as (keyof Values)[]).filter(key => changes[key] !== this.value[key]);
    if (keys.length === 0) return;
    this.value = {...this.value, ...changes};
    if (this.changedKeys.size === 0) queueMicrotask(() => this.tell());
    for (const key of keys) this.changedKeys.add(key);
  }

  /** Calls `call` now, and whenever one of the keys has changed. Returns what ends it. */
  watch(keys: (keyof Values)[], call: () => void): () => void {
    const watcher = {keys: new Set(keys), call};
    this.watchers.push(watcher);
    call();
    return () => { this.watchers.splice(this.watchers.indexOf(watcher), 1); };
  }

  /** Tells the reader something; a grave message stays until the next one, any other for a while. */
  say(message: string, isGrave = false): void {
    this.set({message, is_message_grave: isGrave});
    if (!isGrave && message !== '') setTimeout(() => { if (this.value.message === message) this.set({message: ''}); }, kMessageMs);
  }

  private tell(): void {
    const keys = this.changedKeys;
    this.changedKeys = new Set();
    for (const watcher of [...this.watchers])
      if ([...keys].some(key => watcher.keys.has(key))) watcher.call();
  }
}

const namesOf = new WeakMap<readonly BuildingEntry[], string[]>();

/** The name of a building: its id, and of those with one id that of the file as well. */
export function nameOf({buildings}: Readonly<Values>, building: number): string {
  let names = namesOf.get(buildings);
  if (!names) namesOf.set(buildings, names = toldApart(buildings));
  return names[building] ?? '';
}

function toldApart(buildings: readonly BuildingEntry[]): string[] {
  let names = buildings.map(({id}) => id);
  const stemOf = (file: string) => file.replace(/.*[/\\]/, '').replace(/(\.city)?\.[a-z]+$/i, '');
  const together = (id: string, more: string) => (more.startsWith(id) ? more : `${id} · ${more}`);
  for (const more of [({id, file}: BuildingEntry) => together(id, stemOf(file)), ({id, file}: BuildingEntry) => `${id} · ${file}`,
    ({id, file}: BuildingEntry, i: number) => `${id} · ${file} · ${i + 1}`]) {
    const counts = new Map<string, number>();
    for (const name of names) counts.set(name, (counts.get(name) ?? 0) + 1);
    if (counts.size === names.length) break;
    names = names.map((name, i) => (counts.get(name)! > 1 ? more(buildings[i]!, i) : name));
  }
  return names;
}

/** The class number of a feature, -1 where it has no label (yet). */
export function labelOf(values: Readonly<Values>, building: number, feature: number): number {
  return values.labels.get(building)?.[feature] ?? -1;
}
