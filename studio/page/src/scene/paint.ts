// Which colour and which marks each polygon has: written into a texture that the materials read.
import type {DataTexture} from 'three';
import type {Part} from '../source';
import type {Selection} from '../store';
import type {PolygonRef} from './chunk';
import {kFlag, kStateWidth, paletteTexture, stateTexture, type Uniforms} from './materials';
import {heatColour, rgb, surfaceColours, type Look} from './palette';

/** What the look of a polygon depends on. Class -1 is a feature without a label, -2 what lies in no feature. */
export interface Paint {
  labels: ReadonlyMap<number, number[]>;
  looks: Look[];
  unknown: Look;
  hidden: ReadonlySet<number>;
  /** A share from 0 to 1 of each building; null draws labels. */
  heat: ReadonlyMap<number, number> | null;
  selection: Selection | null;
  hover: Selection | null;
  found: Part[];
  changed: Part[];
}

export const kNothing: Paint = {
  labels: new Map(), looks: [], unknown: {colour: '#e7e2d8', pattern: 0}, hidden: new Set(), heat: null, selection: null, hover: null,
  found: [], changed: []
};

const kSlot = {wall: 0, roof: 1, unknown: 2, heat: 16, heats: 32, classes: 64};
const kMostClasses = 256 - kSlot.classes;

/** The feature that a polygon shows: the smallest with a label that it lies in, else the smallest. */
export function shownFeature(owners: readonly number[], labels: readonly number[] | undefined): number {
  for (const feature of owners) if ((labels?.[feature] ?? -1) >= 0) return feature;
  return owners[0] ?? -1;
}

const keyOf = (building: number, feature: number) => `${building} ${feature}`;

export class Painter {
  private ranges = new Map<number, [number, number]>();

  constructor(private readonly uniforms: Uniforms, private readonly refs: PolygonRef[]) {}

  /** Where the polygons of a building stand in `refs`; to be called after they have come. */
  noteRange(building: number, begin: number, end: number): void {
    this.ranges.set(building, [begin, end]);
    const rows = Math.max(1, Math.ceil(end / kStateWidth));
    const old = this.uniforms.state.value;
    if (old.image.height >= rows) return;
    this.uniforms.state.value = stateTexture(Math.max(rows, 2 * old.image.height));
    old.dispose();
  }
  forget(): void { this.ranges = new Map(); }

  setLooks(paint: Paint): void {
    const old = this.uniforms.palette.value;
    const texture = paletteTexture();
    const put = (slot: number, colour: string, pattern = 0) => texture.image.data!.set([...rgb(colour), pattern], 4 * slot);
    put(kSlot.wall, surfaceColours.wall);
    put(kSlot.roof, surfaceColours.roof);
    put(kSlot.unknown, paint.unknown.colour, paint.unknown.pattern);
    for (let i = 0; i < kSlot.heats; ++i) put(kSlot.heat + i, heatColour(i / (kSlot.heats - 1)));
    paint.looks.slice(0, kMostClasses).forEach((look, i) => put(kSlot.classes + i, look.colour, look.pattern));
    texture.needsUpdate = true;
    this.uniforms.palette.value = texture;
    old.dispose();
  }

  /** Writes the entries of some buildings, or of all. */
  paint(paint: Paint, buildings?: Iterable<number>): void {
    const texture: DataTexture = this.uniforms.state.value;
    const found = new Set(paint.found.map(([b, f]) => keyOf(b, f)));
    const changed = new Set(paint.changed.map(([b, f]) => keyOf(b, f)));
    for (const building of buildings ?? this.ranges.keys()) {
      const range = this.ranges.get(building);
      if (range) this.paintBuilding(paint, building, range, found, changed, texture.image.data as Uint8Array);
    }
    texture.needsUpdate = true;
  }

  private paintBuilding(paint: Paint, building: number, [begin, end]: [number, number], found: Set<string>, changed: Set<string>,
                        data: Uint8Array): void {
    const labels = paint.labels.get(building);
    const heat = paint.heat?.get(building);
    for (let i = begin; i < end; ++i) {
      const ref = this.refs[i]!;
      const feature = shownFeature(ref.owners, labels);
      const label = feature < 0 ? -2 : labels?.[feature] ?? -1;
      let slot = ref.isRoof ? kSlot.roof : kSlot.wall;
      if (heat !== undefined) slot = kSlot.heat + Math.round(Math.max(0, Math.min(1, heat)) * (kSlot.heats - 1));
      else if (label >= 0) slot = kSlot.classes + label % kMostClasses;
      else if (label === -1 && paint.unknown.pattern > 0) slot = kSlot.unknown;
      let flags = paint.hidden.has(label) ? kFlag.hidden | kFlag.ghost : 0;
      if (isMeant(ref, paint.selection)) flags |= kFlag.selected;
      if (isMeant(ref, paint.hover)) flags |= kFlag.hover;
      if (found.size > 0) flags |= ref.owners.some(f => found.has(keyOf(building, f))) ? kFlag.found : kFlag.faint;
      if (changed.size > 0 && ref.owners.some(f => changed.has(keyOf(building, f)))) flags |= kFlag.changed;
      data[4 * i] = slot;
      data[4 * i + 1] = flags;
    }
  }
}

export function isMeant(ref: PolygonRef, selection: Selection | null): boolean {
  if (!selection || selection.building !== ref.building) return false;
  if (selection.feature !== undefined) return ref.owners.includes(selection.feature);
  return selection.polygon !== undefined && selection.polygon === ref.polygon;
}
