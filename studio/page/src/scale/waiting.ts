// What is being drawn, how long that has taken, and how to end it: in the panel, and over the picture, where people look.
import {el} from '../dom';
import {words} from '../strings';

/** What comes sooner needs no words. */
const kQuick_ms = 400;
const kStep_ms = 250;
/** From then on the picture says that long waits are usual. */
const kLong_ms = 8000;

export class Waiting {
  readonly element: HTMLElement;
  private readonly what = el('span', {class: 'waiting-what', role: 'status'});
  private readonly time = el('span', {class: 'number quiet', 'aria-hidden': 'true'});
  private readonly long = el('span', {class: 'quiet waiting-long', hidden: true}, words.scale.long);
  private readonly pill = el('p', {class: 'waiting-pill', hidden: true, 'aria-hidden': 'true'});
  private timer: ReturnType<typeof setInterval> | undefined;
  private at = '';
  private isAsking = false;

  /** `stage` says in a word what the work is at. */
  constructor(host: HTMLElement, private readonly cancel: () => void, private readonly stage: () => Promise<string>) {
    const button = el('button', {type: 'button', class: 'button tool', title: words.scale.cancelHint, onclick: () => this.cancel()}, words.scale.cancel);
    this.element = el('div', {class: 'waiting', hidden: true}, el('progress', {'aria-hidden': 'true'}), el('div', {class: 'waiting-row'}, this.what, this.time, button), this.long);
    host.append(this.pill);
    addEventListener('keydown', event => {
      if (event.key !== 'Escape' || this.timer === undefined) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      this.cancel();
    }, true);
  }

  /** What it is at is told where the source knows it. */
  private async ask(): Promise<void> {
    this.isAsking = true;
    this.at = await this.stage().catch(() => '');
    this.isAsking = false;
  }

  begin(what: string): void {
    this.at = '';
    const begin = performance.now();
    clearInterval(this.timer);
    this.timer = setInterval(() => {
      const waited = performance.now() - begin;
      if (waited < kQuick_ms) return;
      if (this.what.textContent !== what) this.what.textContent = what;
      this.time.textContent = [words.scale.stages[this.at] ?? '', words.scale.seconds(waited / 1000)].filter(Boolean).join(', ');
      if (!this.isAsking) void this.ask();
      this.pill.textContent = `${what} ${words.scale.seconds(waited / 1000)}`;
      this.long.hidden = waited < kLong_ms;
      this.element.hidden = this.pill.hidden = false;
    }, kStep_ms);
  }

  end(): void {
    clearInterval(this.timer);
    this.timer = undefined;
    this.element.hidden = this.pill.hidden = true;
    this.what.textContent = '';
  }
}
