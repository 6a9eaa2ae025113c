// The menu that corrects a label: the classes of the pack, found by typing, chosen by Enter or a click.
import type {App} from '../app';
import {el, replace} from '../dom';
import {authorOf} from '../editor/author';
import {openDialog} from '../saving/dialog';
import {SourceError, type Correction, type Part} from '../source';
import {labelOf} from '../store';
import {words} from '../strings';

interface Choice { name: string; given: string | null }

function choicesOf(app: App, correction: Correction | null): Choice[] {
  const {classes} = app.store.value;
  const choices: Choice[] = classes.filter(entry => !entry.is_abstract).map(entry => ({name: entry.name, given: entry.name}));
  choices.push({name: words.correct.noClass, given: 'unknown'});
  if (correction) choices.unshift({name: words.correct.withdraw, given: null});
  return choices;
}

/** Writes a correction and asks for the labels and the score anew. */
export async function correct(app: App, [building, feature]: Part, given: string | null, why = ''): Promise<void> {
  try {
    await app.source.correct({building, feature, class: given, ...(why === '' ? {} : {why})});
    app.store.say(given === null ? words.correct.withdrawn : words.correct.done(given === 'unknown' ? words.correct.noClass : given));
    document.dispatchEvent(new CustomEvent('oriel-corrected'));
    authorOf(app).loop.refresh();
  } catch (error) {
    const body = error instanceof SourceError && error.status === 409 ? error.body : {};
    if (typeof body['disk_text'] === 'string' && await keepsOwn(body['disk_text'], String(body['own_text'])))
      return correct(app, [building, feature], given, why);
    app.store.say(error instanceof Error ? error.message : words.correct.failed, true);
  }
}

/** Shows what someone else has written of a part meanwhile and what the reader says; true if the reader's is to be written. */
async function keepsOwn(diskText: string, ownText: string): Promise<boolean> {
  const version = (title: string, text: string) => el('div', {}, el('h3', {}, title), el('pre', {}, text === '' ? words.correct.nothing : text));
  return await openDialog<boolean>(words.correct.conflict, 'correct', close => el('div', {},
    version(words.save.onDisk, diskText), version(words.correct.own, ownText),
    el('div', {class: 'dialog-buttons'},
      el('button', {type: 'button', class: 'button', onclick: () => close(false)}, words.correct.takeDisk),
      el('button', {type: 'button', class: 'button button-main', onclick: () => close(true)}, words.correct.keepOwn)))) === true;
}

class Menu {
  private readonly box: HTMLElement;
  private readonly input = el('input', {
    type: 'text', role: 'combobox', 'aria-expanded': 'true', 'aria-controls': 'correct-list', 'aria-label': words.correct.label, placeholder: words.correct.label,
    autocomplete: 'off', spellcheck: 'false'
  });
  private readonly why = el('input', {type: 'text', 'aria-label': words.correct.why, placeholder: words.correct.why, autocomplete: 'off'});
  private readonly list = el('ul', {role: 'listbox', id: 'correct-list', class: 'plain correct-list', 'aria-label': words.correct.label});
  private at = 0;
  private shown: Choice[] = [];
  private readonly before = document.activeElement as HTMLElement | null;
  private readonly away = (event: Event) => { if (!this.box.contains(event.target as Node)) this.close(false); };

  constructor(private readonly app: App, private readonly part: Part, private readonly choices: Choice[], title: string, x: number, y: number) {
    this.box = el('div', {class: 'correct-menu', role: 'dialog', 'aria-label': words.correct.title},
      el('p', {class: 'correct-title'}, title), this.input, this.list, this.why);
    this.input.addEventListener('input', () => this.fill());
    this.box.addEventListener('keydown', event => this.onKey(event));
    document.body.append(this.box);
    this.fill();
    this.place(x, y);
    this.input.focus();
    setTimeout(() => document.addEventListener('pointerdown', this.away), 0);
  }

