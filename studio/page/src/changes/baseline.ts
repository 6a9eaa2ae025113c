// Which labels differ from those of a moment before: the last edit, or the pack as it was saved. Labels are remembered by name,
// because the numbers of classes change with the pack.
import type {Change, ClassEntry} from '../source';

/** A label of a moment: the name of the class of every feature, null where it had none, by building. */
export type Snapshot = ReadonlyMap<number, readonly (string | null)[]>;

export function snapshotOf(labels: ReadonlyMap<number, readonly number[]>, classes: readonly ClassEntry[]): Snapshot {
  return new Map([...labels].map(([building, numbers]) => [building, numbers.map(number => classes[number]?.name ?? null)]));
}

/**
 * The features whose label differs from the snapshot, in the numbers of the present classes; a class that is gone counts as -1.
 * Buildings that the snapshot does not know have come since, and have not changed.
 */
export function changesSince(before: Snapshot, labels: ReadonlyMap<number, readonly number[]>, classes: readonly ClassEntry[]):
    {changes: Change[]; names: Map<string, string | null>} {
  const numbers = new Map(classes.map((entry, number) => [entry.name, number]));
  const changes: Change[] = [];
  const names = new Map<string, string | null>();
  for (const [building, now] of labels) {
    const then = before.get(building);
    if (!then || then.length !== now.length) continue;
    now.forEach((number, feature) => {
      const name = then[feature] ?? null;
      if (name === (classes[number]?.name ?? null)) return;
      names.set(`${building} ${feature}`, name);
      changes.push({building, feature, before: name === null ? -1 : numbers.get(name) ?? -1, after: number});
    });
  }
  return {changes, names};
}

/** Changes with the same labels before and after, most frequent first. */
export interface ChangeGroup { before: string | null; after: string | null; changes: Change[] }

export function groupsOf(changes: readonly Change[], names: ReadonlyMap<string, string | null>, classes: readonly ClassEntry[]): ChangeGroup[] {
  const groups = new Map<string, ChangeGroup>();
  for (const change of changes) {
    const before = names.get(`${change.building} ${change.feature}`) ?? null;
    const after = classes[change.after]?.name ?? null;
    const key = JSON.stringify([before, after]);
    const group = groups.get(key) ?? {before, after, changes: []};
    group.changes.push(change);
    groups.set(key, group);
  }
  return [...groups.values()].sort((a, b) => b.changes.length - a.changes.length);
}
