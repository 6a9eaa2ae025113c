// Sends the pack to the engine as it is written. One question is on its way at a time and the newest text goes next: a dragged
// slider is answered as fast as the engine can, and typing never queues up.
import type {App} from '../app';
import {SourceError} from '../source';
import {words} from '../strings';

/** Keystrokes of one word come as one question. */
const kTypingPause_ms = 25;
const kRetry_ms = 1000;

export class PackLoop {
  private text = '';
  private needsAll = false;
  private isAsking = false;
  private isWaiting = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly listeners: (() => void)[] = [];

  constructor(private readonly app: App) {}

  /** Whether the store holds the answer to the text as it stands. */
  get isCurrent(): boolean { return !this.isWaiting && !this.isAsking; }

  /** Calls `call` after every answer to the newest text. */
  onAnswer(call: () => void): void { this.listeners.push(call); }

  /** The text that the page has asked about already. */
  adopt(text: string): void { this.text = text; }

  /** The text has changed. `atOnce` leaves out the pause for typing. */
  change(text: string, atOnce = false): void {
    this.text = text;
    this.app.store.set({text});
    this.schedule(atOnce ? 0 : kTypingPause_ms);
  }

  /** Asks again, with the labels of all buildings. */
  refresh(): void {
    this.needsAll = true;
    this.schedule(0);
  }

  private schedule(pause_ms: number): void {
    this.isWaiting = true;
    clearTimeout(this.timer);
    this.timer = undefined;
    if (this.isAsking) return;
    if (pause_ms === 0) void this.ask();
    else this.timer = setTimeout(() => void this.ask(), pause_ms);
  }

  private async ask(): Promise<void> {
    this.timer = undefined;
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
