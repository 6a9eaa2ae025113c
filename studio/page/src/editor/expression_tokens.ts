// Colours of the expressions inside a pack: a tokenizer, because expressions are one line long and their words are few.
// The compiler judges them; here is only what the eye needs.

import {StreamLanguage, StringStream} from '@codemirror/language';
import {tags as t} from '@lezer/highlight';

const operators = new Set(['and', 'or', 'not', 'in', 'is', 'by', 'of', 'where']);
const quantifiers = new Set(['exists', 'none', 'all', 'count', 'min', 'max', 'mean', 'abs', 'sqrt', 'distance_along', 'gap']);
const selves = new Set(['self', 'other', 'members', 'scale']);
const units = /^(?:mm@map|mm|cm|m2|m3|m|deg|%)(?![A-Za-z0-9_])/;

interface State {
  isAfterNumber: boolean;
}

function wordToken(word: string, next: string): string {
  if (operators.has(word)) return 'keyword';
  if (quantifiers.has(word) && next === '(') return 'function';
  if (selves.has(word)) return 'self';
  return 'name';
}

function token(stream: StringStream, state: State): string | null {
  const isAfterNumber = state.isAfterNumber;
  if (stream.eatSpace()) return null;
  state.isAfterNumber = false;
  if (stream.match(/^"?1:\d+/)) return "number";
  if (stream.match(/^\d+(?:\.\d+)?/)) {
    state.isAfterNumber = true;
    return 'number';
  }
  if (isAfterNumber && stream.match(units)) return 'unit';
  if (stream.match(/^\$[A-Za-z_]\w*/)) return "param";
  const word = stream.match(/^[A-Za-z_]\w*/) as RegExpMatchArray | null;
  if (word) return wordToken(word[0], stream.peek() ?? '');
  if (stream.match('..')) return 'range';
  if (stream.match(/^[<>!=~+\-*/]=?/)) return "operator";
  stream.next();
  return null;
}

export const expressionLanguage = StreamLanguage.define<State>({
  name: 'oriel expression',
  startState: () => ({isAfterNumber: false}),
  token,
  tokenTable: {
    function: t.function(t.variableName),
    self: t.self,
    name: t.variableName,
    unit: t.unit,
    param: t.special(t.variableName),
    range: t.operator,
  },
});
