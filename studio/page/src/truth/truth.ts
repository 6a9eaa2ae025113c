// To be written (s5).
import type {App, Panel} from '../app';
import {el} from '../dom';
import {words} from '../strings';

export function truthPanel(_app: App): Panel {
  return {id: 'truth', title: words.truth.title, element: el('div', {class: 'panel'})};
}
