// The tools over the picture, and their keys.
import type {App} from '../app';
import {el, replace} from '../dom';
import {icon} from '../shell/icons';
import {nextOf} from '../list/next_part';
import {nameOf, type ColourMode, type Values} from '../store';
import {words} from '../strings';
import type {BuildingScene} from './building_scene';
import {Cut, cutPanel} from './cut';

/** The chosen building alone, or all again. */
export function showOnly(app: App): void {
  const {only, selection} = app.store.value;
  app.store.set({only: only === null ? selection?.building ?? null : null});
  queueMicrotask(() => app.scene.fly(only === null && selection ? {building: selection.building} : null));
}

type Switch = 'shows_hidden_lines' | 'is_measuring' | 'shows_relations' | 'shows_changes' | 'shows_truth';

export function sceneTools(app: App, scene: BuildingScene): HTMLElement {
  const {store} = app;
  const cut = new Cut(app, scene);
  const cutBox = cutPanel(cut);
  const colourBox = colourPanel(app);
  const toggle = (key: Switch) => store.set({[key]: !store.value[key]} as Partial<Values>);
  const tool = (name: string, label: string, key: string, call: () => void, id = name) =>
    el('button', {type: 'button', class: 'icon-button', id: `tool-${id}`, 'aria-label': label, title: key ? `${label} (${key})` : label, onclick: call}, icon(name));
  const switchOf = (key: Switch, name: string, label: string, shortcut: string) => {
    const button = tool(name, label, shortcut, () => toggle(key));
    store.watch([key], () => button.setAttribute('aria-pressed', String(store.value[key])));
    return button;
  };
  const opener = (box: HTMLElement, button: HTMLButtonElement) => {
    button.setAttribute('aria-expanded', 'false');
    button.addEventListener('click', () => {
      for (const other of [cutBox, colourBox]) if (other !== box) other.hidden = true;
      box.hidden = !box.hidden;
      button.setAttribute('aria-expanded', String(!box.hidden));
    });
    return button;
  };
  const fit = () => scene.fly(store.value.selection);
  const truth = switchOf('shows_truth', 'truth', words.scene.truth, 'T');
  store.watch(['has_truth'], () => { truth.hidden = !store.value.has_truth; });
  const onlyButton = tool('eye', words.scene.only, 'O', () => showOnly(app), 'only');
  store.watch(['only', 'selection', 'buildings'], () => {
    const {only, selection, buildings} = store.value;
    onlyButton.hidden = buildings.length < 2;
    onlyButton.disabled = !selection && only === null;
    onlyButton.setAttribute('aria-pressed', String(only !== null));
  });
  const cutButton = opener(cutBox, tool('section', words.scene.section, 'X', () => {}));
  const bar = el('div', {class: 'tool-bar', role: 'toolbar', 'aria-label': words.scene.tools},
    tool('fit', words.scene.fit, 'F', fit),
    opener(colourBox, tool('palette', words.scene.colours, '', () => {})),
    cutButton,
    onlyButton,
    switchOf('shows_hidden_lines', 'hidden', words.scene.hiddenLines, 'H'),
    switchOf('is_measuring', 'measure', words.scene.measure, 'M'),
    switchOf('shows_relations', 'relations', words.scene.relations, 'R'),
    app.source.can.edit ? switchOf('shows_changes', 'changes', words.scene.changes, '') : null,
    truth);
  const hint = el('p', {class: 'scene-hint', role: 'status'});
  store.watch(['is_measuring'], () => {
    hint.textContent = store.value.is_measuring ? words.scene.measureHint : '';
    scene.host.classList.toggle('is-measuring', store.value.is_measuring);
  });
  scene.element.setAttribute('role', 'application');
  scene.element.setAttribute('aria-label', words.scene.name);
  const keys = new Map<string, () => void>([
    ['f', fit], ['h', () => toggle('shows_hidden_lines')], ['m', () => toggle('is_measuring')], ['r', () => toggle('shows_relations')],
    ['t', () => toggle('shows_truth')], ['x', () => cutButton.click()], ['o', () => onlyButton.click()],
    ['1', () => scene.camera.lookAlong('front', scene.corners())], ['2', () => scene.camera.lookAlong('side', scene.corners())],
    ['3', () => scene.camera.lookAlong('above', scene.corners())],
    ['n', () => nextOf(app, 'unknown', 1)], ['N', () => nextOf(app, 'unknown', -1)], ['d', () => nextOf(app, 'doubtful', 1)],
    ['D', () => nextOf(app, 'doubtful', -1)], ['w', () => nextOf(app, 'wrong', 1)], ['W', () => nextOf(app, 'wrong', -1)],
    ['Escape', () => store.value.is_measuring ? toggle('is_measuring') : app.select(null)]
  ]);
  addEventListener('keydown', event => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (target.isContentEditable || ['INPUT', 'TEXTAREA', 'SELECT'].includes(target.tagName) || target.closest('dialog')) return;
    keys.get(event.key)?.();
  });
  return el('div', {class: 'scene-tools'}, bar, placeNote(app), cutBox, colourBox, hint);
}

/** Says which buildings are not where they really are, and which are too far away to be in the picture. */
function placeNote(app: App): HTMLElement {
  const kMostNamed = 3;
  const note = el('p', {class: 'scene-note', role: 'status'});
  app.store.watch(['buildings', 'issues'], () => {
    const {buildings, issues} = app.store.value;
    const far = buildings.flatMap(({away_m}, building) => (away_m === undefined ? [] : [building]));
    const links = far.slice(0, kMostNamed).flatMap(building => [' ', el('button', {type: 'button', class: 'link', onclick: () => app.select({building}, true)},
      words.scene.awayBy(nameOf(app.store.value, building), buildings[building]!.away_m!))]);
    const faults = issues.filter(({severity}) => severity === 'error');
    replace(note, faults[0] ? el('span', {class: 'grave'}, words.scene.unread(faults.length, `${faults[0].file ?? ''}: ${faults[0].sentence}`)) : null, buildings.some(({is_moved}) => is_moved) ? el('span', {}, words.scene.moved) : null,
      far.length > 0 ? el('span', {}, words.scene.away(far.length), ...links) : null);
  });
  return note;
}

function colourPanel(app: App): HTMLElement {
  const {store} = app;
  const modes: [ColourMode, string][] = [['colour', words.scene.colour], ['pattern', words.scene.pattern], ['heat', words.scene.heat]];
  const inputs = modes.map(([mode, label]) => {
    const input = el('input', {type: 'radio', name: 'colours', value: mode, onchange: () => store.set({colours: mode})});
    store.watch(['colours'], () => { input.checked = store.value.colours === mode; });
    return el('label', {class: 'choice'}, input, label);
  });
  const select = el('select', {'aria-label': words.scene.heatOf, onchange: () => {
    const value = select.value;
    store.set({heat: /^\d+$/.test(value) ? Number(value) : value as 'unknown', colours: 'heat'});
  }});
  store.watch(['classes', 'has_truth', 'heat'], () => {
    const {classes, has_truth, heat} = store.value;
    const kinds = ['unknown', 'doubtful', 'changed', ...(has_truth ? ['wrong'] : [])] as const;
    replace(select, ...kinds.map(kind => el('option', {value: kind}, words.scene.heatKinds[kind as 'unknown'])),
      ...classes.map(({name}, i) => el('option', {value: i}, name)));
    select.value = String(heat);
  });
  return el('div', {class: 'popover', hidden: true, role: 'group', 'aria-label': words.scene.colours}, ...inputs, el('label', {class: 'row'}, words.scene.heatOf, select));
}

