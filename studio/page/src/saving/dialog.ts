// A dialog of the browser: it keeps the focus, Escape closes it, and it gives back one answer.
import {el} from '../dom';

/** Opens a dialog; `fill` makes its content and calls `close` with the answer. Escape answers null. */
export function openDialog<Answer>(title: string, name: string, fill: (close: (answer: Answer | null) => void) => HTMLElement):
    Promise<Answer | null> {
  return new Promise(resolve => {
    let answer: Answer | null = null;
    const dialog = el('dialog', {class: `dialog dialog-${name}`, 'aria-label': title});
    const close = (given: Answer | null) => { answer = given; dialog.close(); };
    dialog.append(el('h2', {}, title), fill(close));
    dialog.addEventListener('close', () => { dialog.remove(); resolve(answer); });
    document.body.append(dialog);
    dialog.showModal();
  });
}
