// A second picture over the first, cut off at a line that is dragged or moved by arrow keys: before at its left, after at its right.
import type {App} from '../app';
import {el} from '../dom';
import type {Shape} from '../source';
import {words} from '../strings';
import {kSceneColours, paintOf} from './bind_scene';
import {BuildingScene} from './building_scene';
import {looksOf} from './palette';

/** Of more buildings only the given ones are drawn at the right. */
const kMostNeighbours = 300;

export class Divider {
  /** The picture at the right of the line; it is made when it is first shown. */
  private second: BuildingScene | null = null;
  private readonly line: HTMLElement;
  private share = 0.5;
  private labels: ReadonlyMap<number, number[]> | null = null;

  /** `names` are what the two sides are called; the labels of the store hold for both unless others are given to `show`. */
  constructor(private readonly app: App, before = words.divider.before, after = words.divider.after) {
    this.line = el('div', {class: 'divider', role: 'slider', tabindex: '0', hidden: true, 'aria-label': words.divider.name, 'aria-valuemin': '0',
      'aria-valuemax': '100'}, el('span', {class: 'divider-before', 'aria-hidden': 'true'}, before), el('span', {class: 'divider-grip', 'aria-hidden': 'true'}),
      el('span', {class: 'divider-after', 'aria-hidden': 'true'}, after));
    app.scene.host.append(this.line);
    this.listen();
    app.store.watch(['labels', 'classes', 'filter', 'colours', 'selection', 'only', 'found', 'hover', 'is_dark'], () => this.paint());
    app.store.watch(['shows_hidden_lines'], () => this.second?.setHiddenLines(app.store.value.shows_hidden_lines));
  }

  get isShown(): boolean { return !this.line.hidden; }
  set isShown(isShown: boolean) {
    this.line.hidden = !isShown;
    if (this.second) this.second.element.hidden = !isShown;
    if (isShown) this.paint();
  }

  hide(): void { this.isShown = false; }

  /** Where the line is, from 0 (all after) to 1 (all before). */
  get place(): number { return this.share; }
  set place(share: number) {
    this.share = Math.max(0, Math.min(1, share));
    this.line.style.left = `${100 * this.share}%`;
    this.line.setAttribute('aria-valuenow', String(Math.round(100 * this.share)));
    if (this.second) this.second.element.style.clipPath = `inset(0 0 0 ${100 * this.share}%)`;
  }

  /** Shows these buildings at the right of the line, among the others as they are. */
  show(buildings: Shape[], labels: ReadonlyMap<number, number[]> | null = null): void {
    this.labels = labels;
    const given = new Set(buildings.map(({number}) => number));
    const {geometry} = this.app.store.value;
    const others = geometry.size > kMostNeighbours ? [] : [...geometry.values()].filter(({number}) => !given.has(number));
    // The others first: what changes from one scale to the next lies in a chunk of its own.
    const asTheyAre = new Map(others.map(shape => [shape.number, shape]));
    this.after.setBuildings(asTheyAre);
    this.after.setBuildings(new Map([...asTheyAre, ...buildings.map((shape): [number, Shape] => [shape.number, shape])]));
    this.isShown = true;
    this.place = this.share;
  }

  /** The picture at the right of the line. */
  get after(): BuildingScene {
    if (!this.second) {
      this.second = new BuildingScene(this.app.scene.host);
      this.second.element.classList.add('picture-after');
      this.app.scene.element.after(this.second.element);
      this.second.element.setAttribute('aria-label', words.divider.after);
      this.second.element.tabIndex = -1;
      this.second.follow(this.app.scene);
      this.second.setHiddenLines(this.app.store.value.shows_hidden_lines);
      this.second.onPick.push((hit, event) => { for (const call of this.app.scene.onPick) call(hit, event); });
      this.second.onHover.push((hit, event) => { for (const call of this.app.scene.onHover) call(hit, event); });
      this.second.onContext.push((hit, event) => { for (const call of this.app.scene.onContext) call(hit, event); });
    }
    return this.second;
  }

  private paint(): void {
    if (!this.second || this.line.hidden) return;
    const {classes, colours, is_dark} = this.app.store.value;
    const paint = paintOf(this.app, looksOf(classes, colours === 'pattern'));
    this.second.setColours(kSceneColours[is_dark ? 'dark' : 'light']);
    this.second.setPaint({...paint, changed: [], ...(this.labels ? {labels: this.labels} : {})});
  }

  private listen(): void {
    const toShare = (clientX: number) => {
      const area = this.app.scene.host.getBoundingClientRect();
      return (clientX - area.left) / area.width;
    };
    this.line.addEventListener('pointerdown', event => {
      this.line.setPointerCapture(event.pointerId);
      const move = (moved: PointerEvent) => { this.place = toShare(moved.clientX); };
      this.line.addEventListener('pointermove', move);
      this.line.addEventListener('pointerup', () => this.line.removeEventListener('pointermove', move), {once: true});
      event.preventDefault();
    });
    this.line.addEventListener('keydown', event => {
      const step = ({ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1} as Record<string, number>)[event.key];
      if (step === undefined) return;
      event.preventDefault();
      this.place = this.share + step;
    });
  }
}
