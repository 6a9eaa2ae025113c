// Two texts of a pack as a diff: in the editor itself, or read-only in a panel or a dialog.
import {MergeView, unifiedMergeView} from '@codemirror/merge';
import {EditorState, type Extension} from '@codemirror/state';
import {EditorView} from '@codemirror/view';

import {packLook} from '../editor/editor_setup';
import {el} from '../dom';
import {words} from '../strings';

const kCollapse = {margin: 2, minSize: 6};

function control(label: string) {
  return (type: 'reject' | 'accept', action: (event: MouseEvent) => void) => type === 'accept'
    ? el('span', {hidden: true})
    : el('button', {type: 'button', class: 'undo-chunk', onmousedown: action}, label);
}

/** For the editor: what differs from `original` is marked, and each place can be taken back. */
export function diffAgainst(original: string): Extension {
  return unifiedMergeView({original, mergeControls: control(words.save.takeBack), collapseUnchanged: kCollapse, gutter: true});
}

/** A proposal beside nothing else: what it would change, with each change to leave out. `textOf` gives what is left of it. */
export function proposalView(original: string, proposal: string): {element: HTMLElement; textOf: () => string; destroy: () => void} {
  const view = new EditorView({
    doc: proposal,
    extensions: [
      packLook(), EditorView.contentAttributes.of({'aria-label': words.learn.proposal, tabindex: '0'}), EditorView.editable.of(false),
      unifiedMergeView({original, mergeControls: control(words.learn.leaveOut), collapseUnchanged: kCollapse})
    ]
  });
  return {element: el('div', {class: 'proposal-text'}, view.dom), textOf: () => view.state.doc.toString(), destroy: () => view.destroy()};
}

/** What a change makes of a text, to read. */
export function changeView(original: string, changed: string): {element: HTMLElement; destroy: () => void} {
  const view = new EditorView({
    doc: changed,
    extensions: [packLook(), EditorView.contentAttributes.of({'aria-label': words.learn.showDiff, tabindex: '0'}), EditorView.editable.of(false),
      unifiedMergeView({original, mergeControls: false, collapseUnchanged: kCollapse})]
  });
  return {element: el('div', {class: 'proposal-text'}, view.dom), destroy: () => view.destroy()};
}

/** Two texts side by side: the left one stays, the right one is edited, and changes can be taken over from the left. */
export function sideBySide(left: string, right: string, names: [left: string, right: string]) {
  const named = (name: string) => EditorView.contentAttributes.of({'aria-label': name});
  const merge = new MergeView({
    a: {doc: left, extensions: [packLook(), named(names[0]), EditorState.readOnly.of(true)]},
    b: {doc: right, extensions: [packLook(), named(names[1])]},
    collapseUnchanged: kCollapse, revertControls: 'a-to-b',
    renderRevertControl: () => el('button', {type: 'button', class: 'take-chunk', title: words.save.takeOver, 'aria-label': words.save.takeOver}, '→')
  });
  return {element: merge.dom, textOf: () => merge.b.state.doc.toString(), destroy: () => merge.destroy()};
}
