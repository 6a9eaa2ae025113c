// Scale: the building as a map of a scale, or a level of detail, has it, beside the original with a divider to drag or in its
// place; what was done to each part and why. An edit of `generalise:` draws it anew.
import type {App, Panel} from '../app';
import {el, replace} from '../dom';
import {authorOf} from '../editor/author';
import {Divider} from '../scene/divider';
import {shapeOf} from '../scene/shape';
import {SourceError, type ScaleAnswer} from '../source';
import {nameOf} from '../store';
import {words} from '../strings';
import {isOriginal, keyOf, questionOf, stopText, stopsOf, tickText, type Stop} from './stops';
import {Waiting} from './waiting';

/** The slider may pass over stops on its way. */
const kPause_ms = 80;
const kListed = 300;

class ScalePanel {
  readonly element: HTMLElement;
  private readonly slider = el('input', {type: 'range', min: '0', step: '1', class: 'scale-slider', 'aria-label': words.scale.slider});
  private readonly ticks = el('div', {class: 'scale-ticks', 'aria-hidden': 'true'});
  private readonly lods = el('div', {class: 'scale-lods', role: 'group', 'aria-label': words.scale.lods});
  private readonly title = el('p', {class: 'scale-title', 'aria-live': 'polite'});
  private readonly facts = el('div', {class: 'scale-facts'});
  private readonly outcomes = el('div', {class: 'scale-outcomes'});
  private readonly beside = el('input', {type: 'checkbox', checked: true});
  private divider: Divider | null = null;
  private share = 0.5;
  private stops: Stop[] = [];
  private stop: Stop = {kind: 'scale', scale: 1};
  private building = 0;
  /** What the picture shows: it stays until the next one is there, and what is cancelled leads back to it. */
  private drawn: Stop = this.stop;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private asking: AbortController | null = null;
  private readonly waiting: Waiting;

  constructor(private readonly app: App) {
    this.slider.addEventListener('input', () => this.choose(this.stops[Number(this.slider.value)]!));
    this.beside.addEventListener('change', () => this.placeDivider());
    this.waiting = new Waiting(app.scene.host, () => this.cancel(), async () => (await app.source.scaleProgress()).stage ?? '');
    this.element = el('div', {class: 'panel scale'}, this.title,
      el('div', {class: 'scale-choice'}, this.slider, this.ticks, this.lods), this.waiting.element, el('label', {class: 'check'}, this.beside, words.scale.beside), this.facts, this.outcomes);
    app.store.watch(['scales', 'lods'], () => this.fillStops());
    app.store.watch(['selection'], () => this.followSelection());
    app.store.watch(['features'], () => this.nameOutcomes());
    authorOf(app).loop.onAnswer(() => { if (!isOriginal(this.stop) && app.store.value.is_good) this.askSoon(); });
    this.say(null);
  }

  show(): void {
    this.followSelection();
  }

  private fillStops(): void {
    const {scales, lods} = this.app.store.value;
    this.stops = stopsOf(scales.length > 0 ? scales : [1]);
    this.slider.max = String(this.stops.length - 1);
    this.slider.value = '0';
    replace(this.ticks, ...this.stops.map(stop => el('span', {}, tickText(stop))));
    replace(this.lods, el('span', {class: 'quiet small'}, words.scale.lods), ...lods.map(lod => el('button', {
      type: 'button', class: 'chip', 'aria-pressed': 'false', 'data-lod': lod, onclick: () => this.choose({kind: 'lod', lod})
    }, lod)));
    this.mark();
  }

  /** A chosen building is the one that is generalised. */
  private followSelection(): void {
    const chosen = this.app.store.value.selection?.building ?? this.building;
    if (chosen === this.building) return;
    this.building = chosen;
    if (!isOriginal(this.stop)) this.askSoon();
  }

  private choose(stop: Stop): void {
    this.stop = stop;
    this.mark();
    if (isOriginal(stop)) {
      this.showOriginal();
      return;
    }
    // The first time the building comes into the middle, where the line is.
    if (!this.divider?.isShown) this.app.scene.fly({building: this.building});
    this.askSoon();
  }

  private mark(): void {
    const at = this.stops.findIndex(stop => keyOf(stop) === keyOf(this.stop));
    if (at >= 0) this.slider.value = String(at);
    this.slider.setAttribute('aria-valuetext', stopText(this.stop));
    this.slider.classList.toggle('is-off', at < 0);
    [...this.ticks.children].forEach((tick, index) => tick.classList.toggle('is-on', index === at));
    for (const chip of this.lods.querySelectorAll<HTMLElement>('.chip')) {
      chip.setAttribute('aria-pressed', String(this.stop.kind === 'lod' && chip.dataset['lod'] === this.stop.lod));
    }
  }

  private showOriginal(): void {
    this.endAsking(true);
    this.drawn = this.stop;
    this.divider?.hide();
    this.say(null);
    replace(this.facts);
    replace(this.outcomes);
  }

