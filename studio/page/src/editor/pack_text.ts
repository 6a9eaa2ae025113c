// Where the params of a pack stand in its text, so that a slider edits the text like a hand would: only the value changes.

import type {SyntaxNode, Tree} from '@lezer/common';

import {keyOf, packLanguage} from './pack_language';

export interface TextRange {
  from: number;
  to: number;
}

export interface TextChange extends TextRange {
  insert: string;
}

// A pair of the mapping `mapping` whose key is `key`.
function pairIn(mapping: SyntaxNode | null, key: string, text: string): SyntaxNode | null {
  for (const pair of mapping?.getChildren('Pair') ?? []) {
    if (keyOf(pair, (from, to) => text.slice(from, to)) === key) return pair;
  }
  return null;
}

function valueOf(pair: SyntaxNode | null): SyntaxNode | null {
  const last = pair?.lastChild ?? null;
  return last && last.name !== 'Key' && last.name !== ':' ? last : null;
}

function mappingOf(pair: SyntaxNode | null): SyntaxNode | null {
  const value = valueOf(pair);
  return value && /Mapping$/.test(value.name) ? value : null;
}

function topMapping(tree: Tree): SyntaxNode | null {
  return tree.topNode.getChild('Document')?.getChild('BlockMapping') ?? null;
}

export function parsePack(text: string): Tree {
  return packLanguage.parser.parse(text);
}

// Where the value of a param stands ("0.6 m" in `sill: {value: 0.6 m, …}`), or null if this text has none.
export function paramValueRange(tree: Tree, text: string, name: string): TextRange | null {
  const params = mappingOf(pairIn(topMapping(tree), 'params', text));
  const value = valueOf(pairIn(mappingOf(pairIn(params, name, text)), 'value', text));
  return value ? {from: value.from, to: value.to} : null;
}

function lineEnd(text: string, offset: number): number {
  const end = text.indexOf('\n', offset);
  return end < 0 ? text.length : end;
}

function indentAt(text: string, offset: number): string {
  return text.slice(text.lastIndexOf('\n', offset - 1) + 1, offset);
}

// A pack that extends another gets a line of its own for a param of its base.
function newParam(tree: Tree, text: string, name: string, value: string): TextChange {
  const top = topMapping(tree);
  const params = mappingOf(pairIn(top, 'params', text));
  const first = params?.getChild('Pair') ?? null;
  if (params?.name === 'FlowMapping') {
    const at = params.from + 1;
    return {from: at, to: at, insert: `${name}: {value: ${value}}${first ? ', ' : ''}`};
  }
  if (params && first) {
    const indent = indentAt(text, first.from);
    return {from: first.from, to: first.from, insert: `${name}: {value: ${value}}\n${indent}`};
  }
  const before = pairIn(top, 'params', text) ?? pairIn(top, 'extends', text) ?? pairIn(top, 'pack', text);
  const at = before ? lineEnd(text, before.to) : text.length;
  const head = pairIn(top, 'params', text) ? '' : '\nparams:';
  return {from: at, to: at, insert: `${head}\n  ${name}: {value: ${value}}`};
}

// The change that gives a param another value: of its value where the text has one, else a new entry.
export function changeOfParam(tree: Tree, text: string, name: string, value: string): TextChange {
  const range = paramValueRange(tree, text, name);
  if (range) return {...range, insert: value};
  const params = mappingOf(pairIn(topMapping(tree), 'params', text));
  const own = mappingOf(pairIn(params, name, text));
  const first = own?.getChild('Pair');
  if (!own || !first) return newParam(tree, text, name, value);
  const separator = own.name === 'FlowMapping' ? ', ' : `\n${indentAt(text, first.from)}`;
  return {from: first.from, to: first.from, insert: `value: ${value}${separator}`};
}
