// What an author can do about a part that is explained: say what it is, or set the param that would change its label.
import type {App} from '../app';
import {el} from '../dom';
import {authorOf} from '../editor/author';
import type {ExplainAnswer, Part} from '../source';
import {words} from '../strings';
import {openCorrectMenu} from './correct_menu';

export function partTools(app: App, part: Part, answer: ExplainAnswer | null): HTMLElement {
  const correct = el('button', {type: 'button', class: 'button tool', title: words.correct.hint, onclick: () => {
    const {left, bottom} = correct.getBoundingClientRect();
    void openCorrectMenu(app, part, left, bottom + 4);
  }}, words.correct.title);
  const flip = answer?.flip;
  const set = flip && flip.param !== '' && el('button', {
    type: 'button', class: 'button tool', onclick: () => authorOf(app).setParam(flip.param, flip.value, true)
  }, words.correct.setParam(flip.param, flip.value));
  return el('div', {class: 'part-tools'}, correct, set);
}