  private askSoon(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.ask(), kPause_ms);
  }

  /** Another scale ends the one at work by itself. */
  private endAsking(isStopped = false): void {
    clearTimeout(this.timer);
    if (isStopped && this.asking) void this.app.source.stopScale().catch(() => undefined);
    this.asking?.abort();
    this.asking = null;
    this.waiting.end();
    this.element.removeAttribute('aria-busy');
  }

  /** Back to what the picture shows. */
  private cancel(): void {
    this.endAsking(true);
    this.stop = this.drawn;
    this.mark();
    this.app.store.say(words.scale.cancelled);
  }

  private async ask(): Promise<void> {
    this.endAsking();
    const {signal} = this.asking = new AbortController();
    const stop = this.stop;
    this.element.setAttribute('aria-busy', 'true');
    this.waiting.begin(words.scale.drawing(nameOf(this.app.store.value, this.building), stopText(stop)));
    try {
      await this.app.need([this.building]);
      if (signal.aborted) return;
      const answer = await this.app.source.scale(questionOf(this.building, stop), signal);
      if (signal.aborted) return;
      this.endAsking();
      this.drawn = stop;
      this.draw(answer);
    } catch (error) {
      if (signal.aborted) return;
      this.endAsking();
      if (error instanceof SourceError && error.isSuperseded) return;
      this.stop = this.drawn;
      this.mark();
      this.app.store.say(error instanceof Error ? error.message : words.source.garbled, true);
    }
  }

  private draw(answer: ScaleAnswer): void {
    const {geometry} = this.app.store.value;
    this.divider ??= new Divider(this.app, words.scale.original, words.scale.generalised);
    const polygons = answer.polygons.map(({rings, feature, surface}) => ({rings, owners: feature < 0 ? [] : [feature], surface}));
    this.divider.show([shapeOf(this.building, answer.vertices_mm, polygons, geometry.get(this.building)?.storeys_mm ?? [])]);
    this.placeDivider();
    this.say(answer);
    this.listOutcomes(answer);
  }

  /** Beside the original the line stands where the reader has left it, in its place at the left edge. */
  private placeDivider(): void {
    if (!this.divider?.isShown) return;
    if (!this.beside.checked) {
      if (this.divider.place > 0) this.share = this.divider.place;
      this.divider.place = 0;
    } else if (this.divider.place === 0) {
      this.divider.place = this.share;
    }
  }

  private say(answer: ScaleAnswer | null): void {
    const name = nameOf(this.app.store.value, this.building);
    replace(this.title, el('strong', {class: 'number'}, isOriginal(this.stop) ? words.scale.original : stopText(this.stop)), el('span', {class: 'quiet'}, name));
    if (!answer) {
      replace(this.facts, el('p', {class: 'quiet'}, words.scale.hint));
      return;
    }
    const before = this.app.store.value.geometry.get(this.building)?.ring_ends.length ?? 0;
    replace(this.facts,
      el('p', {}, words.scale.polygons(before, answer.polygons.length)),
      el('p', {class: answer.is_valid ? 'good' : 'grave'}, answer.is_valid ? words.scale.valid : words.scale.invalid),
      answer.note ? el('p', {class: 'note'}, answer.note) : null,
      ...answer.issues.map(issue => el('p', {class: issue.severity === 'error' ? 'grave small' : 'quiet small'}, issue.sentence)));
  }

  /** What was done, by operator; a click shows the part in the original. */
  private listOutcomes(answer: ScaleAnswer): void {
    const groups = new Map<string, ScaleAnswer['outcomes']>();
    for (const outcome of answer.outcomes) groups.set(outcome.operator, [...groups.get(outcome.operator) ?? [], outcome]);
    replace(this.outcomes, ...[...groups].map(([operator, outcomes]) => el('details', {class: 'change-group', open: groups.size === 1},
      el('summary', {}, el('span', {class: 'change-after'}, operator || words.scale.kept), el('span', {class: 'tree-count number'}, String(outcomes.length))),
      el('button', {type: 'button', class: 'link', onclick: () => this.showParts(operator, outcomes)}, words.changes.showAll),
      el('ul', {class: 'plain change-items'}, ...outcomes.slice(0, kListed).map(outcome => this.outcomeItem(outcome))))));
    if (answer.outcomes.length === 0) replace(this.outcomes, el('p', {class: 'quiet'}, words.scale.nothing));
  }

  /** Names have come. */
  private nameOutcomes(): void {
    for (const row of this.outcomes.querySelectorAll<HTMLElement>('[data-feature]')) {
      const feature = this.app.feature(this.building, Number(row.dataset['feature']));
      if (feature) row.querySelector('.outcome-name')!.textContent = feature.name || feature.id;
    }
  }

  private showParts(operator: string, outcomes: ScaleAnswer['outcomes']): void {
    const parts = outcomes.filter(outcome => outcome.feature >= 0).map((outcome): [number, number] => [this.building, outcome.feature]);
    this.app.show(parts, `${operator}: ${parts.length}`);
  }

  private outcomeItem(outcome: ScaleAnswer['outcomes'][number]): HTMLElement {
    const feature = this.app.feature(this.building, outcome.feature);
    const name = feature?.name || feature?.id || '';
    return el('li', {}, el('button', {
      type: 'button', class: 'tree-row', 'data-feature': outcome.feature, onclick: () => { if (outcome.feature >= 0) this.app.select({building: this.building, feature: outcome.feature}, false); }
    }, el('span', {class: 'outcome-name'}, name), el('span', {class: 'sample-why'}, outcome.sentence)));
  }
}

export function scalePanel(app: App): Panel {
  const scale = new ScalePanel(app);
  return {id: 'scale', title: words.scale.title, element: scale.element, onShow: () => scale.show()};
}
