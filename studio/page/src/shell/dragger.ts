// The bars between the columns: dragged, or moved by arrow keys. They set --left and --right of the frame; on a phone the one at
// the right is the handle of the sheet and sets --sheet.
import {el} from '../dom';

const kStepPx = 24;
const kLeast = {left: 260, right: 260, sheet: 90};

export function dragger(label: string, side: 'left' | 'right'): HTMLElement {
  const handle = el('div', {class: `dragger dragger-${side}`, role: 'separator', tabindex: '0', 'aria-label': label, 'aria-orientation': 'vertical',
    'aria-valuenow': '30'});
  const isSheet = () => handle.parentElement?.dataset['mode'] === 'phone';
  const neighbour = () => (side === 'left' ? handle.previousElementSibling : handle.nextElementSibling) as HTMLElement;
  const size = () => (isSheet() ? neighbour().offsetHeight : neighbour().offsetWidth);
  const resize = (to: number) => {
    const frame = handle.parentElement!;
    const name = isSheet() ? 'sheet' : side;
    const most = (isSheet() ? frame.offsetHeight : frame.offsetWidth) * 0.7;
    handle.setAttribute('aria-valuenow', String(Math.round(100 * Math.max(kLeast[name], Math.min(most, to)) / (isSheet() ? frame.offsetHeight : frame.offsetWidth))));
    frame.style.setProperty(`--${name}`, `${Math.round(Math.max(kLeast[name], Math.min(most, to)))}px`);
    if (isSheet()) frame.dataset['sheet'] = 'open';
  };
  handle.addEventListener('pointerdown', event => {
    handle.setPointerCapture(event.pointerId);
    const begin = {x: event.clientX, y: event.clientY, size: size()};
    const move = (moved: PointerEvent) => {
      if (isSheet()) resize(begin.size + begin.y - moved.clientY);
      else resize(begin.size + (side === 'left' ? moved.clientX - begin.x : begin.x - moved.clientX));
    };
    handle.addEventListener('pointermove', move);
    handle.addEventListener('pointerup', () => handle.removeEventListener('pointermove', move), {once: true});
    event.preventDefault();
  });
  handle.addEventListener('keydown', event => {
    const grow = {ArrowRight: side === 'left' ? 1 : -1, ArrowLeft: side === 'left' ? -1 : 1, ArrowUp: 1, ArrowDown: -1}[event.key];
    if (grow === undefined) return;
    event.preventDefault();
    resize(size() + grow * kStepPx);
  });
  return handle;
}
