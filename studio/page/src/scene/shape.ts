// A building's polygons in flat lists, as the picture needs them: thousands of buildings then are a few arrays each.
import type {Shape} from '../source';
import type {Point} from './triangulate';

export const polygonCount = (shape: Shape): number => shape.ring_ends.length;
export const vertexCount = (shape: Shape): number => shape.vertices_mm.length / 3;

/** In metres. */
export function pointOf({base_mm, vertices_mm}: Shape, vertex: number): Point {
  return [(base_mm[0] + vertices_mm[3 * vertex]!) / 1000, (base_mm[1] + vertices_mm[3 * vertex + 1]!) / 1000, (base_mm[2] + vertices_mm[3 * vertex + 2]!) / 1000];
}

/** The vertices of a polygon's rings, the outer one first. */
export function ringsOf(shape: Shape, polygon: number): number[][] {
  const rings: number[][] = [];
  for (let ring = startOf(shape.ring_ends, polygon); ring < shape.ring_ends[polygon]!; ++ring)
    rings.push(slice(shape.corners, startOf(shape.corner_ends, ring), shape.corner_ends[ring]!));
  return rings;
}

/** The features that a polygon lies in, the smallest first. */
export function ownersOf(shape: Shape, polygon: number): number[] {
  if (polygon < 0 || polygon >= shape.owner_ends.length) return [];
  return slice(shape.owners, startOf(shape.owner_ends, polygon), shape.owner_ends[polygon]!);
}

export function hasOwner(shape: Shape, polygon: number, feature: number): boolean {
  for (let i = startOf(shape.owner_ends, polygon); i < shape.owner_ends[polygon]!; ++i) if (shape.owners[i] === feature) return true;
  return false;
}

/** Where the entries of a list's member begin: where those of the one before end. */
export const startOf = (ends: ArrayLike<number>, at: number): number => (at === 0 ? 0 : ends[at - 1]!);

const slice = (list: ArrayLike<number>, from: number, to: number) => Array.from({length: to - from}, (_, i) => list[from + i]!);

/** Polygons that each are an object, as a shape; `vertices_mm` are from the origin. */
export function shapeOf(number: number, vertices_mm: number[], polygons: {rings: number[][]; owners: number[]; surface?: string}[], storeys_mm: number[]): Shape {
  const shape = {ring_ends: [] as number[], corner_ends: [] as number[], corners: [] as number[], owner_ends: [] as number[], owners: [] as number[]};
  for (const {rings, owners} of polygons) {
    for (const ring of rings) {
      for (const vertex of ring) shape.corners.push(vertex);
      shape.corner_ends.push(shape.corners.length);
    }
    shape.ring_ends.push(shape.corner_ends.length);
    for (const owner of owners) shape.owners.push(owner);
    shape.owner_ends.push(shape.owners.length);
  }
  return {number, base_mm: [0, 0, 0], vertices_mm, storeys_mm, surfaces: polygons.map(({surface}) => surface ?? ''), ...shape};
}

interface Entry {
  number: number; base_mm: [number, number, number]; is_short: boolean; are_few: boolean; vertices: number; polygons: number; rings: number; corners: number;
  owners: number; storeys_mm: number[];
}

/** Shapes out of the bytes of the studio (studio/session/verbs/geometry_verbs.cpp): views of them, so nothing is looked at one by one. */
export function shapesOfBytes(bytes: ArrayBuffer): Shape[] {
  const headSize = new DataView(bytes).getUint32(0, true);
  const {buildings} = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, headSize))) as {buildings: Entry[]};
  let at = 4 + headSize;
  const list = (count: number, isShort: boolean): Uint16Array | Uint32Array => {
    const numbers = isShort ? new Uint16Array(bytes, at, count) : new Uint32Array(bytes, at, count);
    at += 4 * Math.ceil(numbers.byteLength / 4);
    return numbers;
  };
  return buildings.map(({number, base_mm, is_short, are_few, vertices, polygons, rings, corners, owners, storeys_mm}) => ({
    number, base_mm, storeys_mm, vertices_mm: list(3 * vertices, is_short), ring_ends: list(polygons, are_few), corner_ends: list(rings, are_few),
    corners: list(corners, are_few), owner_ends: list(polygons, are_few), owners: list(owners, are_few)
  }));
}
