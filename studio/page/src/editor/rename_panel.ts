// The small form that asks for another name, at the top of the editor.
import {StateEffect, StateField, type Extension} from '@codemirror/state';
import {showPanel, type EditorView, type Panel} from '@codemirror/view';

import {el} from '../dom';
import type {Source} from '../source';
import {words} from '../strings';
import {rename, wordAt} from './assistance';

const setOpen = StateEffect.define<{offset: number; word: string} | null>();

const openField = StateField.define<{offset: number; word: string} | null>({
  create: () => null,
  update(value, transaction) {
    for (const effect of transaction.effects) if (effect.is(setOpen)) return effect.value;
    return transaction.docChanged ? null : value;
  },
  provide: field => showPanel.from(field, open => open && (view => formOf(view, open)))
});

let sourceOfForm: Source | null = null;
let tellOfForm: (sentence: string, isGrave?: boolean) => void = () => undefined;

function close(view: EditorView): void {
  view.dispatch({effects: setOpen.of(null)});
  view.focus();
}

async function carryOut(view: EditorView, offset: number, name: string): Promise<void> {
  close(view);
  if (!sourceOfForm || name === '') return;
  try {
    const done = await rename(view, sourceOfForm, offset, name);
    if (typeof done === 'string') tellOfForm(done, true);
    else tellOfForm(done === 0 ? words.editor.notRenamed : words.editor.renamed(done, name));
  } catch (error) {
    tellOfForm(error instanceof Error ? error.message : words.editor.notRenamed, true);
  }
}

function formOf(view: EditorView, open: {offset: number; word: string}): Panel {
  const input = el('input', {'aria-label': words.editor.newName, value: open.word, spellcheck: 'false', autocomplete: 'off'});
  const form = el('form', {
    class: 'rename',
    onsubmit: (event: Event) => { event.preventDefault(); void carryOut(view, open.offset, input.value.trim()); },
    onkeydown: (event: KeyboardEvent) => { if (event.key === 'Escape') close(view); }
  }, el('label', {}, words.editor.renameOf(open.word)), input, el('button', {class: 'button button-main'}, words.editor.rename),
  el('button', {type: 'button', class: 'button', onclick: () => close(view)}, words.editor.cancel));
  return {dom: form, top: true, mount: () => { input.focus(); input.select(); }};
}

export function renaming(source: Source, tell: (sentence: string, isGrave?: boolean) => void): Extension {
  sourceOfForm = source;
  tellOfForm = tell;
  return openField;
}

/** Opens the form for the word under the cursor. */
export function openRename(view: EditorView): boolean {
  const offset = view.state.selection.main.head;
  const word = wordAt(view.state, offset);
  if (word === '') return false;
  view.dispatch({effects: setOpen.of({offset, word})});
  return true;
}
