// The edges of a building that are drawn: those between polygons that lie in different planes or in different features.
import type {Shape} from '../source';
import {polygonCount, startOf, vertexCount} from './shape';

/** An edge between two vertices and the polygons at its sides; the same one twice where there is one only. */
export interface Crease { a: number; b: number; first: number; second: number }

/** Edges between polygons tilted by less are not drawn, unless they lie in different features. */
const kFlat = Math.cos(5 * Math.PI / 180);

/** `normals`: three numbers a polygon. Edges are brought together by sorting: a number each, of its ends and its polygon. */
export function* creasesOf(shape: Shape, normals: Float32Array): Generator<Crease> {
  const vertices = vertexCount(shape), polygons = polygonCount(shape);
  const edges = new Float64Array(shape.corners.length);
  let count = 0;
  for (let polygon = 0, ring = 0; polygon < polygons; ++polygon)
    for (; ring < shape.ring_ends[polygon]!; ++ring) {
      const from = startOf(shape.corner_ends, ring), to = shape.corner_ends[ring]!;
      for (let i = from; i < to; ++i) {
        const p = shape.corners[i]!, q = shape.corners[i + 1 < to ? i + 1 : from]!;
        if (p !== q) edges[count++] = (Math.min(p, q) * vertices + Math.max(p, q)) * polygons + polygon;
      }
    }
  const sorted = edges.subarray(0, count).sort();
  for (let i = 0; i < count;) {
    const key = Math.floor(sorted[i]! / polygons);
    const first = sorted[i]! - key * polygons;
    let second = first, sides = 0;
    for (; i < count && Math.floor(sorted[i]! / polygons) === key; ++i, ++sides) if (second === first) second = sorted[i]! - key * polygons;
    if (sides === 2 && second !== first && isFlat(normals, first, second) && smallestOwner(shape, first) === smallestOwner(shape, second)) continue;
    yield {a: Math.floor(key / vertices), b: key % vertices, first, second};
  }
}

function isFlat(normals: Float32Array, p: number, q: number): boolean {
  return normals[3 * p]! * normals[3 * q]! + normals[3 * p + 1]! * normals[3 * q + 1]! + normals[3 * p + 2]! * normals[3 * q + 2]! > kFlat;
}

function smallestOwner(shape: Shape, polygon: number): number {
  const from = startOf(shape.owner_ends, polygon);
  return from < shape.owner_ends[polygon]! ? shape.owners[from]! : -1;
}
