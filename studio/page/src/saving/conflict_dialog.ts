// The file on the disk and the text in the editor have both changed: the reader sees both and decides.
import {el} from '../dom';
import {words} from '../strings';
import {openDialog} from './dialog';
import {sideBySide} from './diff';

export interface ConflictChoice { text: string }

export async function openConflict(diskText: string, ownText: string): Promise<ConflictChoice | null> {
  const merge = sideBySide(diskText, ownText, [words.save.onDisk, words.save.inEditor]);
  const choice = await openDialog<ConflictChoice>(words.save.conflict, 'conflict', close => el('div', {class: 'conflict'},
    el('p', {}, words.save.conflictWhy),
    el('div', {class: 'conflict-heads'}, el('span', {}, words.save.onDisk), el('span', {}, words.save.inEditor)),
    el('div', {class: 'conflict-texts'}, merge.element),
    el('div', {class: 'dialog-buttons'},
      el('button', {type: 'button', class: 'button', onclick: () => close(null)}, words.save.cancel),
      el('button', {type: 'button', class: 'button', onclick: () => close({text: diskText})}, words.save.takeDisk),
      el('button', {type: 'button', class: 'button button-main', onclick: () => close({text: merge.textOf()})}, words.save.keepOwn))));
  merge.destroy();
  return choice;
}
