// The frame of the page: a bar, the rules at the left, the building in the middle, what is said of it at the right. On a narrow
// screen all panels are in one dock; on a phone that dock is a sheet under the building.
import type {Panel} from '../app';
import {el} from '../dom';
import type {Store} from '../store';
import {words} from '../strings';
import {Dock} from './dock';
import {dragger} from './dragger';
import {helpButton} from './help';
import {icon} from './icons';
import {loadBar, statusLine} from './status';
import {switchTheme} from './theme';

const kPhone = matchMedia('(max-width: 759px)');
const kNarrow = matchMedia('(max-width: 1099px)');

export class Shell {
  readonly sceneHost: HTMLElement;
  /** Finds by text as the search box does. */
  search: ((text: string) => void) | null = null;
  private readonly frame: HTMLElement;
  private readonly bar: HTMLElement;
  private readonly left: Dock;
  private readonly right: Dock;
  private readonly sides = new Map<string, 'left' | 'right' | 'legend'>();
  private readonly panels: Panel[] = [];
  private readonly legendHost = el('div', {class: 'legend-card'});

  constructor(root: HTMLElement, store: Store, title: string) {
    this.left = new Dock('left', words.shell.left, () => {});
    this.right = new Dock('right', words.shell.right, wasInFront => this.onRightTab(wasInFront));
    this.sceneHost = el('div', {class: 'scene', id: 'scene'}, this.legendHost, loadBar(store));
    this.bar = el('header', {class: 'bar'},
      el('h1', {class: 'brand'}, title),
      el('span', {class: 'pack-name', id: 'pack-name'}),
      statusLine(store),
      el('span', {class: 'bar-space'}),
      el('button', {type: 'button', class: 'icon-button', 'aria-label': words.shell.theme, title: words.shell.theme,
        onclick: () => switchTheme(store)}, icon('theme')),
      helpButton());
    this.frame = el('div', {class: 'frame', 'data-opening': ''}, this.bar,
      this.left.element, dragger(words.shell.divider, 'left'), el('main', {class: 'stage'}, this.sceneHost),
      dragger(words.shell.sheet, 'right'), this.right.element);
    root.replaceChildren(el('a', {class: 'skip', href: '#scene'}, words.shell.skip), this.frame);
    store.watch(['pack'], () => {
      const name = store.value.pack.name;
      document.getElementById('pack-name')!.textContent = name;
      document.title = name ? `${name} – ${title}` : title;
    });
    kPhone.addEventListener('change', () => this.settle());
    kNarrow.addEventListener('change', () => this.settle());
  }

  add(side: 'left' | 'right', panel: Panel): void {
    this.sides.set(panel.id, side);
    this.panels.push(panel);
  }

  /** The legend lies over the scene where there is room; on a phone it is a panel among the others. */
  addLegend(panel: Panel): void {
    this.sides.set(panel.id, 'legend');
    this.panels.push(panel);
  }

  addSearch(box: {element: HTMLElement; search: (text: string) => void}): void {
    this.search = box.search;
    this.bar.querySelector('.bar-space')!.after(box.element);
  }

  /** Shows what is around the picture. */
  reveal(): void { delete this.frame.dataset['opening']; }

  /** Puts every panel where it belongs at this width. */
  settle(): void {
    const of = (...sides: string[]) => this.panels.filter(panel => sides.includes(this.sides.get(panel.id)!));
    const hasLeft = of('left').length > 0;
    this.frame.dataset['mode'] = kPhone.matches ? 'phone' : kNarrow.matches || !hasLeft ? 'two' : 'three';
    const legend = of('legend');
    if (kPhone.matches) {
      this.left.set([]);
      this.right.set([...of('right').slice(0, 1), ...legend, ...of('left'), ...of('right').slice(1)]);
    } else {
      this.legendHost.replaceChildren(...legend.map(panel => panel.element));
      for (const panel of legend) { panel.element.hidden = false; panel.element.removeAttribute('role'); }
      this.left.set(kNarrow.matches ? [] : of('left'));
      this.right.set(kNarrow.matches ? [...of('left'), ...of('right')] : of('right'));
    }
    this.legendHost.hidden = kPhone.matches;
    if (!kPhone.matches) this.frame.dataset['sheet'] = 'open';
    else this.frame.dataset['sheet'] ??= 'closed';
  }

  /** Brings a panel to the front; with `isQuiet` a sheet that is closed stays so unless it is about a part. */
  open(id: string, isQuiet = false): void {
    for (const dock of [this.left, this.right]) {
      if (!dock.has(id)) continue;
      if (isQuiet && !kPhone.matches && this.isEditing(dock)) return;
      dock.show(id);
    }
    if (kPhone.matches) this.frame.dataset['sheet'] = 'open';
  }

  /** In two columns the editor shares its dock with the explanation: who types is not interrupted. */
  private isEditing(dock: Dock): boolean {
    return dock.element.contains(document.activeElement) && document.activeElement?.closest('[data-panel]') !== null &&
      (document.activeElement as HTMLElement).isContentEditable;
  }

  private onRightTab(wasInFront: boolean): void {
    if (!kPhone.matches) return;
    this.frame.dataset['sheet'] = wasInFront && this.frame.dataset['sheet'] === 'open' ? 'closed' : 'open';
  }
}
