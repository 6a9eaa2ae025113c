// Search by id, name, label, rule, or an expression of the language (`width > 3 m`). Buildings and labels are found in the page
// itself, the rest by the source.
import type {App} from '../app';
import {el} from '../dom';
import {icon} from '../shell/icons';
import type {Part} from '../source';
import {nameOf} from '../store';
import {words} from '../strings';
import {matchesOf, plain} from './names';

export function searchBox(app: App): {element: HTMLElement; search: (text: string) => void} {
  const input = el('input', {type: 'search', id: 'search', 'aria-label': words.search.label, autocomplete: 'off',
    spellcheck: 'false', enterkeyhint: 'search'});
  const narrow = matchMedia('(max-width: 1099px)');
  const fit = () => { input.placeholder = narrow.matches ? words.search.title : words.search.placeholder; };
  narrow.addEventListener('change', fit);
  fit();
  const run = (text: string) => void search(app, text.trim());
  const element = el('search', {class: 'search'}, el('form', {onsubmit: (event: Event) => { event.preventDefault(); run(input.value); }},
    icon('search'), input));
  input.addEventListener('keydown', event => {
    if (event.key !== 'Escape') return;
    if (input.value === '') input.blur();
    input.value = '';
    app.select(null);
  });
  addEventListener('keydown', event => {
    const target = event.target as HTMLElement;
    if (event.key !== '/' || target.isContentEditable || ['INPUT', 'TEXTAREA', 'SELECT'].includes(target.tagName)) return;
    event.preventDefault();
    input.focus();
    input.select();
  });
  return {element, search: text => { input.value = text; run(text); }};
}

async function search(app: App, text: string): Promise<void> {
  if (text === '') return app.select(null);
  const {store} = app;
  const building = findBuilding(app, text);
  if (building >= 0) {
    store.say('');
    return app.select({building}, true);
  }
  const labelled = findByLabel(app, text);
  if (labelled.length > 0) {
    store.say(words.search.found(labelled.length, text));
    return app.show(labelled, text);
  }
  try {
    const {parts, buildings, findings} = await app.source.search(text);
    // A word that is no attribute is a name that nothing has; only conditions can be wrong.
    if (findings.length > 0) return store.say(/[<>=$(]/.test(text) ? findings[0]!.sentence : words.search.nothing(text), true);
    if (parts.length === 0 && buildings.length > 0) {
      store.say(words.search.buildings(buildings.length, text));
      return app.select({building: buildings[0]!}, true);
    }
    if (parts.length === 0) return store.say(words.search.nothing(text), true);
    store.say(parts.length === 1 ? '' : words.search.found(parts.length, text));
    if (parts.length === 1) app.select({building: parts[0]![0], feature: parts[0]![1]}, true);
    else app.show(parts, text);
  } catch (error) {
    store.say(error instanceof Error ? error.message : words.source.garbled, true);
  }
}

/** The first building with that id, else the first of which it is the beginning; -1 for none, or a label. */
function findBuilding(app: App, text: string): number {
  const {buildings, classes} = app.store.value;
  const meant = plain(text);
  if (!meant || classes.some(({name}) => plain(name) === meant)) return -1;
  for (const matches of matchesOf(text)) {
    const found = buildings.findIndex(({id}, i) => matches(id, true) || matches(nameOf(app.store.value, i), true));
    if (found >= 0) return found;
  }
  return -1;
}

function findByLabel(app: App, text: string): Part[] {
  const {classes, labels} = app.store.value;
  const meant = plain(text);
  const label = meant === words.legend.unknown ? -1 : classes.findIndex(({name}) => plain(name) === meant);
  if (label === -1 && meant !== words.legend.unknown) return [];
  return [...labels].flatMap(([building, list]) => list.flatMap((found, feature): Part[] => (found === label ? [[building, feature]] : [])));
}
