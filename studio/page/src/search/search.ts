import type {App} from '../app';
import {el} from '../dom';

export function searchBox(_app: App): {element: HTMLElement; search: (text: string) => void} {
  return {element: el('search', {class: 'search'}), search: () => {}};
}
