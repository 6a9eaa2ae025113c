// The buildings with their counts and badges, and the ways to the next part that deserves a look. Thousands of rows: only those in
// sight are elements.
import type {App, Panel} from '../app';
import {el, replace} from '../dom';
import {icon} from '../shell/icons';
import {nameOf} from '../store';
import {words} from '../strings';
import {nextOf, partsOf, type NextKind} from './next_part';

const kRowRem = 3;
const kOutOfSight = 6;

interface Facts { unknown: number; doubtful: number; wrong: number; changed: number }

export function listPanel(app: App): Panel {
  const element = el('div', {class: 'panel list'});
  const jumps = el('div', {class: 'jumps', role: 'group', 'aria-label': words.list.jumps});
  const sort = el('select', {'aria-label': words.list.sort, onchange: () => update()});
  sort.append(...Object.entries(words.list.orders).map(([value, text]) => el('option', {value}, text)));
  const spacer = el('div', {class: 'list-spacer'});
  const rows = el('ul', {class: 'list-rows', tabindex: '0', 'aria-label': words.list.title}, spacer);
  element.append(jumps, el('label', {class: 'row small'}, words.list.sort, sort), rows);
  let order: number[] = [];
  let facts = new Map<number, Facts>();

  const rowHeight = () => kRowRem * parseFloat(getComputedStyle(document.documentElement).fontSize);
  const draw = () => {
    const height = rowHeight();
    const first = Math.max(0, Math.floor(rows.scrollTop / height) - kOutOfSight);
    const last = Math.min(order.length, Math.ceil((rows.scrollTop + rows.clientHeight) / height) + kOutOfSight);
    const focused = (document.activeElement as HTMLElement | null)?.dataset['building'];
    spacer.style.height = `${order.length * height}px`;
    replace(rows, spacer, ...order.slice(first, last).map((building, i) => rowElement(app, building, facts.get(building)!, (first + i) * height, order.length, first + i)));
    if (focused) rows.querySelector<HTMLElement>(`[data-building="${focused}"]`)?.focus({preventScroll: true});
  };
  let isStale = false;
  const update = () => {
    // Behind another tab there is nothing to see: it is counted when it comes to the front.
    isStale = Boolean(element.hidden);
    if (isStale) return;
    facts = factsOf(app);
    order = [...facts.keys()];
    const by = sort.value;
    if (by === 'name') order.sort((a, b) => nameOf(app.store.value, a).localeCompare(nameOf(app.store.value, b), 'en', {numeric: true}));
    else if (by !== 'file') order.sort((a, b) => facts.get(b)![by as keyof Facts] - facts.get(a)![by as keyof Facts] || a - b);
    replace(jumps, ...jumpButtons(app));
    draw();
  };
  rows.addEventListener('scroll', draw);
  new ResizeObserver(draw).observe(rows);
  rows.addEventListener('keydown', event => {
    const step = ({ArrowDown: 1, ArrowUp: -1} as Record<string, number>)[event.key];
    if (!step || order.length === 0) return;
    event.preventDefault();
    event.stopPropagation();
    const at = order.indexOf(app.store.value.selection?.building ?? -1);
    const building = order[Math.max(0, Math.min(order.length - 1, at + step))]!;
    app.select({building}, true);
    rows.scrollTop = Math.max(0, order.indexOf(building) * rowHeight() - rows.clientHeight / 2);
  });
  app.store.watch(['buildings', 'labels', 'doubtful', 'score', 'changed', 'selection'], update);
  return {id: 'list', title: words.list.title, element, onShow: () => (isStale ? update() : draw())};
}

function factsOf(app: App): Map<number, Facts> {
  const {buildings, labels, doubtful, changed} = app.store.value;
  const facts = new Map(buildings.map((_, building): [number, Facts] => [building, {
    unknown: (labels.get(building) ?? []).reduce((sum, label) => sum + (label < 0 ? 1 : 0), 0), doubtful: 0, wrong: 0, changed: 0
  }]));
  for (const [building] of doubtful) if (facts.has(building)) ++facts.get(building)!.doubtful;
  for (const {building} of changed) if (facts.has(building)) ++facts.get(building)!.changed;
  for (const [building] of partsOf(app, 'wrong')) if (facts.has(building)) ++facts.get(building)!.wrong;
  return facts;
}

function jumpButtons(app: App): HTMLElement[] {
  const kinds: NextKind[] = ['unknown', 'doubtful', ...(app.store.value.has_truth ? ['wrong' as const] : []),
    ...(app.store.value.changed.length > 0 ? ['changed' as const] : [])];
  return kinds.map(kind => {
    const count = partsOf(app, kind).length;
    return el('div', {class: 'jump'},
      el('button', {type: 'button', class: 'icon-button', 'aria-label': words.list.previous[kind], disabled: count === 0, onclick: () => nextOf(app, kind, -1)}, icon('previous')),
      el('span', {class: 'jump-text'}, el('strong', {class: 'number'}, count.toLocaleString('en')), ` ${words.list.kinds[kind]}`),
      el('button', {type: 'button', class: 'icon-button', id: `next-${kind}`, 'aria-label': words.list.next[kind], disabled: count === 0, onclick: () => nextOf(app, kind, 1)},
        icon('next')));
  });
}

function rowElement(app: App, building: number, facts: Facts, top: number, count: number, place: number): HTMLElement {
  const {buildings, selection} = app.store.value;
  const entry = buildings[building]!;
  const badge = (kind: keyof Facts) => (facts[kind] > 0 ? el('span', {class: `badge badge-${kind}`}, words.list.badge(facts[kind], kind)) : null);
  const worst = entry.issues.find(({severity}) => severity === 'error') ?? entry.issues.find(({severity}) => severity === 'warning');
  const isChosen = selection?.building === building;
  return el('li', {class: `list-row${isChosen ? ' is-chosen' : ''}`, style: {top: `${top}px`}, 'aria-setsize': count, 'aria-posinset': place + 1},
    el('button', {type: 'button', class: 'list-button', 'data-building': building, 'aria-pressed': String(isChosen),
      onclick: () => app.select({building}, true)},
      el('span', {class: 'list-name'}, nameOf(app.store.value, building)), worst ? el('span', {class: `list-issue is-${worst.severity}`, title: worst.sentence, 'aria-label': worst.sentence}, icon('warning')) : null,
      el('span', {class: 'list-facts small quiet'}, words.shell.features(entry.features), badge('wrong'), badge('changed'), badge('doubtful'), badge('unknown'))));
}
