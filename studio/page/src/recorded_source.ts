// The source of a page that `oriel view` has written: the replies of the studio stand in the page (docs/formats.md), nothing else can be
// asked for.
import {shapesOfBytes} from './scene/shape';
import {partByName} from './search/names';
import {SourceError, type ExplainAnswer, type Feature, type PackAnswer, type SearchAnswer, type Shape, type Source, type StateAnswer, type SurfacesAnswer} from './source';
import {words} from './strings';

/** Values by number: a list is [-1, numbers of its values…], a text of several lines [-2, its lines…], an object [its keys, its values…]. */
export interface Pool { keys: string[][]; values: unknown[]; root: number }
interface AfterBuilding { number: number; geometry: string; types: string[]; labels: number[] }
interface Recording {
  state: StateAnswer; pack: PackAnswer; after: AfterBuilding[] | null;
  buildings: {geometry: string; features: Feature[]; surfaces: SurfacesAnswer; explain: ExplainAnswer[]}[];
}

/** The value of a number; those that stand in several places are one. */
function valueOf(pool: Pool, number: number, made: Map<number, unknown>): unknown {
  const entry = pool.values[number];
  if (!Array.isArray(entry)) return entry;
  const known = made.get(number);
  if (known !== undefined) return known;
  const [shape, ...parts] = entry as number[];
  const list = parts.map(part => valueOf(pool, part, made));
  const value = shape === -1 ? list : shape === -2 ? list.join('\n') : Object.fromEntries(pool.keys[shape!]!.map((key, i) => [key, list[i]]));
  made.set(number, value);
  return value;
}

export class RecordedSource implements Source {
  readonly can = {edit: false, explain: true, search: true, scale: false, truth: false};
  onRestart = null;
  private readonly recorded: Recording;

  constructor(pool: Pool) { this.recorded = valueOf(pool, pool.root, new Map()) as Recording; }

  get hasAfter(): boolean { return this.recorded.after !== null; }

  /** The buildings of the second picture, their features numbered as in the first, and their labels. */
  after(): {buildings: Shape[]; labels: Map<number, number[]>} {
    const after = this.recorded.after ?? [];
    return {buildings: after.map(({geometry, types}) => shapeOf(geometry, types)), labels: new Map(after.map(({number, labels}) => [number, labels]))};
  }

  async state(): Promise<StateAnswer> { return this.recorded.state; }
  async pack(): Promise<PackAnswer> { return this.recorded.pack; }
  async surfaces(building: number): Promise<SurfacesAnswer> { return this.recorded.buildings[building]!.surfaces; }

  async geometry(buildings: number[]): Promise<Shape[]> {
    return buildings.map(number => {
      const {geometry, surfaces} = this.recorded.buildings[number]!;
      return shapeOf(geometry, surfaces.types);
    });
  }

  async features(buildings: number[]): Promise<{buildings: {number: number; features: Feature[]}[]}> {
    return {buildings: buildings.map(number => ({number, features: this.recorded.buildings[number]!.features}))};
  }

  async explain(building: number, feature: number): Promise<ExplainAnswer> {
    const found = this.recorded.buildings[building]?.explain[feature];
    if (!found) throw new SourceError(words.explain.nothing, 404);
    return found;
  }

  /** Ids and names of features, else rules; buildings and labels are found by the page itself. */
  async search(text: string): Promise<SearchAnswer> {
    const {buildings} = this.recorded;
    const named = partByName(buildings.map(({features}) => features), text);
    const parts = named ? [named] : buildings.flatMap(({explain}, building) =>
      explain.flatMap(({rule}, feature): [number, number][] => (rule === text ? [[building, feature]] : [])));
    return {parts, buildings: [], findings: []};
  }

  language = lacks; curve = lacks; correct = lacks; corrections = lacks; ask = lacks; learn = lacks; scale = lacks; scaleProgress = lacks; stopScale = lacks; acceptProposal = lacks; save = lacks; disk = lacks; openSamples = lacks;
  truth = lacks;
}

const shapeOf = (geometry: string, surfaces: string[]): Shape => ({...shapesOfBytes(Uint8Array.from(atob(geometry), c => c.charCodeAt(0)).buffer)[0]!, surfaces});

async function lacks(): Promise<never> { throw new SourceError(words.source.lacks, 501); }
