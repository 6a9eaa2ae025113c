// Asks where a pack is to be written that has no file of its own, or one that cannot be written.
import {el} from '../dom';
import {words} from '../strings';
import {openDialog} from './dialog';

export function askForPath(packName: string, isReadOnly: boolean): Promise<string | null> {
  return openDialog<string>(words.save.where, 'path', close => {
    const input = el('input', {value: `my_${packName}.yaml`, 'aria-label': words.save.path, spellcheck: 'false', autocomplete: 'off', required: true});
    const submit = (event: Event) => {
      event.preventDefault();
      const path = input.value.trim();
      if (path !== '') close(/\.ya?ml$/.test(path) ? path : `${path}.yaml`);
    };
    return el('form', {onsubmit: submit},
      el('p', {}, isReadOnly ? words.save.readOnly : words.save.builtInWhy),
      el('label', {}, words.save.path, input),
      el('div', {class: 'dialog-buttons'},
        el('button', {type: 'button', class: 'button', onclick: () => close(null)}, words.save.cancel),
        el('button', {class: 'button button-main'}, words.save.save)));
  });
}
