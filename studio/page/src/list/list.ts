import type {App, Panel} from '../app';
import {el} from '../dom';
import {words} from '../strings';

export function listPanel(_app: App): Panel {
  return {id: 'list', title: words.list.title, element: el('div', {class: 'panel'})};
}
