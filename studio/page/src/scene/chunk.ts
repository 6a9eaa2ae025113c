// Many buildings as one mesh and one set of lines, so that thousands are drawn in few calls. Every corner carries the number of its
// polygon; what a polygon looks like stands in a texture (paint.ts), so that a new label costs no geometry.
import {BufferAttribute, BufferGeometry, LineSegments, Mesh, type ShaderMaterial} from 'three';
import {MeshBVH} from 'three-mesh-bvh';
import type {Shape} from '../source';
import {creasesOf} from './creases';
import {polygonCount, startOf} from './shape';
import {planeAxes, triangulate, type Point} from './triangulate';

/** A building in a chunk: its polygons have the numbers from `begin`. */
export interface PlacedShape { shape: Shape; begin: number; isRoof: Uint8Array }

export interface Materials { faces: ShaderMaterial; lines: ShaderMaterial; hiddenLines: ShaderMaterial; backs: ShaderMaterial; fronts: ShaderMaterial }

export interface Chunk {
  mesh: Mesh; lines: LineSegments; hiddenLines: LineSegments; triangles: number; bvh: MeshBVH | null;
  /** The faces seen from behind and from the front, which count up and down what a cut goes through (cap.ts). */
  backs: Mesh; fronts: Mesh;
  /** In the order of their polygons' numbers, which are those from `begin` to `end`. */
  shapes: PlacedShape[]; begin: number; end: number;
  /** The areas of the triangles and the lengths of the lines, which stand in this order, the largest first. */
  areas: Float32Array; lengths: Float32Array;
}

/** From far away only what is seen is drawn: triangles and lines of less than these, in pixels, are left out. */
const kLeastAreaPx = 0.8;
const kLeastLengthPx = 2.5;
/** Triangles of this area are walls and roofs: they are always drawn, or a city would fade away. */
const kAlways_m2 = 5;

/** Draws of a chunk what is seen where a pixel is `pixel_m` wide. */
export function leaveOutSmall(chunk: Chunk, pixel_m: number): void {
  const triangles = countOver(chunk.areas, Math.min(kAlways_m2, kLeastAreaPx * pixel_m * pixel_m));
  const lines = countOver(chunk.lengths, kLeastLengthPx * pixel_m);
  chunk.mesh.geometry.setDrawRange(0, 3 * triangles);
  chunk.lines.geometry.setDrawRange(0, 2 * lines);
}

/** How many of the values, of which the largest stand first, are at least this. */
function countOver(values: Float32Array, least: number): number {
  let low = 0, high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle]! >= least) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Polygons steeper than this are walls, in degrees from level. */
const kWallSlope = 70;
const kRoof = Math.cos(kWallSlope * Math.PI / 180);

/** The polygons get the numbers from `begin`. */
export function buildChunk(shapes: readonly Shape[], begin: number, materials: Materials): Chunk {
  const builder = new ChunkBuilder(shapes, begin);
  for (const shape of shapes) builder.add(shape);
  return builder.finish(materials);
}

class ChunkBuilder {
  private readonly positions: Float32Array;
  private readonly normals: Int8Array;
  private readonly numbers: Float32Array;
  private readonly index: Uint32Array;
  private readonly linePositions: Float32Array;
  private readonly lineSides: Float32Array;
  private readonly placed: PlacedShape[] = [];
  /** Corners, entries of the index, lines and polygons that are there by now. */
  private corner = 0;
  private indices = 0;
  private lines = 0;
  private number: number;

  constructor(shapes: readonly Shape[], private readonly begin: number) {
    const corners = shapes.reduce((sum, shape) => sum + shape.corners.length, 0);
    this.positions = new Float32Array(3 * corners);
    this.normals = new Int8Array(4 * corners);
    this.numbers = new Float32Array(corners);
    // A polygon of n corners and h holes has n + 2 h - 2 triangles, and no more edges than corners.
    const rings = shapes.reduce((sum, shape) => sum + shape.corner_ends.length, 0);
    this.index = new Uint32Array(3 * (corners + 2 * rings));
    this.linePositions = new Float32Array(6 * corners);
    this.lineSides = new Float32Array(4 * corners);
    this.number = begin;
  }

