// The edges of a building that are drawn: those between polygons that lie in different planes or in different features.
import type {Shape} from '../source';
import {startOf} from './shape';

/** An edge between two vertices and the polygons at its sides; the same one twice where there is one only. */
export type TakeCrease = (a: number, b: number, first: number, second: number) => void;

/** Edges between polygons tilted by less are not drawn, unless they lie in different features. */
const kFlat = Math.cos(5 * Math.PI / 180);

/** Edges by their two vertices, in a table that grows and is used again for every building. */
class EdgeTable {
  a = new Int32Array(0);
  b = new Int32Array(0);
  first = new Int32Array(0);
  second = new Int32Array(0);
  sides = new Uint8Array(0);
  count = 0;
  private places = new Int32Array(0);
  private mask = 0;

  begin(corners: number): void {
    this.count = 0;
    let size = 16;
    while (size < 2 * corners) size *= 2;
    if (size > this.places.length) {
      this.places = new Int32Array(size);
      for (const name of ['a', 'b', 'first', 'second'] as const) this[name] = new Int32Array(size / 2);
      this.sides = new Uint8Array(size / 2);
    }
    this.mask = size - 1;
    this.places.fill(0, 0, size);
  }

  add(p: number, q: number, polygon: number): void {
    const a = Math.min(p, q), b = Math.max(p, q);
    let at = (Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca6b)) & this.mask;
    for (; this.places[at] !== 0; at = (at + 1) & this.mask) {
      const edge = this.places[at]! - 1;
      if (this.a[edge] !== a || this.b[edge] !== b) continue;
      if (this.second[edge] === this.first[edge]) this.second[edge] = polygon;
      this.sides[edge] = Math.min(3, this.sides[edge]! + 1);
      return;
    }
    const edge = this.count++;
    this.places[at] = edge + 1;
    this.a[edge] = a;
    this.b[edge] = b;
    this.first[edge] = this.second[edge] = polygon;
    this.sides[edge] = 1;
  }
}

const table = new EdgeTable();

/** `normals`: three numbers a polygon. */
export function creasesOf(shape: Shape, normals: Float32Array, take: TakeCrease): void {
  const {ring_ends, corner_ends, corners} = shape;
  table.begin(corners.length);
  for (let polygon = 0, ring = 0; polygon < ring_ends.length; ++polygon)
    for (; ring < ring_ends[polygon]!; ++ring) {
      const from = startOf(corner_ends, ring), to = corner_ends[ring]!;
      for (let i = from, before = corners[to - 1]!; i < to; before = corners[i++]!)
        if (before !== corners[i]!) table.add(before, corners[i]!, polygon);
    }
  for (let edge = 0; edge < table.count; ++edge) {
    const first = table.first[edge]!, second = table.second[edge]!;
    if (table.sides[edge] === 2 && second !== first && isFlat(normals, first, second) && smallestOwner(shape, first) === smallestOwner(shape, second)) continue;
    take(table.a[edge]!, table.b[edge]!, first, second);
  }
}

function isFlat(normals: Float32Array, p: number, q: number): boolean {
  return normals[3 * p]! * normals[3 * q]! + normals[3 * p + 1]! * normals[3 * q + 1]! + normals[3 * p + 2]! * normals[3 * q + 2]! > kFlat;
}

function smallestOwner(shape: Shape, polygon: number): number {
  const from = startOf(shape.owner_ends, polygon);
  return from < shape.owner_ends[polygon]! ? shape.owners[from]! : -1;
}
