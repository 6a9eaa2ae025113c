// Prose of the engine with `code` between backticks: text and code elements, never markup.
import {el} from '../dom';

/** The pieces of one line. */
export function inlineOf(text: string): (Node | string)[] {
  return text.split('`').map((piece, at) => (at % 2 === 1 ? el('code', {}, piece) : piece));
}

/** A paragraph for every line. */
export function proseOf(text: string): HTMLElement[] {
  return text.split('\n').filter(line => line.trim() !== '').map(line => el('p', {}, ...inlineOf(line)));
}
