// The confusion table: what the truth says in rows, what the rules say in columns. A cell chooses the parts behind it.
import type {App} from '../app';
import {el} from '../dom';
import type {ConfusionCell, Part, Score} from '../source';
import {words} from '../strings';

/** What stands for "no object" in the truth and for "no label". */
function isNothing(name: string): boolean { return name === '' || name === '-' || name === 'unknown'; }

/** Names of rows or columns: classes of the score in its order, then whatever else the cells name, "nothing" last. */
function namesOf(score: Score, side: 'truth' | 'label'): string[] {
  const present = new Set(score.confusion.filter(cell => cell.count > 0).map(cell => cell[side]));
  const known = score.classes.map(entry => entry.name).filter(name => present.has(name));
  const others = [...present].filter(name => !known.includes(name)).sort((a, b) => Number(isNothing(a)) - Number(isNothing(b)) || (a < b ? -1 : 1));
  return [...known, ...others];
}

function nameOf(name: string, side: 'truth' | 'label'): string {
  if (!isNothing(name)) return name;
  return side === 'truth' ? words.truth.nothing : words.truth.notFound;
}

function choose(app: App, cell: ConfusionCell): void {
  const title = words.truth.cellTitle(nameOf(cell.truth, 'truth'), nameOf(cell.label, 'label'), cell.count);
  if (cell.parts.length > 0) {
    app.show(cell.parts, title);
    return;
  }
  const buildings = [...new Set(cell.missed.map(([building]) => building))];
  app.store.set({shows_truth: true});
  app.show([], title);
  if (buildings.length > 0) app.select({building: buildings[0]!}, true);
  app.store.say(words.truth.missedOnly(cell.count));
}

function cellOf(app: App, cell: ConfusionCell | undefined, most: number, truth: string, label: string): HTMLElement {
  if (!cell || cell.count === 0) return el('td', {class: 'confusion-cell is-zero'}, '·');
  const isRight = truth === label;
  const button = el('button', {
    type: 'button', class: 'number', 'aria-label': words.truth.cellTitle(nameOf(truth, 'truth'), nameOf(label, 'label'), cell.count),
    onclick: () => choose(app, cell)
  }, String(cell.count));
  const strength = isRight ? 0.25 + 0.75 * cell.count / most : Math.min(1, 0.35 + 0.65 * cell.count / Math.max(most / 4, 1));
  button.style.setProperty('--strength', strength.toFixed(3));
  return el('td', {class: `confusion-cell ${isRight ? 'is-right' : 'is-wrong'}`}, button);
}

export function confusionTable(app: App, score: Score): HTMLElement {
  const rows = namesOf(score, 'truth');
  const columns = namesOf(score, 'label');
  const cells = new Map(score.confusion.map(cell => [JSON.stringify([cell.truth, cell.label]), cell]));
  const most = Math.max(1, ...score.confusion.map(cell => cell.count));
  return el('table', {class: 'confusion'},
    el('caption', {class: 'visually-hidden'}, words.truth.confusion),
    el('thead', {}, el('tr', {},
      el('th', {class: 'confusion-corner', scope: 'col'}, words.truth.corner),
      ...columns.map(label => el('th', {scope: 'col', class: 'confusion-column'}, el('span', {}, nameOf(label, 'label')))))),
    el('tbody', {}, ...rows.map(truth => el('tr', {},
      el('th', {scope: 'row'}, nameOf(truth, 'truth')),
      ...columns.map(label => cellOf(app, cells.get(JSON.stringify([truth, label])), most, truth, label))))));
}

/** The parts that the rules label otherwise than the truth. */
export function wrongParts(score: Score): Part[] {
  return score.confusion.filter(cell => cell.truth !== cell.label).flatMap(cell => cell.parts);
}
