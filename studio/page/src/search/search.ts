// Search by id, name, label, rule, or an expression of the language (`width > 3 m`). Ids and names are found in the page itself, the
// rest by the source.
import type {App} from '../app';
import {el} from '../dom';
import {icon} from '../shell/icons';
import type {Part} from '../source';
import type {Selection} from '../store';
import {words} from '../strings';

export function searchBox(app: App): {element: HTMLElement; search: (text: string) => void} {
  const input = el('input', {type: 'search', id: 'search', placeholder: words.search.placeholder, 'aria-label': words.search.label, autocomplete: 'off',
    spellcheck: 'false', enterkeyhint: 'search'});
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
  const named = findByName(app, text);
  if (named) {
    store.say('');
    return app.select(named, true);
  }
  const labelled = findByLabel(app, text);
  if (labelled.length > 0) {
    store.say(words.search.found(labelled.length, text));
    return app.show(labelled, text);
  }
  if (!app.source.can.search) return store.say(words.search.nothing(text), true);
  try {
    const {parts, findings} = await app.source.search(text);
    // A word that is no attribute is a name that nothing has; only conditions can be wrong.
    if (findings.length > 0) return store.say(/[<>=$(]/.test(text) ? findings[0]!.sentence : words.search.nothing(text), true);
    if (parts.length === 0) return store.say(words.search.nothing(text), true);
    store.say(words.search.found(parts.length, text));
    if (parts.length === 1) app.select({building: parts[0]![0], feature: parts[0]![1]}, true);
    else app.show(parts, text);
  } catch (error) {
    store.say(error instanceof Error ? error.message : words.source.garbled, true);
  }
}

/** As `oriel explain` reads names: case, commas and the number of spaces do not count. */
const plain = (text: string) => text.toLowerCase().split(/[,\s]+/).filter(Boolean).join(' ');

/** The first feature or building with that id or name, else the first of which it is the beginning (of names, by whole words if there
    is one). A label or a bare word is not taken for the beginning of a name. */
export function findByName(app: App, text: string): Selection | null {
  const {geometry, buildings, classes} = app.store.value;
  const meant = plain(text);
  if (!meant || classes.some(({name}) => plain(name) === meant)) return null;
  const matches: ((id: string, isId: boolean) => boolean)[] = [
    (id, isId) => isId && id === text, id => plain(id) === meant, id => plain(id).startsWith(`${meant} `),
    (id, isId) => isId && id.startsWith(text), id => meant.includes(' ') && plain(id).startsWith(meant)
  ];
  for (const matchesName of matches)
    for (let building = 0; building < buildings.length; ++building) {
      const features = geometry.get(building)?.features ?? [];
      const feature = features.findIndex(({id, name}) => matchesName(id, true) || matchesName(name, false));
      if (feature >= 0) return {building, feature};
      if (matchesName(buildings[building]!.id, true)) return {building};
    }
  return null;
}

function findByLabel(app: App, text: string): Part[] {
  const {classes, labels} = app.store.value;
  const meant = plain(text);
  const label = meant === words.legend.unknown ? -1 : classes.findIndex(({name}) => plain(name) === meant);
  if (label === -1 && meant !== words.legend.unknown) return [];
  return [...labels].flatMap(([building, list]) => list.flatMap((found, feature): Part[] => (found === label ? [[building, feature]] : [])));
}
