// The line in the bar that says how things stand: counts, F1, time, or what went wrong. It is read aloud when it changes.
import {el, replace} from '../dom';
import type {Store} from '../store';
import {words} from '../strings';

/** How many of the buildings are there, while some are missing. */
export function loadBar(store: Store): HTMLElement {
  const bar = el('progress', {class: 'load-bar', 'aria-label': words.shell.loadBar});
  store.watch(['loading'], () => {
    const {done, all} = store.value.loading;
    bar.hidden = done >= all;
    bar.max = Math.max(1, all);
    bar.value = done;
  });
  return bar;
}

export function statusLine(store: Store): HTMLElement {
  const element = el('p', {class: 'status', role: 'status', 'aria-live': 'polite'});
  store.watch(['message', 'is_message_grave', 'loading', 'is_good', 'labels', 'unknown', 'counts', 'score', 'ms'], () => {
    const {message, is_message_grave, loading, is_good, labels, unknown, counts, score, ms} = store.value;
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
      !is_good ? el('span', {class: 'grave'}, labels.size > 0 ? words.shell.keep : words.shell.noneGood) : null,
      ...facts.map(fact => el('span', {class: 'fact'}, fact)));
  });
  return element;
}
