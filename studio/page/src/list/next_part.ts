// The next part that deserves a look: unknown, doubtful (decided by little) or wrong (truth says otherwise).
import type {App} from '../app';
import type {Part} from '../source';
import {words} from '../strings';

export type NextKind = 'unknown' | 'doubtful' | 'wrong' | 'changed';

export function partsOf(app: App, kind: NextKind): Part[] {
  const {labels, doubtful, score, changed} = app.store.value;
  if (kind === 'doubtful') return [...doubtful].sort(inOrder);
  if (kind === 'changed') return changed.map(({building, feature}): Part => [building, feature]).sort(inOrder);
  if (kind === 'wrong') return (score?.confusion ?? []).filter(cell => cell.truth !== cell.label).flatMap(cell => cell.parts).sort(inOrder);
  return [...labels].sort(([a], [b]) => a - b)
    .flatMap(([building, classes]) => classes.flatMap((label, feature): Part[] => (label < 0 ? [[building, feature]] : [])));
}

const inOrder = (a: Part, b: Part) => a[0] - b[0] || a[1] - b[1];

/** Chooses the one after (or before) what is chosen now. */
export function nextOf(app: App, kind: NextKind, step: 1 | -1): void {
  const parts = partsOf(app, kind);
  if (parts.length === 0) return app.store.say(words.list.none[kind]);
  const now = app.store.value.selection;
  const at: Part = [now?.building ?? -1, now?.feature ?? -1];
  const after = step === 1 ? parts.findIndex(part => inOrder(part, at) > 0) : parts.findLastIndex(part => inOrder(part, at) < 0);
  const index = after >= 0 ? after : step === 1 ? 0 : parts.length - 1;
  const [building, feature] = parts[index]!;
  app.store.say(words.list.nth[kind](index + 1, parts.length));
  app.select({building, feature}, true);
}
