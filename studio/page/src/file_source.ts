// The source of a page that `oriel view` has written: everything stands in the page (docs/formats.md), nothing can be asked for.
import {shapeOf} from './scene/shape';
import {partByName} from './search/names';
import {
  SourceError, type BoxMm, type BuildingEntry, type ConditionRow, type ExplainAnswer, type Feature, type Issue, type PackAnswer,
  type RuleReason, type SearchAnswer, type Shape, type Source, type StateAnswer, type SurfacesAnswer, type Vec3
} from './source';
import {words} from './strings';

type Row = [indent: number, mark: number, found: number, asked: number, place: number];

interface FileFeature {
  id: string; name: string; kind: string; parent: number; label: string; rule: string; sentence: string; head: string;
  rules: number[][]; relations: [name: number, features: number[]][];
}
interface FilePolygon { source: number; rings: number[][]; owners: number[]; surface: string; why: number[] }
interface FileBuilding {
  id: string; issues: Issue[]; vertices_mm: number[]; storeys_mm: number[]; features: FileFeature[]; polygons: FilePolygon[];
}
export interface FileData {
  oriel: string; pack: string; origin_m: Vec3; labels: string[]; strings: string[]; rows: Row[];
  models: {name: string; buildings: FileBuilding[]}[];
}

export class FileSource implements Source {
  readonly can = {edit: false, explain: true, search: true, scale: false, truth: false};
  onRestart = null;
  /** The features of the second model that the first does not have follow those of the first. */
  private readonly features_: FileFeature[][];
  private readonly before: FileBuilding[];
  private readonly places = new Map<string, number>();

  constructor(private readonly data: FileData) {
    this.before = data.models[0]?.buildings ?? [];
    this.features_ = this.before.map(building => [...building.features]);
    this.before.forEach(({id}, number) => this.places.set(id, number));
  }

  get hasAfter(): boolean { return this.data.models.length > 1; }

  /** The buildings of the second model, their features numbered as in the first, and their labels. */
  after(): {buildings: Shape[]; labels: Map<number, number[]>} {
    const labels = new Map<number, number[]>();
    const buildings = (this.data.models[1]?.buildings ?? []).flatMap((building): Shape[] => {
      const number = this.places.get(building.id);
      if (number === undefined) return [];
      const known = this.features_[number]!;
      const place = new Map(known.map(({id}, i) => [id, i]));
      const own = known.map(({label}) => this.classOf(label));
      const numbers = building.features.map(feature => {
        const at = place.get(feature.id) ?? known.push(feature) - 1;
        own[at] = this.classOf(feature.label);
        return at;
      });
      labels.set(number, own);
      const polygons = building.polygons.map(({rings, owners, surface}) => ({rings, owners: owners.map(f => numbers[f]!), surface}));
      return [shapeOf(number, building.vertices_mm, polygons, building.storeys_mm)];
    });
    return {buildings, labels};
  }

  async state(): Promise<StateAnswer> {
    const all = this.before.length;
    return {
      program: `oriel ${this.data.oriel}`, pack: {name: this.data.pack, path: null, text: '', hash: '', is_writable: false},
      origin_m: this.data.origin_m, buildings: this.before.map(entryOf), has_truth: false, corrections: '', scales: [], lods: [],
      loading: {done: all, all}
    };
  }

  async geometry(buildings: number[]): Promise<Shape[]> {
    return buildings.map(number => {
      const {vertices_mm, storeys_mm, polygons} = this.before[number]!;
      return shapeOf(number, vertices_mm, polygons, storeys_mm);
    });
  }

  async features(buildings: number[]): Promise<{buildings: {number: number; features: Feature[]}[]}> {
    return {buildings: buildings.map(number => ({number, features: this.features_[number]!.map(({id, name, kind, parent}) => ({id, name, kind, parent}))}))};
  }

  async surfaces(building: number): Promise<SurfacesAnswer> {
    const {polygons} = this.before[building]!;
    return {types: polygons.map(({surface}) => surface), why: polygons.map(({why}) => why.map(i => this.text(i)).join('\n'))};
  }

