// The heat map: a share from 0 to 1 of every building.
import type {Values} from '../store';

/** The share of a building's features that are what the heat map shows; a number is a class. */
export function sharesOf(values: Readonly<Values>): Map<number, number> {
  const kind = values.heat;
  const counts = new Map<number, number>();
  const note = (building: number) => counts.set(building, (counts.get(building) ?? 0) + 1);
  if (kind === 'doubtful') for (const [building] of values.doubtful) note(building);
  if (kind === 'changed') for (const {building} of values.changed) note(building);
  if (kind === 'wrong') for (const cell of values.score?.confusion ?? []) if (cell.truth !== cell.label) for (const [building] of cell.parts) note(building);
  const shares = new Map<number, number>();
  for (const [building, labels] of values.labels) {
    const all = Math.max(1, labels.length);
    if (kind === 'unknown') shares.set(building, labels.filter(label => label < 0).length / all);
    else if (typeof kind === 'number') shares.set(building, labels.filter(label => label === kind).length / all);
    else shares.set(building, (counts.get(building) ?? 0) / all);
  }
  return shares;
}

/** The share that has the last colour: the smallest of a few round ones over which none is, so that differences are seen also where
    all are small. */
export function topOf(shares: ReadonlyMap<number, number>): number {
  const most = [...shares.values()].reduce((max, share) => Math.max(max, share), 0);
  return [0.02, 0.05, 0.1, 0.25, 0.5].find(top => most <= top) ?? 1;
}

let last: {of: unknown[]; heat: ReadonlyMap<number, number>} = {of: [], heat: new Map()};

/** The place of every building between the first and the last colour; the same map as long as nothing has changed. */
export function heatOf(values: Readonly<Values>): ReadonlyMap<number, number> {
  const of = [values.labels, values.heat, values.doubtful, values.changed, values.score];
  if (of.every((value, i) => value === last.of[i])) return last.heat;
  const shares = sharesOf(values);
  const top = topOf(shares);
  last = {of, heat: new Map([...shares].map(([building, share]) => [building, share / top]))};
  return last.heat;
}
