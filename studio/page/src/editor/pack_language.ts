// The language of rule packs for the editor: YAML, with expressions where the pack has them.

import {yamlLanguage} from '@codemirror/lang-yaml';
import {LanguageSupport, LRLanguage} from '@codemirror/language';
import {parseMixed, type Input, type SyntaxNode, type SyntaxNodeRef} from '@lezer/common';

import {expressionLanguage} from './expression_tokens';

// Parts of a pack whose values are expressions or quantities, and the keys below them whose values are names or prose.
const expressionParts = new Set(['hosts', 'params', 'macros', 'relations', 'rules', 'generalise', 'surfaces', 'invariants', 'decide']);
const proseKeys = new Set(['why', 'id', 'label', 'type', 'name', 'title']);

export function keyOf(pair: SyntaxNode, text: (from: number, to: number) => string): string {
  const key = pair.getChild('Key');
  if (!key) return '';
  return unquoted(text(key.from, key.to).trim());
}

export function unquoted(text: string): string {
  return /^(["']).*\1$/s.test(text) ? text.slice(1, -1) : text;
}

// The keys of the pairs around a node, outermost first: ["rules", "require"].
export function keysAround(node: SyntaxNode, text: (from: number, to: number) => string): string[] {
  const keys: string[] = [];
  for (let at: SyntaxNode | null = node; at; at = at.parent) {
    if (at.name === 'Pair') keys.unshift(keyOf(at, text));
  }
  return keys;
}

function holdsExpression(node: SyntaxNodeRef, input: Input): boolean {
  const keys = keysAround(node.node, (from, to) => input.read(from, to));
  const part = keys[0];
  const last = keys[keys.length - 1];
  if (part === undefined || last === undefined || !expressionParts.has(part) || proseKeys.has(last)) return false;
  const isKey = node.node.parent?.name === 'Key';
  return !isKey || (part === 'rules' && keys[1] === 'score' && keys.length === 3);
}

function innerRange(node: SyntaxNodeRef): {from: number; to: number} {
  return node.name === 'QuotedLiteral' && node.to - node.from >= 2
    ? {from: node.from + 1, to: node.to - 1}
    : {from: node.from, to: node.to};
}

const mixed = parseMixed((node, input) => {
  if (node.name !== 'Literal' && node.name !== 'QuotedLiteral') return null;
  if (!holdsExpression(node, input)) return null;
  const range = innerRange(node);
  return range.from < range.to ? {parser: expressionLanguage.parser, overlay: [range]} : null;
});

export const packLanguage: LRLanguage = yamlLanguage.configure({wrap: mixed}, 'oriel pack');

export function packSupport(): LanguageSupport {
  return new LanguageSupport(packLanguage);
}
