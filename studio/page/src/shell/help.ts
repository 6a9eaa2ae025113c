// The list of keys.
import {el} from '../dom';
import {words} from '../strings';
import {icon} from './icons';

export function helpButton(): HTMLElement {
  const dialog = el('dialog', {class: 'help', 'aria-label': words.shell.help},
    el('h2', {}, words.shell.help),
    el('dl', {}, ...words.keys.flatMap(([keys, meaning]) => [
      el('dt', {}, ...keys.split(' ').map(key => el('kbd', {}, key))), el('dd', {}, meaning)])),
    el('form', {method: 'dialog'}, el('button', {class: 'button'}, words.shell.close)));
  addEventListener('keydown', event => {
    const target = event.target as HTMLElement;
    if (event.key === '?' && !target.isContentEditable && !['INPUT', 'TEXTAREA', 'SELECT'].includes(target.tagName)) dialog.showModal();
  });
  return el('span', {}, el('button', {type: 'button', class: 'icon-button', 'aria-label': words.shell.help, title: `${words.shell.help} (?)`,
    onclick: () => dialog.showModal()}, icon('help')), dialog);
}
