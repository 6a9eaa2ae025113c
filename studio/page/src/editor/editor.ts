// The panel of the editor: its bar, the text, the findings below it.
import {redo, redoDepth, undo, undoDepth} from '@codemirror/commands';
import {Prec} from '@codemirror/state';
import {EditorView, keymap} from '@codemirror/view';

import type {App, Panel} from '../app';
import {el} from '../dom';
import {Saving} from '../saving/saving';
import {words} from '../strings';
import {format, goToDefinition} from './assistance';
import {authorOf, type Author} from './author';
import {packEditing} from './editor_setup';
import {listFindings, underline} from './findings';
import {openRename, renaming} from './rename_panel';
import {starters} from './starters';

/** Does it, and tells the reader if it cannot be done. */
function attempt(app: App, work: () => Promise<string | void>): boolean {
  work().then(sentence => { if (sentence) app.store.say(sentence); })
    .catch((error: unknown) => app.store.say(error instanceof Error ? error.message : String(error), true));
  return true;
}

function define(app: App, author: Author): boolean {
  return attempt(app, async () => {
    if (!await goToDefinition(author.view, app.source)) return words.editor.noDefinition;
    return undefined;
  });
}

function formatPack(app: App, author: Author): boolean {
  return attempt(app, async () => await format(author.view, app.source) ? words.editor.formatted : words.editor.notFormatted);
}

function keysOf(app: App, author: Author, saving: Saving) {
  return Prec.high(keymap.of([
    {key: 'Mod-s', run: () => attempt(app, () => saving.save()), preventDefault: true},
    {key: 'F12', run: () => define(app, author), preventDefault: true},
    {key: 'Mod-F12', run: () => define(app, author), preventDefault: true},
    {key: 'F2', run: view => openRename(view), preventDefault: true},
    {key: 'Shift-Alt-f', run: () => formatPack(app, author), preventDefault: true}
  ]));
}

/** Ctrl and a click goes to the definition, as F12 does. */
function definitionByClick(app: App) {
  return EditorView.domEventHandlers({
    mousedown: (event, view) => {
      if (!(event.ctrlKey || event.metaKey) || event.button !== 0) return false;
      const offset = view.posAtCoords({x: event.clientX, y: event.clientY});
      if (offset === null) return false;
      event.preventDefault();
      return attempt(app, async () => { await goToDefinition(view, app.source, offset); });
    }
  });
}

/** Saving and undo work wherever the reader is, but not over the undo of a field that is being written in. */
function bindPage(app: App, author: Author, saving: Saving): void {
  addEventListener('keydown', event => {
    const target = event.target as HTMLElement;
    if (event.defaultPrevented || !(event.ctrlKey || event.metaKey) || event.altKey || document.querySelector('dialog[open]')) return;
    const isWriting = target.isContentEditable || target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && target.type !== 'range');
    const key = event.key.toLowerCase();
    const run = key === 's' ? () => attempt(app, () => saving.save())
      : isWriting ? undefined
        : key === 'z' && !event.shiftKey ? () => undo(author.view) : key === 'y' || key === 'z' ? () => redo(author.view) : undefined;
    if (!run) return;
    event.preventDefault();
    run();
  });
}

function tool(label: string, hint: string, run: () => void, members: Record<string, string> = {}): HTMLButtonElement {
  return el('button', {type: 'button', class: 'button tool', title: hint, onclick: run, ...members}, label);
}

function barOf(app: App, author: Author, saving: Saving): HTMLElement {
  const name = el('span', {class: 'pack-file'});
  const state = el('span', {class: 'pack-state', role: 'status'});
  const undoTool = tool('↶', words.editor.undoHint, () => { undo(author.view); author.view.focus(); }, {'aria-label': words.editor.undo});
  const redoTool = tool('↷', words.editor.redoHint, () => { redo(author.view); author.view.focus(); }, {'aria-label': words.editor.redo});
  const diffTool = tool(words.save.diff, words.save.diffHint, () => saving.toggleDiff(), {'aria-pressed': 'false'});
  const saveTool = tool(words.save.save, words.save.saveHint, () => void attempt(app, () => saving.save()), {id: 'save-pack'});
  saveTool.classList.add('button-main');
  const update = () => {
    name.textContent = app.store.value.pack.path?.split('/').pop() ?? app.store.value.pack.name;
    state.textContent = author.isDirty ? words.save.unsaved : app.store.value.pack.path === null ? words.save.builtIn : words.save.saved;
    undoTool.disabled = undoDepth(author.view.state) === 0;
    redoTool.disabled = redoDepth(author.view.state) === 0;
    diffTool.disabled = !author.isDirty && !saving.isDiffOpen;
    diffTool.setAttribute('aria-pressed', String(saving.isDiffOpen));
  };
  author.watch(update);
  saving.onChange(update);
  app.store.watch(['pack'], update);
  return el('div', {class: 'pack-bar', role: 'toolbar', 'aria-label': words.editor.bar},
    el('span', {class: 'pack-title'}, name, state), undoTool, redoTool, diffTool, saveTool);
}

/** The findings below the text: a line that sums them up, which opens the list. */
function findingsOf(app: App, author: Author): HTMLElement {
  const list = el('ul', {class: 'findings-list', 'aria-label': words.editor.findings});
  const summary = el('summary', {}, '');
  const box = el('details', {class: 'findings'}, summary, list);
  app.store.watch(['findings'], () => {
    const {findings} = app.store.value;
    const errors = findings.filter(finding => finding.severity === 'error').length;
    summary.textContent = words.editor.summary(errors, findings.length - errors);
    box.classList.toggle('is-bad', errors > 0);
    box.hidden = findings.length === 0;
    listFindings(list, author.view, findings, line => app.openLine(line));
  });
  return box;
}

export function editorPanel(app: App): Panel {
  const author = authorOf(app);
  const saving = new Saving(app, author);
  const text = el('div', {class: 'editor-text'}, author.view.dom, starters(author));
  const element = el('div', {class: 'panel editor'}, barOf(app, author, saving), saving.banner, text, findingsOf(app, author));

  let hasBegun = false;
  app.store.watch(['pack'], () => {
    const {pack} = app.store.value;
    if (hasBegun || (pack.hash === '' && pack.name === '')) return;
    hasBegun = true;
    author.begin(pack.text, pack.hash, [
      keysOf(app, author, saving), definitionByClick(app), renaming(app.source, (sentence, isGrave) => app.store.say(sentence, isGrave)),
      packEditing(app.source)
    ]);
    saving.watchDisk();
    bindPage(app, author, saving);
  });
  author.loop.onAnswer(() => underline(author.view, app.store.value.findings));
  return {id: 'editor', title: words.editor.title, element, onShow: () => author.view.requestMeasure()};
}