  async pack(): Promise<PackAnswer> {
    const labels = Object.fromEntries(this.before.map(({features}, number) => [number, features.map(({label}) => this.classOf(label))]));
    const all = Object.values(labels).flat();
    return {
      version: 1, is_good: true, findings: [], params: [], changed: [], changed_count: 0, doubtful: [], score: null, ms: 0, labels,
      classes: this.data.labels.map(name => ({name, parent: null, line: 0})),
      counts: this.data.labels.map((name, i) => ({class: name, count: all.filter(label => label === i).length})),
      unknown: all.filter(label => label < 0).length
    };
  }

  async explain(building: number, feature: number): Promise<ExplainAnswer> {
    const found = this.features_[building]?.[feature];
    if (!found) throw new SourceError(words.explain.nothing, 404);
    const rules = found.rules.map(rows => this.reasonOf(rows));
    rules.sort((a, b) => Number(b.rule === found.rule) - Number(a.rule === found.rule) || Number(b.holds) - Number(a.holds));
    return {
      sentence: found.sentence, label: found.label || null, rule: found.rule || null, rule_line: null, why: rules, why_not: [],
      flip: null, relations: found.relations.map(([name, features]) => ({name: this.text(name), features})), attributes: [], correction: null,
      head: found.head
    };
  }

  /** Ids and names of features, else rules; buildings and labels are found by the page itself. */
  async search(text: string): Promise<SearchAnswer> {
    const named = partByName(this.features_, text);
    const parts = named ? [named] : this.features_.flatMap((features, building) =>
      features.flatMap(({rule}, feature): [number, number][] => (rule !== '' && rule === text ? [[building, feature]] : [])));
    return {parts, buildings: [], findings: []};
  }

  /** -1 without a label. */
  private classOf(label: string): number { return this.data.labels.indexOf(label); }
  private text(i: number): string { return this.data.strings[i] ?? ''; }

  /** The first row is that of the rule: its id, whether it holds, its label. */
  private reasonOf(rows: number[]): RuleReason {
    const [rule, ...conditions] = rows.map(i => this.data.rows[i]!);
    return {
      rule: this.text(rule![1]), label: this.text(rule![3]), holds: this.text(rule![2]).startsWith('holds'), line: null, place: this.text(rule![4]),
      conditions: conditions.map(([indent, mark, found, asked]): ConditionRow => ({
        text: '', found: this.text(found), asked: this.text(asked), line: null, depth: Math.max(0, (indent - 4) / 2), holds: holdsOf(this.text(mark)),
        ...scoreOf(this.text(mark))
      }))
    };
  }

  language = lacks; curve = lacks; correct = lacks; corrections = lacks; ask = lacks; learn = lacks; scale = lacks; scaleProgress = lacks; stopScale = lacks; acceptProposal = lacks; save = lacks; disk = lacks;
  truth = lacks;
}

async function lacks(): Promise<never> { throw new SourceError(words.source.lacks, 501); }

function holdsOf(mark: string): boolean | null {
  if (mark === 'holds' || mark === 'no veto') return true;
  return mark === 'fails' || mark === 'vetoes' ? false : null;
}

/** The row of a term of a score begins with what it was judged, from 0 to 1, and how much it counts: "0.80 x2". */
function scoreOf(mark: string): {score?: number | null; weight?: number} {
  const term = /^([01]\.\d+|-) x([\d.]+)$/.exec(mark);
  return term ? {score: term[1] === '-' ? null : Number(term[1]), weight: Number(term[2])} : {};
}

function boxOf(building: FileBuilding): BoxMm {
  const box: BoxMm = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (const polygon of building.polygons)
    for (const v of polygon.rings[0] ?? [])
      for (let k = 0; k < 3; ++k) {
        box[k] = Math.min(box[k]!, building.vertices_mm[3 * v + k]!);
        box[3 + k] = Math.max(box[3 + k]!, building.vertices_mm[3 * v + k]!);
      }
  return box[0] <= box[3] ? box : [0, 0, 0, 0, 0, 0];
}

function entryOf(building: FileBuilding): BuildingEntry {
  const box = boxOf(building).map(mm => mm / 1000);
  return {
    id: building.id, file: '', features: building.features.length, at_m: box.slice(0, 3) as Vec3,
    size_m: [0, 1, 2].map(k => box[3 + k]! - box[k]!) as Vec3, issues: building.issues, is_loaded: true, is_open: false
  };
}
