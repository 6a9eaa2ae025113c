// Which buildings have their geometry in the page: what was asked for first, then what is large in the picture, in batches that lie
// together. When there is too much of it, what is far goes, and stands as a box again.
import type {App} from '../app';
import {pause} from '../pause';
import type {BuildingScene} from '../scene/building_scene';
import {SourceError, type BuildingEntry, type Shape} from '../source';
import {words} from '../strings';

/** The first picture comes soon: its batches are small, and grow. */
const kFirstFeatures = 300;
const kMostFeatures = 6000;
const kMostTogether = 100;
/** Until something is known: of generated houses. */
const kCornersOfFeature = 30;
/** Where there are too many, buildings that are smaller in the picture than these pixels stand as boxes. */
const kLeastPx = 3;
/** What comes in place of something else is so much larger in the picture: nothing comes and goes all the time. */
const kClearlyLarger = 1.5;
const kLook_ms = 120;
/** So many buildings that were asked for are loaded at once, the rest when they come into view. */
const kMostWanted = 200;
const kMostFailures = 3;

export class ShapeLoader {
  /** Corners of polygons that are kept; each takes some 80 bytes of the page and as many of the graphics card. */
  mostCorners = 6_000_000;
  private wanted: number[] = [];
  private readonly onWay = new Set<number>();
  private readonly failures = new Map<number, number>();
  private readonly waiting: {missing: Set<number>; done: () => void}[] = [];
  private corners = 0;
  private features = 0;
  private batchFeatures = kFirstFeatures;
  private isRunning = false;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly app: App, private readonly scene: BuildingScene) {
    scene.onRender.push(() => this.lookSoon());
    app.store.watch(['buildings'], () => this.lookSoon());
  }

  /** Loads these before all others; done when they are there, or cannot be had. */
  need(buildings: readonly number[]): Promise<void> {
    const missing = new Set(buildings.slice(0, kMostWanted).filter(number => this.canCome(number)));
    if (missing.size === 0) return Promise.resolve();
    this.wanted = [...missing, ...this.wanted.filter(number => !missing.has(number))];
    const come = new Promise<void>(done => this.waiting.push({missing, done}));
    void this.run();
    return come;
  }

  /** Loads what is in view; done when the largest of it is there. */
  first(): Promise<void> {
    const {buildings} = this.app.store.value;
    const best = this.bySize(buildings.map((_, number) => number).filter(number => this.canCome(number)))[0];
    return best === undefined ? Promise.resolve() : this.need(this.around(best.number));
  }

  private lookSoon(): void {
    if (this.isRunning || this.timer !== undefined) return;
    this.timer = setTimeout(() => {
      this.timer = undefined;
      void this.run();
    }, kLook_ms);
  }

  private async run(): Promise<void> {
    if (this.isRunning) return;
    this.isRunning = true;
    this.trim();
    for (let batch = this.nextBatch(); batch.length > 0; batch = this.nextBatch()) {
      await this.load(batch);
      this.trim();
      // The picture, the pointer and the keys have their turn.
      await pause(0);
    }
    this.isRunning = false;
  }

  private canCome(number: number): boolean {
    const {geometry, buildings} = this.app.store.value;
    return buildings[number]?.is_loaded === true && !geometry.has(number) && !this.onWay.has(number) && (this.failures.get(number) ?? 0) < kMostFailures;
  }

  private nextBatch(): number[] {
    this.wanted = this.wanted.filter(number => this.canCome(number));
    if (this.wanted.length > 0) return this.cutOff(this.wanted);
    const {buildings, geometry} = this.app.store.value;
    const candidates = this.bySize(buildings.map((_, number) => number).filter(number => this.canCome(number)));
    const best = candidates[0];
    if (!best) return [];
    const all = candidates.reduce((sum, {number}) => sum + buildings[number]!.features, 0);
    if (best.size < kLeastPx && this.corners + this.estimate(all) > this.mostCorners) return [];
    const batch = this.around(best.number);
    const more = this.estimate(batch.reduce((sum, number) => sum + buildings[number]!.features, 0));
    if (this.corners + more <= this.mostCorners || geometry.size === 0) return batch;
    return this.makeRoom(more, best.size) ? batch : [];
  }

  /** Those that are next to a building and may come, it first. */
  private around(building: number): number[] {
    const {buildings} = this.app.store.value;
    const [x, y] = middleOf(buildings[building]!);
    const away = (number: number) => {
      const [u, v] = middleOf(buildings[number]!);
      return (u - x) ** 2 + (v - y) ** 2;
    };
    const near = buildings.map((_, number) => number).filter(number => this.canCome(number)).map(number => ({number, distance: away(number)}));
    near.sort((p, q) => Number(q.number === building) - Number(p.number === building) || p.distance - q.distance);
    return this.cutOff(near.slice(0, kMostTogether).map(({number}) => number));
  }

  /** As many of them as come at once; at least one. */
  private cutOff(numbers: readonly number[]): number[] {
    const {buildings} = this.app.store.value;
    let features = 0;
    return numbers.slice(0, kMostTogether).filter((number, i) => (features += buildings[number]!.features) <= this.batchFeatures || i === 0);
  }

  private estimate(features: number): number {
    return features * (this.features > 0 ? this.corners / this.features : kCornersOfFeature);
  }

  /** The pixels that buildings take in the picture, the largest first; those out of sight come last. */
  private bySize(numbers: readonly number[]): {number: number; size: number}[] {
    const {buildings} = this.app.store.value;
    const sizes = this.scene.sizesOf(numbers.map(number => buildings[number]!));
    return numbers.map((number, i) => ({number, size: sizes[i]!})).sort((p, q) => q.size - p.size);
  }

  /** What was asked for comes always: what is smallest in the picture makes room for it. */
  private trim(): void {
    const {geometry} = this.app.store.value;
    if (this.corners <= this.mostCorners) return;
    const gone: Shape[] = [];
    let corners = this.corners;
    for (const shape of this.smallestFirst()) {
      if (corners <= this.mostCorners || gone.length === geometry.size - 1) break;
      gone.push(shape);
      corners -= shape.corners.length;
    }
    this.drop(gone);
  }

  /** Drops what is clearly smaller in the picture than what would come; false if that is not enough. */
  private makeRoom(corners: number, size: number): boolean {
    const gone: Shape[] = [];
    let room = this.mostCorners - this.corners;
    const {buildings} = this.app.store.value;
    for (const shape of this.smallestFirst()) {
      if (room >= corners) break;
      if (this.scene.sizesOf([buildings[shape.number]!])[0]! * kClearlyLarger > size) return false;
      gone.push(shape);
      room += shape.corners.length;
    }
    if (room < corners) return false;
    this.drop(gone);
    return true;
  }

  /** What is at hand, but for the chosen building. */
  private smallestFirst(): Shape[] {
    const {geometry, selection} = this.app.store.value;
    return this.bySize([...geometry.keys()].filter(number => number !== selection?.building)).reverse().map(({number}) => geometry.get(number)!);
  }

  private drop(shapes: readonly Shape[]): void {
    const geometry = new Map(this.app.store.value.geometry);
    for (const shape of shapes) {
      geometry.delete(shape.number);
      this.count(shape, -1);
    }
    this.app.store.set({geometry});
  }

  private count(shape: Shape, sign: 1 | -1): void {
    this.corners += sign * shape.corners.length;
    this.features += sign * (this.app.store.value.buildings[shape.number]?.features ?? 0);
  }

  private async load(batch: number[]): Promise<void> {
    for (const number of batch) this.onWay.add(number);
    try {
      const shapes = await this.app.source.geometry(batch);
      const geometry = new Map(this.app.store.value.geometry);
      for (const shape of shapes) {
        geometry.set(shape.number, shape);
        this.count(shape, 1);
      }
      this.batchFeatures = Math.min(kMostFeatures, 2 * this.batchFeatures);
      this.app.store.set({geometry});
      for (const number of batch) if (!geometry.has(number)) this.failed(number);
    } catch (error) {
      for (const number of batch) this.failed(number);
      this.app.store.say(error instanceof SourceError ? error.message : words.source.garbled, true);
    }
    for (const number of batch) this.onWay.delete(number);
    // Who waits is told after the picture has it.
    queueMicrotask(() => this.tell());
  }

  private failed(number: number): void { this.failures.set(number, (this.failures.get(number) ?? 0) + 1); }

  private tell(): void {
    for (const entry of [...this.waiting]) {
      for (const number of entry.missing) if (!this.canCome(number) && !this.onWay.has(number)) entry.missing.delete(number);
      if (entry.missing.size > 0) continue;
      this.waiting.splice(this.waiting.indexOf(entry), 1);
      entry.done();
    }
  }
}

const middleOf = ({at_m, size_m}: BuildingEntry): [number, number] => [at_m[0] + size_m[0] / 2, at_m[1] + size_m[1] / 2];