  add(shape: Shape): void {
    const polygons = polygonCount(shape);
    const isRoof = new Uint8Array(polygons);
    const normals = new Float32Array(3 * polygons);
    for (let polygon = 0; polygon < polygons; ++polygon) {
      const firstRing = startOf(shape.ring_ends, polygon), lastRing = shape.ring_ends[polygon]!;
      if (firstRing === lastRing) continue;
      const from = startOf(shape.corner_ends, firstRing), to = shape.corner_ends[lastRing - 1]!;
      const first = this.corner;
      this.addCorners(shape, from, to, this.number + polygon);
      const normal = this.normalOf(first, shape.corner_ends[firstRing]! - from);
      normals.set(normal, 3 * polygon);
      isRoof[polygon] = Number(shape.surfaces?.[polygon] ? shape.surfaces[polygon] === 'RoofSurface' : normal[2] > kRoof);
      for (let i = first; i < this.corner; ++i)
        for (let k = 0; k < 3; ++k) this.normals[4 * i + k] = Math.round(127 * normal[k]!);
      this.addTriangles(shape, firstRing, lastRing, first, normal);
    }
    creasesOf(shape, normals, (a, b, first, second) => {
      const line = this.lines++;
      this.putEnd(shape, a, 6 * line);
      this.putEnd(shape, b, 6 * line + 3);
      this.lineSides[4 * line] = this.lineSides[4 * line + 2] = this.number + first;
      this.lineSides[4 * line + 1] = this.lineSides[4 * line + 3] = this.number + second;
    });
    this.placed.push({shape, begin: this.number, isRoof});
    this.number += polygons;
  }

  private putEnd({base_mm, vertices_mm}: Shape, vertex: number, at: number): void {
    for (let k = 0; k < 3; ++k) this.linePositions[at + k] = (base_mm[k]! + vertices_mm[3 * vertex + k]!) / 1000;
  }

  private addTriangle(a: number, b: number, c: number): void {
    this.index[this.indices++] = a;
    this.index[this.indices++] = b;
    this.index[this.indices++] = c;
  }

  private addCorners({base_mm, vertices_mm, corners}: Shape, from: number, to: number, number: number): void {
    for (let i = from; i < to; ++i) {
      const vertex = corners[i]!;
      for (let k = 0; k < 3; ++k) this.positions[3 * this.corner + k] = (base_mm[k]! + vertices_mm[3 * vertex + k]!) / 1000;
      this.numbers[this.corner++] = number;
    }
  }

  /** Newell's normal of a ring, of length 1; nothing of a ring without area. Counted from its first corner: floats are coarse far out. */
  private normalOf(first: number, count: number): [number, number, number] {
    const p = this.positions;
    let x = 0, y = 0, z = 0;
    const [ox, oy, oz] = [p[3 * first]!, p[3 * first + 1]!, p[3 * first + 2]!];
    for (let i = 0; i < count; ++i) {
      const a = 3 * (first + i), b = 3 * (first + (i + 1) % count);
      const ax = p[a]! - ox, ay = p[a + 1]! - oy, az = p[a + 2]! - oz, bx = p[b]! - ox, by = p[b + 1]! - oy, bz = p[b + 2]! - oz;
      x += (ay - by) * (az + bz);
      y += (az - bz) * (ax + bx);
      z += (ax - bx) * (ay + by);
    }
    const length = Math.hypot(x, y, z) || 1;
    return [x / length, y / length, z / length];
  }

  private addTriangles(shape: Shape, firstRing: number, lastRing: number, first: number, normal: Point): void {
    const count = this.corner - first;
    if (count < 3) return;
    if (lastRing === firstRing + 1 && count === 3) this.addTriangle(first, first + 1, first + 2);
    else if (lastRing === firstRing + 1 && count === 4 && this.isConvex(first, normal)) {
      this.addTriangle(first, first + 1, first + 2);
      this.addTriangle(first, first + 2, first + 3);
    } else {
      for (const i of triangulate(this.ringsAt(shape, firstRing, lastRing, first), planeAxes(normal))) this.index[this.indices++] = first + i;
    }
  }

  /** True if the four corners turn the same way everywhere, seen against the normal. */
  private isConvex(first: number, [nx, ny, nz]: Point): boolean {
    const p = this.positions;
    for (let i = 0; i < 4; ++i) {
      const a = 3 * (first + i), b = 3 * (first + (i + 1) % 4), c = 3 * (first + (i + 2) % 4);
      const ux = p[b]! - p[a]!, uy = p[b + 1]! - p[a + 1]!, uz = p[b + 2]! - p[a + 2]!;
      const vx = p[c]! - p[b]!, vy = p[c + 1]! - p[b + 1]!, vz = p[c + 2]! - p[b + 2]!;
      if (nx * (uy * vz - uz * vy) + ny * (uz * vx - ux * vz) + nz * (ux * vy - uy * vx) <= 0) return false;
    }
    return true;
  }

  private ringsAt(shape: Shape, firstRing: number, lastRing: number, first: number): Point[][] {
    const rings: Point[][] = [];
    let at = first;
    for (let ring = firstRing; ring < lastRing; ++ring) {
      const points: Point[] = [];
      for (let i = startOf(shape.corner_ends, ring); i < shape.corner_ends[ring]!; ++i, ++at)
        points.push([this.positions[3 * at]!, this.positions[3 * at + 1]!, this.positions[3 * at + 2]!]);
      rings.push(points);
    }
    return rings;
  }

