// To be written (s5).
import type {App, Panel} from '../app';
import {el} from '../dom';
import {words} from '../strings';

export function paramsPanel(_app: App): Panel {
  return {id: 'params', title: words.params.title, element: el('div', {class: 'panel'})};
}
