// Where the params of a pack stand in its text, so that a slider edits the text as a hand would: only the value changes.
import {yamlLanguage} from '@codemirror/lang-yaml';
import type {SyntaxNode} from '@lezer/common';

import {keyOf} from './pack_language';

export interface TextChange { from: number; to: number; insert: string }

/** The section `params:` of a pack: only it is parsed, at every step of a slider. */
interface Section { text: string; begin: number; params: SyntaxNode | null }

function pairIn(mapping: SyntaxNode | null, key: string, text: string): SyntaxNode | null {
  const pairs = mapping?.getChildren('Pair') ?? [];
  return pairs.find(pair => keyOf(pair, (from, to) => text.slice(from, to)) === key) ?? null;
}

function valueOf(pair: SyntaxNode | null): SyntaxNode | null {
  const last = pair?.lastChild ?? null;
  return last && last.name !== 'Key' && last.name !== ':' ? last : null;
}

function mappingOf(pair: SyntaxNode | null): SyntaxNode | null {
  const value = valueOf(pair);
  return value && /Mapping$/.test(value.name) ? value : null;
}

function sectionOf(text: string): Section | null {
  const begin = text.search(/^params\s*:/m);
  if (begin < 0) return null;
  const behind = endOfLine(text, begin);
  const next = text.slice(behind).search(/^[^\s#]/m);
  const own = next < 0 ? text.slice(begin) : text.slice(begin, behind + next);
  const top = yamlLanguage.parser.parse(own).topNode.getChild('Document')?.getChild('BlockMapping') ?? null;
  return {text: own, begin, params: mappingOf(pairIn(top, 'params', own))};
}

function indentAt(text: string, offset: number): string {
  return text.slice(text.lastIndexOf('\n', offset - 1) + 1, offset);
}

function insertAt(offset: number, insert: string): TextChange { return {from: offset, to: offset, insert}; }

function endOfLine(text: string, offset: number): number {
  const end = text.indexOf('\n', offset);
  return end < 0 ? text.length : end;
}

/** A new entry of the section, first in it. */
function newEntry(section: Section, name: string, value: string): TextChange {
  const {text, begin, params} = section;
  const first = params?.getChild('Pair') ?? null;
  if (params?.name === 'FlowMapping') return insertAt(begin + params.from + 1, `${name}: {value: ${value}}${first ? ', ' : ''}`);
  if (first) return insertAt(begin + first.from, `${name}: {value: ${value}}\n${indentAt(text, first.from)}`);
  return insertAt(begin + endOfLine(text, 0), `\n  ${name}: {value: ${value}}`);
}

/** A pack without params gets the section, after the lines that say which pack it is. */
function newSection(text: string, name: string, value: string): TextChange {
  const heads = [...text.matchAll(/^(?:schema|pack|extends)\s*:.*$/gm)];
  const last = heads[heads.length - 1];
  const at = last ? last.index + last[0].length : 0;
  const section = `params:\n  ${name}: {value: ${value}}`;
  return insertAt(at, last ? `\n${section}` : `${section}\n`);
}

/**
 * The change that gives a param another value. It replaces the value where this text has one; a pack that extends another gets an
 * entry of its own for a param of its base.
 */
export function changeOfParam(text: string, name: string, value: string): TextChange {
  const section = sectionOf(text);
  if (!section) return newSection(text, name, value);
  const own = mappingOf(pairIn(section.params, name, section.text));
  const old = valueOf(pairIn(own, 'value', section.text));
  if (old) return {from: section.begin + old.from, to: section.begin + old.to, insert: value};
  const first = own?.getChild('Pair');
  if (!own || !first) return newEntry(section, name, value);
  const separator = own.name === 'FlowMapping' ? ', ' : `\n${indentAt(section.text, first.from)}`;
  return insertAt(section.begin + first.from, `value: ${value}${separator}`);
}
