// The tree of classes with the rules that name them, what each has found, and the macros: a click goes to the line of the pack.
import type {App, Panel} from '../app';
import {el, replace} from '../dom';
import {authorOf} from '../editor/author';
import type {OutlineItem} from '../source';
import {words} from '../strings';
import {treeKeys} from './tree_keys';

const kPause_ms = 150;

/** An entry of the tree with what stands below it. */
interface Branch { item: OutlineItem; below: Branch[] }

/** Classes below their superclass, rules below the class they name; of items whose parent is unknown the top. */
function branchesOf(items: readonly OutlineItem[]): Branch[] {
  const classes = new Map<string, Branch>();
  for (const item of items) if (item.kind === 'class') classes.set(item.name, {item, below: []});
  const top: Branch[] = [];
  for (const item of items) {
    const branch = item.kind === 'class' ? classes.get(item.name)! : {item, below: []};
    if (branch.item !== item || (item.kind !== 'class' && item.kind !== 'rule')) continue;
    const parent = item.parent === null || item.parent === item.name ? undefined : classes.get(item.parent);
    (parent?.below ?? top).push(branch);
  }
  return top;
}

class Outline {
  readonly element: HTMLElement;
  private readonly tree = el('ul', {class: 'tree', role: 'tree', 'aria-label': words.outline.title});
  private readonly others = el('div', {class: 'outline-others'});
  private readonly empty = el('p', {class: 'empty'}, words.outline.empty);
  private readonly closed = new Set<string>();
  private items: OutlineItem[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;
  private isShown = false;

  constructor(private readonly app: App) {
    this.element = el('div', {class: 'panel outline'}, this.tree, this.others, this.empty);
    treeKeys(this.tree, (name, isOpen) => this.setOpen(name, isOpen));
    app.store.watch(['text'], () => this.askSoon());
    app.store.watch(['counts', 'score'], () => this.draw());
  }

  show(): void {
    this.isShown = true;
    void this.ask();
  }

  private askSoon(): void {
    clearTimeout(this.timer);
    if (this.isShown) this.timer = setTimeout(() => void this.ask(), kPause_ms);
  }

  private async ask(): Promise<void> {
    const text = authorOf(this.app).text;
    if (text === '') return;
    try {
      const answer = await this.app.source.language({verb: 'outline', text, line: 1, column: 1});
      if (answer.items.length > 0 || text.trim() === '') this.items = answer.items;
      this.draw();
    } catch {
      // The tree of the text before stays; the loop of the pack tells what is wrong.
    }
  }

  private setOpen(name: string, isOpen: boolean): void {
    if (isOpen) this.closed.delete(name);
    else this.closed.add(name);
    this.draw();
  }

  private draw(): void {
    if (!this.isShown) return;
    const focused = (document.activeElement as HTMLElement | null)?.dataset['name'];
    replace(this.tree, ...branchesOf(this.items).map(branch => this.branch(branch, 1)));
    const first = this.tree.querySelector<HTMLElement>('[role=treeitem]');
    if (first) first.tabIndex = 0;
    if (focused !== undefined) [...this.tree.querySelectorAll<HTMLElement>('[role=treeitem]')].find(node => node.dataset['name'] === focused)?.focus();
    replace(this.others, ...['macro', 'relation', 'group', 'generalise'].map(kind => this.section(kind)));
    this.empty.hidden = this.items.length > 0;
  }

  private branch(branch: Branch, level: number): HTMLElement {
    const {item, below} = branch;
    const key = `${item.kind} ${item.name}`;
    const isOpen = !this.closed.has(key);
    const node = el('li', {
      role: 'treeitem', class: `tree-item is-${item.kind}`, tabindex: '-1', 'data-name': key, 'aria-level': String(level),
      'aria-expanded': below.length > 0 ? String(isOpen) : null
    }, el('div', {class: 'tree-row', onclick: () => this.app.openLine(item.line)},
      el('span', {class: below.length > 0 ? 'fold is-tree' : 'fold is-leaf', onclick: (event: Event) => {
        if (below.length === 0) return;
        event.stopPropagation();
        this.setOpen(key, !isOpen);
      }}),
      el('span', {class: 'tree-name'}, item.name), ...this.facts(item)));
    if (below.length > 0 && isOpen) node.append(el('ul', {role: 'group'}, ...below.map(child => this.branch(child, level + 1))));
    return node;
  }

  /** What a class has found and how well, what a rule was right and wrong about. */
  private facts(item: OutlineItem): (Node | null)[] {
    const {counts, score} = this.app.store.value;
    if (item.kind === 'class') {
      const found = counts.find(entry => entry.class === item.name);
      const own = score?.classes.find(entry => entry.name === item.name);
      return [
        own ? el('span', {class: 'tree-fact number', title: words.outline.f1Hint}, words.params.f1(own.f1)) : null,
        found ? el('span', {class: 'tree-count number', title: words.outline.countHint}, String(found.count)) : null
      ];
    }
    const rule = score?.rules.find(entry => entry.rule === item.name);
    if (!rule) return [];
    return [el('span', {class: 'tree-fact number', title: words.truth.ruleHint}, words.truth.ruleShort(rule.right, rule.wrong))];
  }

  private section(kind: string): HTMLElement | null {
    const items = this.items.filter(item => item.kind === kind);
    if (items.length === 0) return null;
    return el('section', {}, el('h3', {}, words.outline.kind(kind)), el('ul', {class: 'plain'}, ...items.map(item =>
      el('li', {}, el('button', {type: 'button', class: 'tree-row', onclick: () => this.app.openLine(item.line)}, item.name)))));
  }
}

export function outlinePanel(app: App): Panel {
  const outline = new Outline(app);
  return {id: 'outline', title: words.outline.title, element: outline.element, onShow: () => outline.show()};
}
