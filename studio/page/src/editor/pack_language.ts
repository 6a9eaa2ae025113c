// Rule packs in the editor: YAML, and colours for the expressions where the pack has them. Only the lines on the screen are
// coloured, so that a long pack costs no more than a short one.
import {yamlLanguage} from '@codemirror/lang-yaml';
import {LanguageSupport, syntaxTree} from '@codemirror/language';
import {RangeSetBuilder, type Extension} from '@codemirror/state';
import {Decoration, ViewPlugin, type DecorationSet, type EditorView, type ViewUpdate} from '@codemirror/view';
import type {SyntaxNode} from '@lezer/common';

import {tokensOf} from './expression_tokens';

type ReadText = (from: number, to: number) => string;

/** Parts of a pack whose values are expressions or quantities, and keys below them whose values are names or prose. */
const kExpressionParts = new Set(['hosts', 'params', 'macros', 'relations', 'rules', 'generalise', 'surfaces', 'invariants', 'decide']);
const kProseKeys = new Set(['why', 'id', 'label', 'type', 'name', 'title']);

/** The key of a pair, without quotes. */
export function keyOf(pair: SyntaxNode, read: ReadText): string {
  const key = pair.getChild('Key');
  if (!key) return '';
  const text = read(key.from, key.to).trim();
  return /^(["']).*\1$/s.test(text) ? text.slice(1, -1) : text;
}

/** The keys of the pairs around a node, outermost first: ["rules", "require"]. */
function keysAround(node: SyntaxNode, read: ReadText): string[] {
  const keys: string[] = [];
  for (let at: SyntaxNode | null = node; at; at = at.parent) if (at.name === 'Pair') keys.unshift(keyOf(at, read));
  return keys;
}

function holdsExpression(node: SyntaxNode, read: ReadText): boolean {
  const keys = keysAround(node, read);
  const part = keys[0];
  const last = keys[keys.length - 1];
  if (part === undefined || last === undefined || !kExpressionParts.has(part) || kProseKeys.has(last)) return false;
  const isKey = node.parent?.name === 'Key';
  return !isKey || (part === 'rules' && keys[1] === 'score' && keys.length === 3);
}

const kMarks = new Map<string, Decoration>();

function markOf(look: string): Decoration {
  let mark = kMarks.get(look);
  if (!mark) kMarks.set(look, mark = Decoration.mark({class: look}));
  return mark;
}

function coloursOf(view: EditorView): DecorationSet {
  const builder = new RangeSetBuilder<Decoration>();
  const {doc} = view.state;
  const read: ReadText = (from, to) => doc.sliceString(from, to);
  for (const {from, to} of view.visibleRanges) {
    syntaxTree(view.state).iterate({from, to, enter: node => {
      if ((node.name !== 'Literal' && node.name !== 'QuotedLiteral') || !holdsExpression(node.node, read)) return;
      for (const token of tokensOf(read(node.from, node.to))) builder.add(node.from + token.from, node.from + token.to, markOf(token.look));
    }});
  }
  return builder.finish();
}

const colouring = ViewPlugin.fromClass(class {
  decorations: DecorationSet;
  constructor(view: EditorView) { this.decorations = coloursOf(view); }
  update(update: ViewUpdate): void {
    if (update.docChanged || update.viewportChanged || syntaxTree(update.startState) !== syntaxTree(update.state)) this.decorations = coloursOf(update.view);
  }
}, {decorations: plugin => plugin.decorations});

export function packSupport(): Extension {
  return [new LanguageSupport(yamlLanguage), colouring];
}
