// To be written (s5).
import type {App, Panel} from '../app';
import {el} from '../dom';
import {words} from '../strings';

export function editorPanel(_app: App): Panel {
  return {id: 'editor', title: words.editor.title, element: el('div', {class: 'panel'})};
}
