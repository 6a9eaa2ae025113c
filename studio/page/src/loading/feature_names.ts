// Ids, names and kinds of features, loaded when somebody asks for one of them.
import type {Feature, Source} from '../source';
import type {Store} from '../store';

/** Buildings asked for at once. */
const kMostTogether = 20;

export class FeatureNames {
  private readonly asked = new Set<number>();
  private queue: number[] = [];
  private isRunning = false;

  constructor(private readonly source: Source, private readonly store: Store) {}

  /** Undefined until it has come; `features` of the store changes then. */
  of(building: number, feature: number): Feature | undefined {
    const {features, buildings} = this.store.value;
    if (!this.asked.has(building) && buildings[building]?.is_loaded) {
      this.asked.add(building);
      this.queue.push(building);
      queueMicrotask(() => void this.run());
    }
    return features.get(building)?.[feature];
  }

  /** Names have labels in them: those of these buildings are asked for again when they are needed; the old ones hold so long. */
  outdate(buildings: Iterable<number>): void { for (const building of buildings) this.asked.delete(building); }

  private async run(): Promise<void> {
    if (this.isRunning) return;
    this.isRunning = true;
    while (this.queue.length > 0) {
      const batch = this.queue.splice(0, kMostTogether);
      try {
        const features = new Map(this.store.value.features);
        for (const answer of (await this.source.features(batch)).buildings) features.set(answer.number, answer.features);
        this.store.set({features});
      } catch {
        for (const building of batch) this.asked.delete(building);  // lists show numbers instead, and ask again when they are drawn anew
      }
    }
    this.isRunning = false;
  }
}
