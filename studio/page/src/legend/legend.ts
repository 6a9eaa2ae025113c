// The labels with their colours and counts, as a filter: each can be hidden or shown alone.
import type {App, Panel} from '../app';
import {el, replace} from '../dom';
import {sharesOf, topOf} from '../scene/heat';
import {heatColour, looksOf, patchStyle, surfaceColours, type Look} from '../scene/palette';
import {icon} from '../shell/icons';
import {words} from '../strings';

/** What is no class of the pack: features without a label, and what lies in no feature. */
const kUnknown = -1, kSurfaces = -2;

interface Row { label: number; name: string; look: Look; count: number | null }

export function legendPanel(app: App): Panel {
  const list = el('ul', {class: 'legend-list'});
  const all = el('button', {type: 'button', class: 'link small', onclick: () => setHidden(app, new Set())}, words.legend.all);
  const scale = el('div', {class: 'legend-scale'});
  const fold = el('button', {type: 'button', class: 'legend-fold', 'aria-expanded': 'true', onclick: () => {
    const isOpen = fold.getAttribute('aria-expanded') !== 'true';
    fold.setAttribute('aria-expanded', String(isOpen));
    body.hidden = !isOpen;
  }}, words.legend.title);
  const body = el('div', {}, scale, list);
  const element = el('section', {class: 'legend', 'aria-label': words.legend.title},
    el('div', {class: 'legend-head'}, el('h3', {}, fold), all), body);
  app.store.watch(['classes', 'counts', 'unknown', 'filter', 'colours', 'heat', 'labels'], () => {
    const isHeat = app.store.value.colours === 'heat';
    scale.hidden = !isHeat;
    list.hidden = isHeat;
    if (isHeat) return replace(scale, ...heatScale(app));
    const rows = rowsOf(app);
    const hidden = app.store.value.filter.hidden;
    all.hidden = hidden.size === 0;
    const focused = (document.activeElement as HTMLElement | null)?.dataset['key'];
    replace(list, ...rows.map(row => rowElement(app, row, rows)));
    if (focused) list.querySelector<HTMLElement>(`[data-key="${focused}"]`)?.focus();
  });
  return {id: 'legend', title: words.legend.title, element};
}

/** What the colours of the heat map mean. */
function heatScale(app: App): HTMLElement[] {
  const {heat, classes} = app.store.value;
  const name = typeof heat === 'number' ? classes[heat]?.name ?? '' : words.scene.heatKinds[heat];
  const percent = Math.round(100 * topOf(sharesOf(app.store.value)));
  const colours = [0, 0.25, 0.5, 0.75, 1].map(heatColour).join(', ');
  return [el('p', {class: 'small'}, words.legend.shareOf(name)), el('div', {class: 'legend-bar', style: {background: `linear-gradient(90deg, ${colours})`}}),
    el('p', {class: 'legend-ends small quiet number'}, el('span', {}, '0 %'), el('span', {}, `${percent} %`))];
}

function rowsOf(app: App): Row[] {
  const {counts, unknown, classes, colours} = app.store.value;
  const looks = looksOf(classes, colours === 'pattern');
  const number = new Map(counts.map(entry => [entry.class, entry.count]));
  const rows: Row[] = classes.flatMap(({name}, label) => {
    const count = number.get(name) ?? 0;
    return count > 0 ? [{label, name, look: looks[label]!, count}] : [];
  });
  rows.sort((a, b) => b.count! - a.count! || a.name.localeCompare(b.name, 'en'));
  const plain = {colour: surfaceColours.wall, pattern: colours === 'pattern' ? 5 : 0};
  if (unknown > 0) rows.push({label: kUnknown, name: words.legend.unknown, look: plain, count: unknown});
  rows.push({label: kSurfaces, name: words.legend.surfaces, look: {colour: surfaceColours.roof, pattern: 0}, count: null});
  return rows;
}

function rowElement(app: App, row: Row, rows: Row[]): HTMLElement {
  const hidden = app.store.value.filter.hidden;
  const isHidden = hidden.has(row.label);
  const others = rows.filter(({label}) => label !== row.label).map(({label}) => label);
  const isOnly = !isHidden && others.length > 0 && others.every(label => hidden.has(label));
  const toggle = () => {
    const next = new Set(hidden);
    if (!next.delete(row.label)) next.add(row.label);
    setHidden(app, next);
  };
  const only = () => setHidden(app, isOnly ? new Set() : new Set(others));
  return el('li', {class: isHidden ? 'is-hidden' : ''},
    el('button', {type: 'button', class: 'legend-row', 'data-key': `show ${row.label}`, 'data-label': row.name, 'aria-pressed': String(!isHidden),
      'aria-label': row.count === null ? row.name : words.legend.row(row.name, row.count), title: isHidden ? words.legend.show : words.legend.hide, onclick: toggle},
      el('span', {class: 'patch', style: patchStyle(row.look)}), el('span', {class: 'legend-name'}, row.name),
      el('span', {class: 'number quiet'}, row.count === null ? '' : row.count.toLocaleString('en'))),
    el('button', {type: 'button', class: 'legend-only', 'data-key': `only ${row.label}`, 'aria-pressed': String(isOnly),
      'aria-label': words.legend.onlyOf(row.name), onclick: only}, isOnly ? words.legend.all : words.legend.only),
    el('button', {type: 'button', class: 'legend-find', 'data-key': `find ${row.label}`, 'aria-label': words.legend.markAll(row.name), title: words.legend.markAll(row.name),
      hidden: row.label === kSurfaces, onclick: () => markAll(app, row)}, icon('search')));
}

/** Marks all parts of a label. */
function markAll(app: App, row: Row): void {
  const parts = [...app.store.value.labels].flatMap(([building, labels]) =>
    labels.flatMap((label, feature): [number, number][] => (label === row.label ? [[building, feature]] : [])));
  app.show(parts, words.legend.row(row.name, parts.length));
}

function setHidden(app: App, hidden: ReadonlySet<number>): void { app.store.set({filter: {hidden}}); }
