// What the last edit has changed: every label before and after, grouped, with F1 before and after; a click shows the parts.
import type {App, Panel} from '../app';
import {el, replace} from '../dom';
import {authorOf} from '../editor/author';
import type {Change, Part} from '../source';
import {words} from '../strings';
import {changesSince, groupsOf, snapshotOf, type ChangeGroup, type Snapshot} from './baseline';

/** Edits that follow each other faster than this are one: words being typed, or one slider being dragged. */
const kBurst_ms = 1500;
/** Parts listed by name in a group; the group itself shows all of them. */
const kListed = 200;

type Since = 'edit' | 'save';

class Changes {
  readonly element: HTMLElement;
  private readonly list = el('div', {class: 'change-groups'});
  private readonly sum = el('p', {class: 'changes-sum', 'aria-live': 'polite'});
  private readonly since = el('select', {'aria-label': words.changes.since},
    el('option', {value: 'edit'}, words.changes.sinceEdit), el('option', {value: 'save'}, words.changes.sinceSave));
  private readonly marks: Record<Since, {labels: Snapshot; f1: number | null}> = {edit: {labels: new Map(), f1: null}, save: {labels: new Map(), f1: null}};
  private editedAt = -Infinity;
  private editedParam: string | null = null;
  private savedText: string | null = null;
  private isSaveUnmarked = false;

  private readonly fills = new WeakMap<HTMLElement, readonly Change[]>();

  constructor(private readonly app: App) {
    const author = authorOf(app);
    this.since.addEventListener('change', () => this.compare());
    this.element = el('div', {class: 'panel changes'}, el('div', {class: 'changes-head'}, this.sum, this.since), this.list);
    author.watch(param => this.onText(param));
    author.loop.onAnswer(() => { this.markSave(); this.compare(); });
    app.store.watch(['labels'], () => this.onLabels());
    app.store.watch(['features'], () => this.fillAgain());
  }

  /** A new burst of edits begins: what is on the screen now is "before". */
  private onText(param: string | null): void {
    const author = authorOf(this.app);
    if (this.savedText !== author.savedText) {
      this.savedText = author.savedText;
      this.isSaveUnmarked = true;
      this.markSave();
      return;
    }
    const now = performance.now();
    if (now - this.editedAt > kBurst_ms || param !== this.editedParam) this.mark('edit');
    this.editedAt = now;
    this.editedParam = param;
  }

  /** A pack that was changed while it was written is marked when its labels have come. */
  private markSave(): void {
    const author = authorOf(this.app);
    if (!this.isSaveUnmarked || author.isDirty || !author.loop.isCurrent) return;
    this.isSaveUnmarked = false;
    this.mark('save');
  }

  private mark(which: Since): void {
    const {labels, classes, score} = this.app.store.value;
    this.marks[which] = {labels: snapshotOf(labels, classes), f1: score?.macro_f1 ?? null};
  }

  /** Buildings that come while the page loads belong to both marks as they are. */
  private onLabels(): void {
    if (authorOf(this.app).isDirty || performance.now() - this.editedAt < kBurst_ms) return;
    const {labels, classes, score} = this.app.store.value;
    const missing = [...labels].filter(([building]) => !this.marks.save.labels.has(building));
    if (missing.length === 0) return;
    const fresh = snapshotOf(new Map(missing), classes);
    for (const which of ['edit', 'save'] as const) {
      this.marks[which] = {labels: new Map([...this.marks[which].labels, ...fresh]), f1: score?.macro_f1 ?? null};
    }
  }

  private compare(): void {
    const {labels, classes, score} = this.app.store.value;
    const mark = this.marks[this.since.value as Since];
    const {changes, names} = changesSince(mark.labels, labels, classes);
    this.app.store.set({changed: changes, changed_count: changes.length});
    const f1 = score?.macro_f1 ?? null;
    this.sum.textContent = words.changes.sum(changes.length, mark.f1, f1);
    this.element.classList.toggle('is-empty', changes.length === 0);
    replace(this.list, ...groupsOf(changes, names, classes).map(group => this.group(group)));
  }

  private group(group: ChangeGroup): HTMLElement {
    const parts = group.changes.map((change): Part => [change.building, change.feature]);
    const before = group.before ?? words.changes.unknown;
    const after = group.after ?? words.changes.unknown;
    const title = words.changes.title(before, after, parts.length);
    const items = el('ul', {class: 'plain change-items'});
    const box = el('details', {class: 'change-group'},
      el('summary', {}, el('span', {class: 'change-before'}, before), el('span', {class: 'change-arrow', 'aria-label': words.changes.becomes}, '→'),
        el('span', {class: 'change-after'}, after), el('span', {class: 'tree-count number'}, String(parts.length))),
      el('button', {type: 'button', class: 'link', onclick: () => this.app.show(parts, title)}, words.changes.showAll), items);
    box.addEventListener('toggle', () => { if (box.open && items.childElementCount === 0) this.fill(items, group.changes); });
    this.fills.set(items, group.changes);
    return box;
  }

  /** Names have come. */
  private fillAgain(): void {
    for (const box of this.list.querySelectorAll('details[open]')) {
      const items = box.querySelector<HTMLElement>('.change-items');
      const changes = items && this.fills.get(items);
      if (changes) this.fill(items, changes);
    }
  }

  private fill(items: HTMLElement, changes: readonly Change[]): void {
    const {buildings} = this.app.store.value;
    items.replaceChildren();
    for (const change of changes.slice(0, kListed)) {
      const feature = this.app.feature(change.building, change.feature);
      const name = feature?.name || feature?.id || words.changes.part(change.feature);
      items.append(el('li', {}, el('button', {
        type: 'button', class: 'tree-row', onclick: () => this.app.select({building: change.building, feature: change.feature}, true)
      }, name, el('span', {class: 'tree-fact'}, buildings[change.building]?.id ?? ''))));
    }
    if (changes.length > kListed) items.append(el('li', {class: 'quiet small'}, words.changes.more(changes.length - kListed)));
  }
}

export function changesPanel(app: App): Panel {
  return {id: 'changes', title: words.changes.name, element: new Changes(app).element};
}
