// The heat map: a share from 0 to 1 of every building.
import type {Values} from '../store';

export type HeatKind = 'unknown' | 'doubtful' | 'wrong' | 'changed' | number;

/** What the heat map shows; a number is a class: how much of all features have it. */
export function heatOf(values: Readonly<Values>): Map<number, number> {
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
  return stretched(shares);
}

/** Shares against the largest, so that differences are seen also where all are small. */
function stretched(shares: Map<number, number>): Map<number, number> {
  const most = Math.max(...shares.values(), 1e-9);
  return new Map([...shares].map(([building, share]) => [building, share / most]));
}
