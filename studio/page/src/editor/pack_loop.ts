// Sends the pack to the engine as it is written. One question is on its way at a time and the newest text goes next: a dragged
// slider is answered as fast as the engine can, and typing never queues up.
import type {App} from '../app';
import {SourceError} from '../source';
import {words} from '../strings';

const kRetry_ms = 1000;

export class PackLoop {
  private text = '';
  private needsAll = false;
  private isAsking = false;
  private isWaiting = false;
  private readonly listeners: (() => void)[] = [];

  constructor(private readonly app: App) {}

  /** Whether the store holds the answer to the text as it stands. */
  get isCurrent(): boolean { return !this.isWaiting && !this.isAsking; }

  /** Calls `call` after every answer to the newest text. */
  onAnswer(call: () => void): void { this.listeners.push(call); }

  /** The text that the page has asked about already. */
  adopt(text: string): void { this.text = text; }

  /** The text has changed. */
  change(text: string): void {
    this.text = text;
    this.app.store.set({text});
    this.schedule();
  }

  /** Asks again, with the labels of all buildings. */
  refresh(): void {
    this.needsAll = true;
    this.schedule();
  }

  private schedule(): void {
    this.isWaiting = true;
    if (!this.isAsking) void this.ask();
  }

  private async ask(): Promise<void> {
    this.isWaiting = false;
    this.isAsking = true;
    const all = this.needsAll;
    let isTaken = false;
    try {
      isTaken = await this.app.packs.run(this.text, undefined, all);
      if (all && isTaken && this.app.store.value.is_good) this.needsAll = false;
    } catch (error) {
      this.fail(error);
    }
    this.isAsking = false;
    if (this.isWaiting) void this.ask();
    else if (isTaken) for (const call of this.listeners) call();
  }

  private fail(error: unknown): void {
    this.needsAll = true;
    this.app.store.say(error instanceof SourceError ? error.message : words.source.garbled, true);
    const isRefused = error instanceof SourceError && error.status >= 400 && error.status < 500;
    if (!isRefused) setTimeout(() => { if (this.isCurrent) void this.ask(); }, kRetry_ms);
  }
}
