// Numbers for polygons: chunks take a range and give it back.
interface Range { from: number; to: number }

export class NumberSpace {
  /** What is free below `end`, in order, no two side by side. */
  private free: Range[] = [];
  private end = 0;

  take(count: number): number {
    const at = this.free.findIndex(({from, to}) => to - from >= count);
    if (at < 0) {
      this.end += count;
      return this.end - count;
    }
    const range = this.free[at]!;
    const from = range.from;
    range.from += count;
    if (range.from === range.to) this.free.splice(at, 1);
    return from;
  }

  give(from: number, to: number): void {
    if (from === to) return;
    const ranges = [...this.free, {from, to}].sort((p, q) => p.from - q.from);
    this.free = [];
    for (const range of ranges) {
      const last = this.free.at(-1);
      if (last && last.to === range.from) last.to = range.to;
      else this.free.push(range);
    }
    if (this.free.at(-1)?.to === this.end) this.end = this.free.pop()!.from;
  }
}
