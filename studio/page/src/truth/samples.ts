// What people say of single parts: corrections, the parts most worth a look, and learning from both.
import type {App, Panel} from '../app';
import {el, replace} from '../dom';
import type {AskAnswer, Correction, Part} from '../source';
import {labelOf} from '../store';
import {words} from '../strings';
import {correct, openCorrectMenu} from './correct_menu';
import {LearnBox} from './learn';

const kAsked = 10;

function nameOf(app: App, [building, feature]: Part): string {
  const named = app.feature(building, feature);
  return named?.name || named?.id || words.changes.part(feature);
}

class Samples {
  readonly element: HTMLElement;
  private readonly chosen = el('div', {class: 'chosen'});
  private readonly corrections = el('ul', {class: 'plain sample-list'});
  private readonly correctionsSum = el('p', {class: 'small quiet'});
  private readonly asked = el('ol', {class: 'plain sample-list'});
  private readonly askButton = el('button', {type: 'button', class: 'button', onclick: () => void this.ask()}, words.samples.ask);
  private isShown = false;
  private listed: Correction[] = [];
  private worth: AskAnswer['parts'] = [];

  constructor(private readonly app: App) {
    this.element = el('div', {class: 'panel samples'}, this.chosen,
      el('section', {}, el('h3', {}, words.samples.corrections), this.correctionsSum, this.corrections),
      el('section', {}, el('h3', {}, words.samples.worth), el('p', {class: 'small quiet'}, words.samples.worthWhy), this.askButton, this.asked),
      new LearnBox(app).element);
    app.store.watch(['selection', 'labels', 'features'], () => this.showChosen());
    app.store.watch(['features'], () => this.fill());
    document.addEventListener('oriel-corrected', () => void this.read());
  }

  show(): void {
    this.isShown = true;
    void this.read();
  }

  private showChosen(): void {
    const {selection, classes} = this.app.store.value;
    if (selection?.feature === undefined) {
      replace(this.chosen, el('p', {class: 'quiet'}, words.samples.choose));
      return;
    }
    const part: Part = [selection.building, selection.feature];
    const label = classes[labelOf(this.app.store.value, ...part)]?.name ?? words.changes.unknown;
    const button = el('button', {type: 'button', class: 'button button-main', onclick: () => {
      const {left, bottom} = button.getBoundingClientRect();
      void openCorrectMenu(this.app, part, left, bottom + 4);
    }}, words.samples.correct);
    replace(this.chosen, el('p', {}, el('strong', {}, label), ' ', el('span', {class: 'quiet'}, nameOf(this.app, part))), button);
  }

  private async read(): Promise<void> {
    if (!this.isShown) return;
    try {
      const {path, list} = await this.app.source.corrections();
      this.correctionsSum.textContent = list.length === 0 ? words.samples.noCorrections(path) : words.samples.inFile(list.length, path);
      this.listed = list;
      this.fill();
    } catch (error) {
      this.correctionsSum.textContent = error instanceof Error ? error.message : words.source.garbled;
    }
  }

  /** Again when names have come. */
  private fill(): void {
    replace(this.corrections, ...this.listed.map(entry => this.correctionItem(entry)));
    if (this.worth.length > 0) replace(this.asked, ...this.worth.map(entry => this.askedItem([entry.building, entry.feature], entry.sentence)));
  }

  private correctionItem(entry: Correction): HTMLElement {
    const part: Part = [entry.building, entry.feature];
    const told = [entry.by, entry.why].filter(text => text !== undefined && text !== '').join(': ');
    return el('li', {}, el('button', {type: 'button', class: 'tree-row', onclick: () => this.app.select({building: part[0], feature: part[1]}, true)},
      el('strong', {}, entry.class), el('span', {class: 'tree-fact'}, nameOf(this.app, part)), told !== '' && el('span', {class: 'sample-why'}, told)),
    el('button', {type: 'button', class: 'icon-button', 'aria-label': words.samples.withdraw(nameOf(this.app, part)), title: words.correct.withdraw,
      onclick: () => void correct(this.app, part, null)}, '×'));
  }

  private async ask(): Promise<void> {
    this.askButton.disabled = true;
    try {
      const answer = await this.app.source.ask(kAsked);
      this.worth = answer.parts;
      this.fill();
      if (answer.parts.length === 0) replace(this.asked, el('li', {class: 'quiet'}, words.samples.nothingToAsk));
    } catch (error) {
      replace(this.asked, el('li', {class: 'grave'}, error instanceof Error ? error.message : words.source.garbled));
    }
    this.askButton.disabled = false;
  }

  private askedItem(part: Part, sentence: string): HTMLElement {
    const choose = el('button', {type: 'button', class: 'tree-row', onclick: () => this.app.select({building: part[0], feature: part[1]}, true)},
      el('strong', {}, nameOf(this.app, part)), el('span', {class: 'sample-why'}, sentence));
    const fix = el('button', {type: 'button', class: 'link small', onclick: () => {
      const {left, bottom} = fix.getBoundingClientRect();
      this.app.select({building: part[0], feature: part[1]}, true);
      void openCorrectMenu(this.app, part, left, bottom + 4);
    }}, words.samples.say);
    return el('li', {}, choose, fix);
  }
}

export function samplesPanel(app: App): Panel {
  const samples = new Samples(app);
  return {id: 'samples', title: words.samples.title, element: samples.element, onShow: () => samples.show()};
}
