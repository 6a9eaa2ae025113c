// Places in a text: the interface counts lines and columns from 1, in UTF-16 units; the editor counts from 0.

import {Text, type ChangeSpec} from '@codemirror/state';

export interface Place {
  line: number;
  column: number;
}

export interface Span extends Place {
  end_line: number;
  end_column: number;
}

export interface Edit extends Span {
  text: string;
}

// The offset of a place, moved into the text if it lies outside.
export function offsetOf(doc: Text, place: Place): number {
  if (place.line < 1) return 0;
  if (place.line > doc.lines) return doc.length;
  const line = doc.line(place.line);
  return Math.min(line.from + Math.max(place.column - 1, 0), line.to);
}

export function placeOf(doc: Text, offset: number): Place {
  const line = doc.lineAt(offset);
  return {line: line.number, column: offset - line.from + 1};
}

export function rangeOf(doc: Text, span: Span): {from: number; to: number} {
  const from = offsetOf(doc, span);
  return {from, to: Math.max(from, offsetOf(doc, {line: span.end_line, column: span.end_column}))};
}

// The same range, made at least one character long so that it can be seen.
export function visibleRangeOf(doc: Text, span: Span): {from: number; to: number} {
  const range = rangeOf(doc, span);
  if (range.to > range.from) return range;
  const line = doc.lineAt(range.from);
  if (range.from < line.to) return {from: range.from, to: range.from + 1};
  return {from: Math.max(line.from, range.from - 1), to: range.from};
}

export function changesOf(doc: Text, edits: readonly Edit[]): ChangeSpec[] {
  return edits.map((edit) => ({...rangeOf(doc, edit), insert: edit.text}));
}

// The one change that makes `after` of `before`, without their common beginning and end: cursors outside it stay.
export function smallestChange(before: string, after: string): {from: number; to: number; insert: string} | null {
  if (before === after) return null;
  const shorter = Math.min(before.length, after.length);
  let from = 0;
  while (from < shorter && before.charCodeAt(from) === after.charCodeAt(from)) ++from;
  let tail = 0;
  while (tail < shorter - from && before.charCodeAt(before.length - 1 - tail) === after.charCodeAt(after.length - 1 - tail)) ++tail;
  return {from, to: before.length - tail, insert: after.slice(from, after.length - tail)};
}
