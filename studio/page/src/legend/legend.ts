import type {App, Panel} from '../app';
import {el} from '../dom';
import {words} from '../strings';

export function legendPanel(_app: App): Panel {
  return {id: 'legend', title: words.legend.title, element: el('div', {class: 'panel'})};
}
