// What the language service gives the editor: completion, hover, definition, rename, format. Everything is asked by text and
// place; an answer to a text that has changed meanwhile is dropped.
import {snippetCompletion, type Completion, type CompletionContext, type CompletionResult} from '@codemirror/autocomplete';
import type {EditorState} from '@codemirror/state';
import {hoverTooltip, type EditorView, type Tooltip} from '@codemirror/view';

import {el} from '../dom';
import type {CompletionItem, Source} from '../source';
import {proseOf} from './prose';
import {changesOf, placeOf, rangeOf, smallestChange} from './text_places';

// Kinds of the language service, as the editor's icons know them.
const kKinds = new Map([
  ['attribute', 'property'], ['relation', 'interface'], ['class', 'class'], ['macro', 'function'], ['param', 'variable'],
  ['keyword', 'keyword'], ['function', 'method'], ['key', 'keyword'], ['operator', 'namespace'], ['unit', 'constant'],
  ['value', 'enum'], ['word', 'enum'], ['rule', 'text']
]);

function question(state: EditorState, offset: number) {
  return {text: state.doc.toString(), ...placeOf(state.doc, offset)};
}

/** The documentation of an item: what it is and in which unit, as text. */
function infoOf(item: CompletionItem): (() => HTMLElement) | undefined {
  if (item.documentation === '') return undefined;
  return () => el('div', {class: 'hint'}, ...proseOf(item.documentation));
}

function completionOf(item: CompletionItem, rank: number): Completion {
  const shown: Completion = {label: item.label, type: kKinds.get(item.kind) ?? 'text', boost: -Math.min(rank, 90)};
  if (item.detail !== '') shown.detail = item.detail;
  const info = infoOf(item);
  if (info) shown.info = info;
  const insert = item.insert === '' ? item.label : item.insert;
  if (/\$\{?\d/.test(insert)) return snippetCompletion(insert.replace(/\$(\d)/g, '${$1}').replace(/\$\{(\d+):/g, '${'), shown);
  if (insert !== item.label) shown.apply = insert;
  return shown;
}

export function completionSource(source: Source): (context: CompletionContext) => Promise<CompletionResult | null> {
  return async context => {
    const before = context.matchBefore(/[$\w]+/);
    const line = context.state.doc.lineAt(context.pos);
    const opens = /[\s([{,:]$/.test(line.text.slice(0, context.pos - line.from));
    if (!before && !context.explicit && !opens) return null;
    if (!context.explicit && /^\s*(#.*)?$/.test(line.text.slice(0, context.pos - line.from))) return null;
    const answer = await source.language({verb: 'complete', ...question(context.state, context.pos)});
    if (context.aborted || answer.items.length === 0) return null;
    const columns = answer.items.map(item => item.from_column).filter(column => column > 0);
    const from = columns.length > 0 ? line.from + Math.min(...columns) - 1 : before?.from ?? context.pos;
    return {from: Math.min(from, context.pos), options: answer.items.map(completionOf), validFor: /^[$\w]*$/};
  };
}

export function hoverSource(source: Source) {
  return hoverTooltip(async (view: EditorView, offset: number): Promise<Tooltip | null> => {
    const doc = view.state.doc;
    const answer = await source.language({verb: 'hover', ...question(view.state, offset)});
    if (!answer || view.state.doc !== doc) return null;
    const range = rangeOf(doc, answer);
    return {
      pos: range.from, end: range.to, above: true,
      create: () => ({dom: el('div', {class: 'hint hint-hover'}, ...proseOf(answer.text))})
    };
  }, {hoverTime: 250});
}

/** Moves the cursor to what the word under it means. False if that is nowhere in this text. */
export async function goToDefinition(view: EditorView, source: Source, offset = view.state.selection.main.head): Promise<boolean> {
  const doc = view.state.doc;
  const answer = await source.language({verb: 'definition', ...question(view.state, offset)});
  if (!answer || view.state.doc !== doc) return false;
  const range = rangeOf(doc, answer);
  view.dispatch({selection: {anchor: range.from, head: range.to}, scrollIntoView: true, userEvent: 'select.definition'});
  view.focus();
  return true;
}

/** Gives what the cursor is on another name, everywhere in the pack. Returns how many places changed, or why none did. */
export async function rename(view: EditorView, source: Source, offset: number, name: string): Promise<number | string> {
  const doc = view.state.doc;
  const answer = await source.language({verb: 'rename', ...question(view.state, offset), name});
  if (view.state.doc !== doc) return 0;
  const refusal = answer.findings?.[0];
  if (refusal && answer.edits.length === 0) return refusal.sentence;
  view.dispatch({changes: changesOf(doc, answer.edits), userEvent: 'input.rename'});
  return answer.edits.length;
}

/** Writes the pack in its canonical form, as one change that undo takes back. False if it has errors. */
export async function format(view: EditorView, source: Source): Promise<boolean> {
  const doc = view.state.doc;
  const answer = await source.language({verb: 'format', ...question(view.state, 0)});
  if (view.state.doc !== doc || answer.text === undefined) return false;
  const change = smallestChange(doc.toString(), answer.text);
  if (change) view.dispatch({changes: change, userEvent: 'input.format'});
  return true;
}

/** The word at a place, for the dialog of rename. */
export function wordAt(state: EditorState, offset: number): string {
  const range = state.wordAt(offset);
  return range ? state.sliceDoc(range.from, range.to) : '';
}
