// The words of an expression with what they are, for colours only: the compiler judges them.

export interface Token { from: number; to: number; look: string }

const kOperators = new Set(['and', 'or', 'not', 'in', 'is', 'by', 'of', 'where']);
const kFunctions = new Set(['exists', 'none', 'all', 'count', 'min', 'max', 'mean', 'abs', 'sqrt', 'distance_along', 'gap']);
const kSelves = new Set(['self', 'other', 'members', 'scale']);
// In this order: a scale such as 1:500, a number with its unit, a param, a word, signs.
const kWord = /1:\d+|(\d+(?:\.\d+)?)(?:( ?)(mm@map|mm|cm|m2|m3|m|deg|%)(?!\w))?|\$[A-Za-z_]\w*|[A-Za-z_]\w*|\.\.|[<>!=]=?|[~+*/-]/g;

function lookOfWord(word: string, next: string): string {
  if (word.startsWith('$')) return 'tok-param';
  if (!/^[A-Za-z_]/.test(word)) return /^\d/.test(word) ? 'tok-number' : 'tok-quiet';
  if (kOperators.has(word)) return 'tok-word';
  if (kFunctions.has(word) && next === '(') return 'tok-function';
  return kSelves.has(word) ? 'tok-self' : '';
}

export function tokensOf(text: string): Token[] {
  const tokens: Token[] = [];
  for (const match of text.matchAll(kWord)) {
    const from = match.index;
    const [whole, number, space, unit] = match;
    if (number !== undefined && unit !== undefined) {
      tokens.push({from, to: from + number.length, look: 'tok-number'});
      tokens.push({from: from + number.length + (space ?? '').length, to: from + whole.length, look: 'tok-unit'});
      continue;
    }
    const look = lookOfWord(whole, text[from + whole.length] ?? '');
    if (look !== '') tokens.push({from, to: from + whole.length, look});
  }
  return tokens;
}
