// Conditions in plain words: what the engine found, "host_inclination is 90.00 deg", as people say it. Expressions stay as they are
// written in the pack.
import {words} from '../strings';

/** True of an expression of the language, which is shown as code. */
export function isCode(text: string): boolean { return /[(<>=$]/.test(text); }

const senses: Record<string, string> = {hole: words.explain.senses.hole, protrusion: words.explain.senses.protrusion, cavity: words.explain.senses.cavity,
  imprint: words.explain.senses.imprint};

export function plainWords(text: string): string {
  if (isCode(text.replace(/\(\$\w+\)/g, ''))) return text;
  return text
    .replace(/\bsense is (\w+)/g, (_, sense: string) => words.explain.senseIs(senses[sense] ?? sense))
    .replace(/\bmust be one of \[([^\]]*)\]/g, (_, list: string) => words.explain.mustBeOneOf(list.split(/,\s*/).map(name => senses[name] ?? name)))
    .replace(/\bmust be (hole|protrusion|cavity|imprint)\b/g, (_, sense: string) => words.explain.mustBe(senses[sense]!))
    .replace(/ \(\$\w+\)/g, '')
    .replace(/(\d)(?:\.0+)? deg\b/g, '$1°').replace(/(\d\.\d+) deg\b/g, '$1°')
    .replace(/ m2\b/g, ' m²').replace(/ m3\b/g, ' m³')
    .replace(/\bself is /g, 'is ')
    .replace(/\b([a-z]+)_([a-z_]+)\b/g, name => name.replaceAll('_', ' '));
}

/** A nearest miss, "fails: A; fails: B", as its parts in plain words. */
export function missesOf(sentence: string): string[] {
  return sentence.split(/;\s+(?=fails: |vetoes: |unknown: )/).map(part => plainWords(part.replace(/^(fails|vetoes|unknown): /, '')));
}

export interface SurfaceReason {
  type: string; rule: string; measures: {name: string; value: string; meaning: string}[]; rules: {rule: string; holds: boolean; text: string}[];
}

/** The lines that say why a surface is one: its measures, then the rules with their conditions. */
export function surfaceReason(text: string): SurfaceReason {
  const [head = '', ...lines] = text.split('\n').filter(Boolean);
  const [type = '', rule = ''] = head.split(' by ');
  const reason: SurfaceReason = {type, rule, measures: [], rules: []};
  for (const line of lines) {
    const cells = line.trim().split(/\s{2,}/);
    if (line.startsWith('    ') && reason.rules.length > 0) {
      const last = reason.rules.at(-1)!;
      last.holds &&= cells[0] === 'holds';
      last.text += `${last.text ? '; ' : ''}${cells[1] ?? ''}`;
    } else if (line.includes(' -> ')) {
      reason.rules.push({rule: line.trim().split(' -> ')[0]!, holds: true, text: ''});
    } else if (cells.length >= 2 && cells[1] !== '?') {
      reason.measures.push({name: plainWords(cells[0]!), value: plainWords(cells[1]!), meaning: cells[2] ?? ''});
    }
  }
  return reason;
}