  private areaOf(triangle: number): number {
    const p = this.positions;
    const a = 3 * this.index[3 * triangle]!, b = 3 * this.index[3 * triangle + 1]!, c = 3 * this.index[3 * triangle + 2]!;
    const ux = p[b]! - p[a]!, uy = p[b + 1]! - p[a + 1]!, uz = p[b + 2]! - p[a + 2]!;
    const vx = p[c]! - p[a]!, vy = p[c + 1]! - p[a + 1]!, vz = p[c + 2]! - p[a + 2]!;
    return Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
  }

  private lengthOf(line: number): number {
    const p = this.linePositions, i = 6 * line;
    return Math.hypot(p[i]! - p[i + 3]!, p[i + 1]! - p[i + 4]!, p[i + 2]! - p[i + 5]!);
  }

  finish(materials: Materials): Chunk {
    const faces = new BufferGeometry();
    faces.setAttribute('position', new BufferAttribute(this.positions, 3));
    faces.setAttribute('normal', new BufferAttribute(this.normals, 4, true));
    faces.setAttribute('number', new BufferAttribute(this.numbers, 1));
    const triangles = orderBy(this.indices / 3, i => this.areaOf(i));
    faces.setIndex(new BufferAttribute(inOrder(this.index, triangles.order, 3), 1));
    const edges = orderBy(this.lines, i => this.lengthOf(i));
    const linePositions = inOrder(this.linePositions, edges.order, 6), lineSides = inOrder(this.lineSides, edges.order, 4);
    const lines = new BufferGeometry();
    lines.setAttribute('position', new BufferAttribute(linePositions, 3));
    lines.setAttribute('sides', new BufferAttribute(lineSides, 2));
    faces.computeBoundingSphere();
    faces.computeBoundingBox();
    lines.computeBoundingSphere();
    const hiddenLines = new LineSegments(lines, materials.hiddenLines);
    hiddenLines.renderOrder = 2;
    const backs = new Mesh(faces, materials.backs), fronts = new Mesh(faces, materials.fronts);
    backs.renderOrder = fronts.renderOrder = -2;
    return {
      mesh: new Mesh(faces, materials.faces), lines: new LineSegments(lines, materials.lines), hiddenLines, backs, fronts, shapes: this.placed,
      begin: this.begin, end: this.number, triangles: this.indices / 3, bvh: null, areas: triangles.values, lengths: edges.values
    };
  }
}

/** The places of values ordered by their sizes, the largest first, as exactly as leaving out needs it (a quarter of an octave), and
    these sizes in that order: the exponent and two more bits of a float say it. */
function orderBy(count: number, valueOf: (i: number) => number): {order: Uint32Array; values: Float32Array} {
  const kShift = 21, kSteps = 1 << (32 - kShift);
  const sizes = new Float32Array(count);
  for (let i = 0; i < count; ++i) sizes[i] = valueOf(i);
  const bits = new Uint32Array(sizes.buffer);
  const begins = new Uint32Array(kSteps + 1);
  for (let i = 0; i < count; ++i) ++begins[kSteps - (bits[i]! >>> kShift)]!;
  for (let step = 1; step <= kSteps; ++step) begins[step]! += begins[step - 1]!;
  const order = new Uint32Array(count);
  const values = new Float32Array(count);
  for (let i = 0; i < count; ++i) {
    const place = begins[kSteps - 1 - (bits[i]! >>> kShift)]!++;
    order[place] = i;
    values[place] = sizes[i]!;
  }
  // As they stand, sizes of a step are in no order: it counts with its smallest.
  const rounded = new Uint32Array(values.buffer);
  for (let i = 0; i < count; ++i) rounded[i] = rounded[i]! >>> kShift << kShift;
  return {order, values};
}

function inOrder<List extends Float32Array | Uint32Array>(list: List, order: Uint32Array, width: number): List {
  const ordered = list.slice(0, width * order.length) as List;
  for (let to = 0; to < order.length; ++to) {
    const from = width * order[to]!;
    for (let k = 0; k < width; ++k) ordered[width * to + k] = list[from + k]!;
  }
  return ordered;
}

/** The tree that finds what a ray hits, made when it is first asked for. */
export function bvhOf(chunk: Chunk): MeshBVH {
  if (!chunk.bvh) {
    chunk.mesh.geometry.setDrawRange(0, Infinity);  // also of what is left out from afar
    chunk.bvh = new MeshBVH(chunk.mesh.geometry, {indirect: true});
  }
  return chunk.bvh;
}

/** The building of a chunk to which the polygon of that number belongs. */
export function placedAt(chunk: Chunk, number: number): PlacedShape {
  let low = 0, high = chunk.shapes.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (chunk.shapes[middle]!.begin <= number) low = middle;
    else high = middle - 1;
  }
  return chunk.shapes[low]!;
}
