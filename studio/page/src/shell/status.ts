// The line in the bar that says how things stand: counts, F1, time, or what went wrong. It is read aloud when it changes.
import {el, replace} from '../dom';
import type {Store} from '../store';
import {words} from '../strings';

export function statusLine(store: Store): HTMLElement {
  const element = el('p', {class: 'status', role: 'status', 'aria-live': 'polite'});
  store.watch(['message', 'is_message_grave', 'loading', 'is_good', 'unknown', 'counts', 'score', 'ms'], () => {
    const {message, is_message_grave, loading, is_good, unknown, counts, score, ms} = store.value;
    const labelled = counts.reduce((sum, entry) => sum + entry.count, 0);
    const facts = [
      loading.done < loading.all ? words.shell.loading(loading.done, loading.all) : '',
      score ? words.shell.f1(score.macro_f1) : '',
      labelled + unknown > 0 ? words.shell.features(labelled + unknown) : '',
      unknown > 0 ? words.shell.unknown(unknown) : '',
      ms > 0 ? words.shell.ms(ms) : ''
    ].filter(Boolean);
    replace(element,
      message ? el('span', {class: is_message_grave ? 'grave' : ''}, message) :
      !is_good ? el('span', {class: 'grave'}, words.shell.keep) : null,
      ...facts.map(fact => el('span', {class: 'fact'}, fact)));
  });
  return element;
}
