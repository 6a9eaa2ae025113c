// Polygons with holes as triangles.
import {ShapeUtils, Vector2} from 'three';

export type Point = readonly [number, number, number];

/** Newell's normal of a ring, as long as twice its area. */
export function normalOf(points: readonly Point[]): [number, number, number] {
  let x = 0, y = 0, z = 0;
  for (let i = 0; i < points.length; ++i) {
    const p = points[i]!, q = points[(i + 1) % points.length]!;
    x += (p[1] - q[1]) * (p[2] + q[2]);
    y += (p[2] - q[2]) * (p[0] + q[0]);
    z += (p[0] - q[0]) * (p[1] + q[1]);
  }
  return [x, y, z];
}

export function unit(v: readonly number[]): [number, number, number] {
  const length = Math.hypot(v[0]!, v[1]!, v[2]!) || 1;
  return [v[0]! / length, v[1]! / length, v[2]! / length];
}

/** Two directions in the plane of a normal: the first level, the second upwards (north in a level plane). */
export function planeAxes(normal: readonly [number, number, number]): [Point, Point] {
  const [x, y, z] = normal;
  const level = Math.hypot(x, y);
  if (level < 1e-3) return [[1, 0, 0], [0, 1, 0]];
  const u: Point = [-y / level, x / level, 0];
  return [u, [u[1] * -z, u[0] * z, level]];
}

/** Indices into the points of all rings, one ring after the other, three a triangle, seen in the plane of the axes. */
export function triangulate(rings: readonly (readonly Point[])[], [u, v]: [Point, Point]): number[] {
  const outer = rings[0]!;
  if (rings.length === 1 && outer.length === 3) return [0, 1, 2];
  const flat = rings.map(ring => ring.map(p => new Vector2(p[0] * u[0] + p[1] * u[1] + p[2] * u[2], p[0] * v[0] + p[1] * v[1] + p[2] * v[2])));
  if (rings.length === 1 && outer.length === 4 && isConvex(flat[0]!)) return [0, 1, 2, 0, 2, 3];
  return ShapeUtils.triangulateShape(flat[0]!, flat.slice(1)).flat();
}

function isConvex(points: readonly Vector2[]): boolean {
  let sign = 0;
  for (let i = 0; i < 4; ++i) {
    const a = points[i]!, b = points[(i + 1) % 4]!, c = points[(i + 2) % 4]!;
    const turn = Math.sign((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x));
    if (turn === 0 || (sign !== 0 && turn !== sign)) return false;
    sign = turn;
  }
  return true;
}
