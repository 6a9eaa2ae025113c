// What stands in place of the picture where there are no buildings: sample houses, packs to begin with, an experiment.
import {el} from '../dom';
import {authorOf} from '../editor/author';
import {starterButtons} from '../editor/starters';
import {words} from '../strings';
import type {Workbench} from '../workbench';

export function bindWelcome(app: Workbench): void {
  const {store, source} = app;
  const open = async () => {
    try {
      const {folder} = await source.openSamples();
      store.say(words.welcome.opened(folder));
      await app.followLoading();
    } catch (error) {
      store.say(error instanceof Error ? error.message : words.source.garbled, true);
    }
  };
  const card = el('section', {class: 'welcome', 'aria-label': words.welcome.title},
    el('h2', {}, words.welcome.title), el('p', {}, words.welcome.how),
    el('p', {}, el('button', {type: 'button', class: 'button button-main', id: 'open-samples', onclick: () => void open()}, words.welcome.samples)),
    el('h3', {}, words.welcome.packs),
    el('p', {}, ...starterButtons(authorOf(app)).flatMap(button => [button, ' '])),
    el('h3', {}, words.welcome.experiment), el('p', {}, words.welcome.experimentHow), el('pre', {}, el('code', {}, words.welcome.command)));
  store.watch(['offers_samples'], () => {
    card.hidden = !store.value.offers_samples;
    if (card.hidden) card.remove();
    else app.scene.host.append(card);
  });
}
