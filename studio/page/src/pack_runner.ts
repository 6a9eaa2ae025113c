// Asks for the labels of a pack's text and keeps the answers: newest wins, an answer to an older text is dropped, and a pack with
// errors leaves the labels of the last good one in place.
import {SourceError, type PackAnswer, type Source} from './source';
import type {Store} from './store';

export class PackRunner {
  private version = 0;
  /** Of the labels that are at hand; 0: none. */
  private number = 0;

  /** `onLabels` hears of which buildings other labels have come. */
  constructor(private readonly source: Source, private readonly store: Store, private readonly onLabels: (buildings: number[]) => void) {}

  /** True when the answer was taken; false when a newer text has overtaken it. Throws what the source throws otherwise. */
  async run(text: string, params?: Record<string, string>, all = false): Promise<boolean> {
    const version = ++this.version;
    let answer: PackAnswer;
    try {
      answer = await this.source.pack({text, version, ...(params ? {params} : {}), since: all ? 0 : this.number});
    } catch (error) {
      if (error instanceof SourceError && error.isSuperseded) return false;
      throw error;
    }
    if (version !== this.version) return this.keepLabels(answer);
    // Where nothing is written yet, nothing is wrong.
    const isNew = text.trim() === '';
    this.store.set({version, is_good: answer.is_good || isNew, findings: isNew ? [] : answer.findings, ms: answer.ms});
    if (isNew) this.clear();
    if (answer.is_good) this.take(answer);
    return true;
  }

  /** The labels of an overtaken answer count still: the next one has what changed since them. */
  private keepLabels(answer: PackAnswer): boolean {
    if (answer.is_good) this.take(answer);
    return false;
  }

  private clear(): void {
    this.number = 0;
    this.store.set({labels: new Map(), classes: [], params: [], counts: [], unknown: 0, doubtful: [], score: null});
  }

  private take(answer: PackAnswer): void {
    this.number = answer.number ?? 0;
    const labels = new Map(this.store.value.labels);
    for (const [building, classes] of Object.entries(answer.labels)) labels.set(Number(building), classes);
    this.onLabels(Object.keys(answer.labels).map(Number));
    this.store.set({
      labels, classes: answer.classes, params: answer.params, counts: answer.counts, unknown: answer.unknown,
      doubtful: answer.doubtful, score: answer.score
    });
  }
}