  private place(x: number, y: number): void {
    const {offsetWidth, offsetHeight} = this.box;
    this.box.style.left = `${Math.max(8, Math.min(x, innerWidth - offsetWidth - 8))}px`;
    this.box.style.top = `${Math.max(8, Math.min(y, innerHeight - offsetHeight - 8))}px`;
  }

  private fill(): void {
    const text = this.input.value.trim().toLowerCase();
    const rank = (choice: Choice) => choice.name.toLowerCase().indexOf(text);
    this.shown = this.choices.filter(choice => rank(choice) >= 0);
    if (text !== '') this.shown.sort((a, b) => Math.min(rank(a), 1) - Math.min(rank(b), 1));
    this.at = 0;
    replace(this.list, ...this.shown.map((choice, at) => el('li', {
      role: 'option', id: `correct-${at}`, class: choice.given === null || choice.given === 'unknown' ? 'is-special' : '', onclick: () => this.choose(choice)
    }, choice.name)));
    this.mark();
  }

  private mark(): void {
    [...this.list.children].forEach((item, at) => {
      item.setAttribute('aria-selected', String(at === this.at));
      if (at === this.at) item.scrollIntoView({block: 'nearest'});
    });
    this.input.setAttribute('aria-activedescendant', `correct-${this.at}`);
  }

  private onKey(event: KeyboardEvent): void {
    event.stopPropagation();
    if (event.key === 'Escape') return this.close(true);
    if (event.key === 'Enter') {
      const choice = this.shown[this.at];
      if (choice) this.choose(choice);
      return;
    }
    const step = {ArrowDown: 1, ArrowUp: -1}[event.key];
    if (step === undefined || event.target !== this.input) return;
    event.preventDefault();
    this.at = Math.max(0, Math.min(this.shown.length - 1, this.at + step));
    this.mark();
  }

  private choose(choice: Choice): void {
    this.close(true);
    void correct(this.app, this.part, choice.given, this.why.value.trim());
  }

  private close(givesFocusBack: boolean): void {
    document.removeEventListener('pointerdown', this.away);
    this.box.remove();
    if (givesFocusBack) this.before?.focus();
  }
}

/** Opens the menu for a part at a place of the window. */
export async function openCorrectMenu(app: App, part: Part, x: number, y: number): Promise<void> {
  const [building, feature] = part;
  const {classes} = app.store.value;
  const named = app.feature(building, feature);
  const label = classes[labelOf(app.store.value, building, feature)]?.name ?? words.changes.unknown;
  const corrections = await app.source.corrections().catch(() => ({path: '', list: [] as Correction[]}));
  const own = corrections.list.find(entry => entry.building === building && entry.feature === feature) ?? null;
  document.querySelector('.correct-menu')?.remove();
  new Menu(app, part, choicesOf(app, own), words.correct.of(named?.name || named?.id || words.changes.part(feature), label), x, y);
}

/** A right click on a part of the picture, or C for the chosen one, opens the menu. */
export function bindCorrections(app: App): void {
  app.scene.host.addEventListener('contextmenu', event => {
    const over = app.store.value.hover ?? app.store.value.selection;
    if (over?.feature === undefined) return;
    event.preventDefault();
    app.select({building: over.building, feature: over.feature});
    void openCorrectMenu(app, [over.building, over.feature], event.clientX, event.clientY);
  });
  addEventListener('keydown', event => {
    const target = event.target as HTMLElement;
    if (event.key.toLowerCase() !== 'c' || event.ctrlKey || event.metaKey || event.altKey) return;
    if (target.isContentEditable || ['INPUT', 'TEXTAREA', 'SELECT'].includes(target.tagName)) return;
    const chosen = app.store.value.selection;
    if (chosen?.feature === undefined) return;
    event.preventDefault();
    const {left, top, width, height} = app.scene.host.getBoundingClientRect();
    void openCorrectMenu(app, [chosen.building, chosen.feature], left + width / 2, top + height / 2);
  });
}
