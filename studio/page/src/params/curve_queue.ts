// Curves cost the engine some labellings each: they are asked for one at a time, only for params on the screen, and only when
// nobody is typing or dragging.
import type {App} from '../app';
import type {CurveAnswer} from '../source';

const kPause_ms = 350;

interface Kept { curve: CurveAnswer; stamp: number }

/** Without the values for which there is no F1. */
function measured(curve: CurveAnswer): CurveAnswer {
  const places = curve.f1.map((_, at) => at).filter(at => typeof curve.f1[at] === 'number');
  return {values: places.map(at => curve.values[at]!), f1: places.map(at => curve.f1[at]!), at: curve.at};
}

export class CurveQueue {
  private readonly kept = new Map<string, Kept>();
  private readonly stamps = new Map<string, number>();
  private readonly wanted = new Set<string>();
  private stamp = 0;
  private ofClass: string | undefined;
  private isAsking = false;
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** `take` is called when the curve of a param has come, or has become stale. */
  constructor(private readonly app: App, private readonly take: (param: string) => void, private readonly isIdle: () => boolean) {}

  curveOf(param: string): {curve: CurveAnswer; isFresh: boolean} | null {
    const kept = this.kept.get(param);
    return kept ? {curve: kept.curve, isFresh: kept.stamp === this.stampOf(param)} : null;
  }

  /** The pack has changed; its value of `except` is what a curve does not depend on. */
  outdate(except: string | null): void {
    ++this.stamp;
    for (const param of this.kept.keys()) if (param !== except) this.stamps.set(param, this.stamp);
    for (const param of this.kept.keys()) if (param !== except) this.take(param);
    this.wake();
  }

  measure(ofClass: string | undefined): void {
    this.ofClass = ofClass;
    this.kept.clear();
    this.outdate(null);
  }

  want(param: string, isWanted: boolean): void {
    if (isWanted) this.wanted.add(param);
    else this.wanted.delete(param);
    if (isWanted) this.wake();
  }

  wake(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.askNext(), kPause_ms);
  }

  private stampOf(param: string): number { return this.stamps.get(param) ?? 0; }

  private async askNext(): Promise<void> {
    const {has_truth, is_good} = this.app.store.value;
    if (this.isAsking || !has_truth || !is_good) return;
    if (!this.isIdle()) return this.wake();
    const param = [...this.wanted].find(name => !this.curveOf(name)?.isFresh);
    if (param === undefined) return;
    this.isAsking = true;
    const stamp = this.stampOf(param);
    const ofClass = this.ofClass;
    try {
      const curve = await this.app.source.curve(param, ofClass);
      if (ofClass === this.ofClass) this.kept.set(param, {curve: measured(curve), stamp});
    } catch {
      this.wanted.delete(param);  // A param without curve has none: its slider works all the same.
    }
    this.isAsking = false;
    this.take(param);
    this.timer = setTimeout(() => void this.askNext(), 0);
  }
}
