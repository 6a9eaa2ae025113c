// One param: its name, its value as number and slider, the curve over it, and the reason.
import {el, replace} from '../dom';
import type {CurveAnswer, ParamEntry} from '../source';
import {words} from '../strings';
import {bestOf, drawCurve, f1At} from './curve';
import {stepOf, typedValue, unitOf, written} from './quantity';

export interface RowEvents {
  /** The value is `text` now; `isFirst` begins a drag. */
  onValue(name: string, text: string, isFirst: boolean): void;
  onOpen(line: number): void;
}

export class ParamRow {
  readonly element: HTMLElement;
  isDragging = false;
  private readonly slider = el('input', {type: 'range', class: 'param-slider'});
  private readonly field = el('input', {class: 'param-field', inputmode: 'decimal', autocomplete: 'off', spellcheck: 'false'});
  private readonly curveBox = el('div', {class: 'param-curve'});
  private readonly told = el('span', {class: 'param-f1 number'});
  private readonly best = el('button', {type: 'button', class: 'link param-best'});
  private readonly reason = el('p', {class: 'param-reason'});
  private readonly ends = el('div', {class: 'param-ends number'});
  private readonly name: HTMLButtonElement;
  private curve: CurveAnswer | null = null;

  constructor(private entry: ParamEntry, private readonly events: RowEvents) {
    this.name = el('button', {type: 'button', class: 'param-name', title: words.params.openHint, onclick: () => events.onOpen(this.entry.line)}, entry.name);
    this.field.setAttribute('aria-label', words.params.valueOf(entry.name));
    this.slider.setAttribute('aria-label', entry.name);
    this.listen();
    this.element = el('section', {class: 'param', 'data-param': entry.name},
      el('div', {class: 'param-head'}, this.name, this.told, this.field), this.curveBox, this.slider, this.ends, this.best, this.reason);
    this.update(entry);
  }

  private get unit() { return unitOf(this.entry.text); }
  private get hasRange(): boolean { return this.entry.from !== null && this.entry.to !== null && this.entry.to > this.entry.from; }
  private get step(): number { return this.hasRange ? stepOf(this.entry.from!, this.entry.to!) : 0.01; }

  private listen(): void {
    this.slider.addEventListener('input', () => {
      const isFirst = !this.isDragging;
      this.isDragging = true;
      this.send(Number(this.slider.value), isFirst);
    });
    this.slider.addEventListener('change', () => { this.isDragging = false; });
    this.field.addEventListener('change', () => this.readField());
    this.field.addEventListener('keydown', event => {
      if (event.key === 'Enter') this.readField();
      if (event.key === 'ArrowUp' || event.key === 'ArrowDown') this.nudge(event);
    });
    this.best.addEventListener('click', () => {
      const best = this.curve && bestOf(this.curve);
      if (best) this.send(best.value, true);
    });
  }

  private nudge(event: KeyboardEvent): void {
    const value = typedValue(this.field.value, this.unit);
    if (value === null) return;
    event.preventDefault();
    const step = this.step * (event.shiftKey ? 10 : 1);
    this.send(value + (event.key === 'ArrowUp' ? step : -step), true);
  }

  private readField(): void {
    const value = typedValue(this.field.value, this.unit);
    this.field.setAttribute('aria-invalid', String(value === null));
    if (value === null) return;
    const isInRange = !this.hasRange || (value >= this.entry.from! - 1e-9 && value <= this.entry.to! + 1e-9);
    this.field.setAttribute('aria-invalid', String(!isInRange));
    if (isInRange) this.send(value, true, true);
  }

  /** Writes a value, kept within the range; as exactly as it was typed, or to the step of the slider. */
  private send(value: number, isFirst: boolean, isTyped = false): void {
    const kept = this.hasRange ? Math.min(this.entry.to!, Math.max(this.entry.from!, value)) : value;
    const text = written(kept, this.unit, isTyped ? this.step / 1000 : this.step);
    this.show(kept, text);
    this.events.onValue(this.entry.name, text, isFirst);
  }

  private show(value: number, text: string): void {
    this.field.value = text;
    this.slider.value = String(value);
    this.slider.setAttribute('aria-valuetext', text);
    const {from, to} = this.entry;
    if (from !== null && to !== null) this.element.style.setProperty('--at', String((value - from) / (to - from)));
    this.sayCurve(value);
  }

  /** The engine's view of the param: the text in the pack wins, but not over the hand that is dragging. */
  update(entry: ParamEntry): void {
    this.entry = entry;
    this.reason.textContent = entry.reason;
    this.slider.hidden = this.ends.hidden = !this.hasRange;
    if (this.hasRange) {
      const {from, to} = entry;
      this.slider.min = String(from);
      this.slider.max = String(to);
      this.slider.step = String(this.step);
      replace(this.ends, el('span', {}, written(from!, this.unit, this.step)), el('span', {}, written(to!, this.unit, this.step)));
    }
    if (this.isDragging || document.activeElement === this.field) return;
    this.show(entry.value, entry.text);
  }

  setCurve(given: CurveAnswer | null, isFresh: boolean): void {
    const curve = given && given.values.length > 1 ? given : null;
    this.curve = curve;
    this.element.classList.toggle('is-stale', !isFresh);
    this.element.classList.toggle('has-curve', curve !== null && this.hasRange);
    if (!curve || !this.hasRange) {
      replace(this.curveBox);
      this.best.hidden = true;
      this.told.textContent = '';
      return;
    }
    replace(this.curveBox, drawCurve(curve, this.entry.from!, this.entry.to!), el('span', {class: 'curve-here'}));
    this.sayCurve(Number(this.slider.value));
  }

  private sayCurve(value: number): void {
    const best = this.curve && bestOf(this.curve);
    const here = this.curve && f1At(this.curve, value);
    this.best.hidden = !best || here === null || best.f1 - here < 5e-4;
    if (best) this.best.textContent = words.params.best(best.f1, written(best.value, this.unit, this.step));
    if (here !== null) this.told.textContent = words.params.f1(here);
  }
}
