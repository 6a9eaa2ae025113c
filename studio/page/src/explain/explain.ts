import type {App, Panel} from '../app';
import {el} from '../dom';
import {words} from '../strings';

export function explainPanel(_app: App): Panel {
  return {id: 'explain', title: words.explain.title, element: el('div', {class: 'panel'})};
}
