// What an empty pack offers: two beginnings, each a whole pack that labels something at once.
import {el} from '../dom';
import {words} from '../strings';
import type {Author} from './author';

const kOpenings = `schema: oriel/1
pack: {name: my_pack, version: 0.1.0}
params:
  door_height: {value: 1.8 m, range: 1.5 m .. 2.5 m, why: one walks through a door without stooping}
classes:
  window: {}
  door: {}
rules:
  - id: window.any
    label: window
    require:
      - sense in [hole, imprint] and host is wall
      - height >= 0.4 m and depth <= 0.8 m
  - id: door.on_ground
    label: door
    priority: 10
    require:
      - sense in [hole, imprint] and host is wall
      - base_height <= 1.2 m and height >= $door_height
generalise:
  - {id: openings.omit, scale: "1:5000 ..", for: any, do: omit}
`;

const kExtending = `schema: oriel/1
pack: {name: my_pack, version: 0.1.0}
extends: residential
params:
  door_height: {value: 1.8 m, why: as in residential}
`;

/** Two beginnings of a pack. */
export function starterButtons(author: Author): HTMLElement[] {
  return [button(author, words.editor.startOpenings, kOpenings), button(author, words.editor.startExtending, kExtending)];
}

function button(author: Author, label: string, text: string): HTMLElement {
  return el('button', {type: 'button', class: 'button', onclick: () => {
    author.app.open('editor');
    author.replaceText(text, 'input.starter');
    author.view.dispatch({selection: {anchor: text.length}});
    author.view.focus();
  }}, label);
}

/** Over the text, as long as there is none. */
export function starters(author: Author): HTMLElement {
  const box = el('div', {class: 'starters'},
    el('p', {}, words.editor.emptyPack),
    el('p', {}, ...starterButtons(author).flatMap(each => [each, ' '])));
  author.watch(() => { box.hidden = author.text.trim() !== ''; });
  return box;
}
