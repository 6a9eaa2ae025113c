// Which colour and which marks each polygon has: written into a texture that the materials read.
import type {DataTexture} from 'three';
import type {Part, Shape} from '../source';
import type {Selection} from '../store';
import type {PlacedShape} from './chunk';
import {kFlag, kStateWidth, paletteTexture, stateTexture, type Uniforms} from './materials';
import {heatColour, rgb, surfaceColours, type Look} from './palette';
import {hasOwner, startOf} from './shape';

/** What the look of a polygon depends on. Class -1 is a feature without a label, -2 what lies in no feature. */
export interface Paint {
  labels: ReadonlyMap<number, number[]>;
  looks: Look[];
  unknown: Look;
  hidden: ReadonlySet<number>;
  /** A share from 0 to 1 of each building; null draws labels. */
  heat: ReadonlyMap<number, number> | null;
  selection: Selection | null;
  /** The building that alone is drawn; null: all are. */
  only: number | null;
  hover: Selection | null;
  found: Part[];
  changed: Part[];
  /** Buildings that are no closed bodies: a cut through them has no inside. */
  open: ReadonlySet<number>;
}

export const kNothing: Paint = {
  labels: new Map(), looks: [], unknown: {colour: '#e7e2d8', pattern: 0}, hidden: new Set(), heat: null, selection: null, only: null, hover: null,
  found: [], changed: [], open: new Set()
};

const kSlot = {wall: 0, roof: 1, unknown: 2, heat: 16, heats: 32, classes: 64};
const kMostClasses = 256 - kSlot.classes;

/** The feature that a polygon shows: the smallest with a label that it lies in, else the smallest; -1 for none. */
export function shownFeature({owner_ends, owners}: Shape, polygon: number, labels: readonly number[] | undefined): number {
  const from = startOf(owner_ends, polygon), to = owner_ends[polygon]!;
  for (let i = from; i < to; ++i) if ((labels?.[owners[i]!] ?? -1) >= 0) return owners[i]!;
  return from < to ? owners[from]! : -1;
}

type PartSet = Map<number, Set<number>>;

function byBuilding(parts: readonly Part[]): PartSet {
  const sets: PartSet = new Map();
  for (const [building, feature] of parts) {
    const set = sets.get(building);
    if (set) set.add(feature);
    else sets.set(building, new Set([feature]));
  }
  return sets;
}

function liesInOneOf({owner_ends, owners}: Shape, polygon: number, features: Set<number> | undefined): boolean {
  if (!features) return false;
  for (let i = startOf(owner_ends, polygon); i < owner_ends[polygon]!; ++i) if (features.has(owners[i]!)) return true;
  return false;
}

export class Painter {
  private readonly placed = new Map<number, PlacedShape>();

  constructor(private readonly uniforms: Uniforms) {}

  /** A building is painted from now on; `paint` is to be called for it. */
  add(placed: PlacedShape): void {
    this.placed.set(placed.shape.number, placed);
    const rows = Math.max(1, Math.ceil((placed.begin + placed.isRoof.length) / kStateWidth));
    const old = this.uniforms.state.value;
    if (old.image.height >= rows) return;
    const texture = stateTexture(Math.max(rows, 2 * old.image.height));
    (texture.image.data as Uint8Array).set(old.image.data as Uint8Array);
    this.uniforms.state.value = texture;
    old.dispose();
  }
  drop(building: number): void { this.placed.delete(building); }
  of(building: number): PlacedShape | undefined { return this.placed.get(building); }

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

  /** Writes the entries of some buildings, or of all. False if all are as they were. */
  paint(paint: Paint, buildings?: Iterable<number>): boolean {
    const texture: DataTexture = this.uniforms.state.value;
    let isOther = false;
    const found = byBuilding(paint.found), changed = byBuilding(paint.changed);
    for (const building of buildings ?? this.placed.keys()) {
      const placed = this.placed.get(building);
      if (placed) isOther = paintBuilding(paint, placed, found, changed, texture.image.data as Uint8Array) || isOther;
    }
    if (isOther) texture.needsUpdate = true;
    return isOther;
  }
}

function paintBuilding(paint: Paint, {shape, begin, isRoof}: PlacedShape, found: PartSet, changed: PartSet, data: Uint8Array): boolean {
  let isOther = false;
  const labels = paint.labels.get(shape.number);
  const heat = paint.heat?.get(shape.number);
  const heatSlot = heat === undefined ? 0 : kSlot.heat + Math.round(Math.max(0, Math.min(1, heat)) * (kSlot.heats - 1));
  const foundHere = found.get(shape.number), changedHere = changed.get(shape.number);
  const chosen = paint.selection?.building === shape.number ? paint.selection : null;
  const hovered = paint.hover?.building === shape.number ? paint.hover : null;
  const isFaded = paint.selection !== null && !chosen && found.size === 0;
  const isAway = paint.only !== null && paint.only !== shape.number;
  const common = (paint.open.has(shape.number) ? kFlag.open : 0) | (isFaded ? kFlag.faint | kFlag.through : 0) | (isAway ? kFlag.hidden : 0);
  for (let polygon = 0; polygon < isRoof.length; ++polygon) {
    const feature = shownFeature(shape, polygon, labels);
    const label = feature < 0 ? -2 : labels?.[feature] ?? -1;
    let slot = isRoof[polygon] ? kSlot.roof : kSlot.wall;
    if (heatSlot > 0) slot = heatSlot;
    else if (label >= 0) slot = kSlot.classes + label % kMostClasses;
    else if (label === -1 && paint.unknown.pattern > 0) slot = kSlot.unknown;
    let flags = common | (paint.hidden.has(label) ? kFlag.hidden : 0);
    if (chosen && isMeant(shape, polygon, chosen)) flags |= kFlag.selected;
    if (hovered && isMeant(shape, polygon, hovered)) flags |= kFlag.hover;
    if (found.size > 0) flags |= liesInOneOf(shape, polygon, foundHere) ? kFlag.found : kFlag.faint;
    if (changedHere && liesInOneOf(shape, polygon, changedHere)) flags |= kFlag.changed;
    const at = 4 * (begin + polygon);
    if (data[at] === slot && data[at + 1] === flags) continue;
    data[at] = slot;
    data[at + 1] = flags;
    isOther = true;
  }
  return isOther;
}

/** Of a polygon of the chosen building; a building as a whole marks none of its polygons. */
export function isMeant(shape: Shape, polygon: number, {feature, polygon: chosen}: Selection): boolean {
  return feature !== undefined ? hasOwner(shape, polygon, feature) : chosen === polygon;
}
