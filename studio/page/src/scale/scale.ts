// To be written (s5).
import type {App, Panel} from '../app';
import {el} from '../dom';
import {words} from '../strings';

export function scalePanel(_app: App): Panel {
  return {id: 'scale', title: words.scale.title, element: el('div', {class: 'panel'})};
}
