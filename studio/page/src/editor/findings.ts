// Findings of the compiler in the editor: underlined with their advice and fixes, and listed below it.
import {setDiagnostics, type Action, type Diagnostic} from '@codemirror/lint';
import type {Text} from '@codemirror/state';
import type {EditorView} from '@codemirror/view';

import {el, replace} from '../dom';
import type {Finding, Fix} from '../source';
import {words} from '../strings';
import {inlineOf} from './prose';
import {changesOf, visibleRangeOf} from './text_places';

const kSeverities = {error: 'error', warning: 'warning', note: 'info'} as const;

export function applyFix(view: EditorView, fix: Fix): void {
  view.dispatch({changes: changesOf(view.state.doc, fix.edits), userEvent: 'input.fix', scrollIntoView: true});
  view.focus();
}

function actionsOf(finding: Finding): Action[] {
  return finding.fixes.map(fix => ({name: fix.title, apply: view => applyFix(view, fix)}));
}

function messageOf(finding: Finding): HTMLElement {
  return el('div', {class: 'finding-text'},
    el('p', {}, finding.sentence, ' ', el('span', {class: 'code'}, finding.code)),
    finding.advice !== '' && el('p', {class: 'advice'}, ...inlineOf(finding.advice.replaceAll('\n', ' '))));
}

function diagnosticOf(doc: Text, finding: Finding): Diagnostic {
  return {
    ...visibleRangeOf(doc, finding), severity: kSeverities[finding.severity] ?? 'info', message: finding.sentence,
    renderMessage: () => messageOf(finding), actions: actionsOf(finding)
  };
}

/** Underlines the findings, if they were made for the text that stands in the editor. */
export function underline(view: EditorView, findings: readonly Finding[]): void {
  const doc = view.state.doc;
  const own = findings.filter(finding => finding.line > 0);
  view.dispatch(setDiagnostics(view.state, own.map(finding => diagnosticOf(doc, finding))));
}

function itemOf(view: EditorView, finding: Finding, openLine: (line: number) => void): HTMLElement {
  const fixes = finding.fixes.map(fix => el('button', {type: 'button', class: 'button fix', onclick: () => applyFix(view, fix)}, fix.title));
  return el('li', {class: `finding is-${finding.severity}`},
    el('button', {type: 'button', class: 'finding-place', onclick: () => openLine(finding.line)},
      el('span', {class: 'finding-line'}, words.editor.line(finding.line)),
      el('span', {}, finding.sentence)),
    finding.advice !== '' && el('p', {class: 'advice'}, ...inlineOf(finding.advice.replaceAll('\n', ' '))),
    fixes.length > 0 && el('p', {class: 'fixes'}, ...fixes));
}

/** The list below the editor: errors first, in the order of the text. */
export function listFindings(list: HTMLElement, view: EditorView, findings: readonly Finding[], openLine: (line: number) => void): void {
  const rank = {error: 0, warning: 1, note: 2};
  const sorted = [...findings].sort((a, b) => rank[a.severity] - rank[b.severity] || a.line - b.line);
  replace(list, ...sorted.map(finding => itemOf(view, finding, openLine)));
}
