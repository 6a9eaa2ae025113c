// A column of panels behind tabs, as the ARIA pattern of tabs asks: arrow keys move along the tabs, one is in the tab order.
import type {Panel} from '../app';
import {el} from '../dom';

export class Dock {
  readonly element: HTMLElement;
  readonly tabs: HTMLElement;
  private readonly body = el('div', {class: 'dock-body'});
  private panels: Panel[] = [];
  private current: string | null = null;

  /** `onTab` is called when the reader chooses a tab; true if it was in front already. */
  constructor(name: string, label: string, private readonly onTab: (wasInFront: boolean) => void) {
    this.tabs = el('div', {class: 'tabs', role: 'tablist', 'aria-label': label});
    this.element = el('section', {class: `dock dock-${name}`, 'aria-label': label}, this.tabs, this.body);
    this.tabs.addEventListener('keydown', event => this.onKey(event));
  }

  has(id: string): boolean { return this.panels.some(panel => panel.id === id); }

  set(panels: Panel[]): void {
    this.panels = panels;
    this.tabs.replaceChildren(...panels.map(panel => this.tabOf(panel)));
    this.body.replaceChildren(...panels.map(panel => {
      const element = panel.element;
      element.id = `panel-${panel.id}`;
      element.dataset['panel'] = panel.id;
      element.setAttribute('role', 'tabpanel');
      element.setAttribute('aria-labelledby', `tab-${panel.id}`);
      element.tabIndex = -1;
      return element;
    }));
    const first = panels.find(panel => panel.id === this.current) ?? panels[0];
    this.current = null;
    if (first) this.show(first.id);
    this.element.hidden = panels.length === 0;
  }

  show(id: string): void {
    const isNew = this.current !== id;
    this.current = id;
    for (const panel of this.panels) {
      panel.element.hidden = panel.id !== id;
      const tab = this.tabs.querySelector<HTMLElement>(`#tab-${panel.id}`);
      tab?.setAttribute('aria-selected', String(panel.id === id));
      if (tab) tab.tabIndex = panel.id === id ? 0 : -1;
      if (panel.id === id) tab?.scrollIntoView({block: 'nearest', inline: 'nearest'});
    }
    if (isNew) this.panels.find(panel => panel.id === id)?.onShow?.();
  }

  private tabOf(panel: Panel): HTMLElement {
    return el('button', {
      type: 'button', class: 'tab', role: 'tab', id: `tab-${panel.id}`, 'aria-controls': `panel-${panel.id}`,
      onclick: () => { const was = this.current === panel.id; this.show(panel.id); this.onTab(was); }
    }, panel.title);
  }

  private onKey(event: KeyboardEvent): void {
    const at = this.panels.findIndex(panel => panel.id === this.current);
    const to = {ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: this.panels.length - 1}[event.key];
    if (to === undefined || at < 0) return;
    event.preventDefault();
    const panel = this.panels[(to + this.panels.length) % this.panels.length]!;
    this.show(panel.id);
    this.onTab(false);
    this.tabs.querySelector<HTMLElement>(`#tab-${panel.id}`)?.focus();
  }
}
