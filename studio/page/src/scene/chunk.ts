// Many buildings as one mesh and one set of lines, so that thousands are drawn in few calls. Every corner carries the number of its
// polygon; what a polygon looks like stands in a texture (paint.ts), so that a new label costs no geometry.
import {BufferAttribute, BufferGeometry, LineSegments, Mesh, type ShaderMaterial} from 'three';
import {MeshBVH} from 'three-mesh-bvh';
import type {SceneBuilding} from './building_scene';
import {normalOf, planeAxes, triangulate, unit, type Point} from './triangulate';

/** What a polygon of the scene is. */
export interface PolygonRef {
  building: number; polygon: number; owners: number[]; isRoof: boolean;
}

export interface Materials { faces: ShaderMaterial; lines: ShaderMaterial; hiddenLines: ShaderMaterial }

export interface Chunk {
  mesh: Mesh; lines: LineSegments; hiddenLines: LineSegments; buildings: number[]; triangles: number; bvh: MeshBVH | null;
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
/** Edges between polygons tilted by less are not drawn, unless they lie in different features. */
const kFlat = Math.cos(5 * Math.PI / 180);

interface Edge { a: number; b: number; first: number; second: number; isCrease: boolean }

export class ChunkBuilder {
  private readonly positions: number[] = [];
  private readonly normals: number[] = [];
  private readonly uvs: number[] = [];
  private readonly numbers: number[] = [];
  private readonly index: number[] = [];
  private readonly linePositions: number[] = [];
  private readonly lineSides: number[] = [];
  private readonly buildings: number[] = [];

  /** `refs` gets the polygons, whose numbers are their places there. */
  constructor(private readonly refs: PolygonRef[]) {}

  add(building: SceneBuilding): void {
    this.buildings.push(building.number);
    const mm = building.vertices_mm;
    const at = (v: number): Point => [mm[3 * v]! / 1000, mm[3 * v + 1]! / 1000, mm[3 * v + 2]! / 1000];
    const edges = new Map<number, Edge>();
    const vertexCount = mm.length / 3;
    const planes: [number, number, number][] = [];
    const base = this.refs.length;
    building.polygons.forEach((polygon, number) => {
      const rings = polygon.rings.map(ring => ring.map(at));
      const normal = unit(normalOf(rings[0] ?? []));
      planes.push(normal);
      this.refs.push({building: building.number, polygon: number, owners: polygon.owners, isRoof: isRoof(polygon.surface, normal)});
      if (rings[0] && rings[0].length >= 3) this.addFaces(rings, normal, base + number);
      for (const ring of polygon.rings)
        for (let i = 0; i < ring.length; ++i)
          noteEdge(edges, vertexCount, ring[i]!, ring[(i + 1) % ring.length]!, base + number, planes, base, this.refs);
    });
    for (const edge of edges.values()) {
      if (!edge.isCrease) continue;
      this.linePositions.push(...at(edge.a), ...at(edge.b));
      this.lineSides.push(edge.first, edge.second, edge.first, edge.second);
    }
  }

  private addFaces(rings: Point[][], normal: [number, number, number], number: number): void {
    const axes = planeAxes(normal);
    const [u, v] = axes;
    const begin = this.positions.length / 3;
    for (const ring of rings)
      for (const p of ring) {
        this.positions.push(p[0], p[1], p[2]);
        this.normals.push(Math.round(127 * normal[0]), Math.round(127 * normal[1]), Math.round(127 * normal[2]));
        this.uvs.push(p[0] * u[0] + p[1] * u[1] + p[2] * u[2], p[0] * v[0] + p[1] * v[1] + p[2] * v[2]);
        this.numbers.push(number);
      }
    for (const i of triangulate(rings, axes)) this.index.push(begin + i);
  }

  private areaOf(triangle: number): number {
    const p = this.positions;
    const [a, b, c] = [0, 1, 2].map(k => 3 * this.index[3 * triangle + k]!) as [number, number, number];
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
    faces.setAttribute('position', new BufferAttribute(new Float32Array(this.positions), 3));
    faces.setAttribute('normal', new BufferAttribute(new Int8Array(this.normals), 3, true));
    faces.setAttribute('uv', new BufferAttribute(new Float32Array(this.uvs), 2));
    faces.setAttribute('number', new BufferAttribute(new Float32Array(this.numbers), 1));
    const triangles = orderBy(this.index.length / 3, i => this.areaOf(i));
    faces.setIndex(new BufferAttribute(Uint32Array.from({length: this.index.length}, (_, i) => this.index[3 * triangles.order[Math.floor(i / 3)]! + i % 3]!), 1));
    const edges = orderBy(this.linePositions.length / 6, i => this.lengthOf(i));
    const linePositions = new Float32Array(this.linePositions.length), lineSides = new Float32Array(this.lineSides.length);
    edges.order.forEach((from, to) => {
      for (let k = 0; k < 6; ++k) linePositions[6 * to + k] = this.linePositions[6 * from + k]!;
      for (let k = 0; k < 4; ++k) lineSides[4 * to + k] = this.lineSides[4 * from + k]!;
    });
    const lines = new BufferGeometry();
    lines.setAttribute('position', new BufferAttribute(linePositions, 3));
    lines.setAttribute('sides', new BufferAttribute(lineSides, 2));
    faces.computeBoundingSphere();
    lines.computeBoundingSphere();
    const hiddenLines = new LineSegments(lines, materials.hiddenLines);
    hiddenLines.renderOrder = 2;
    return {
      mesh: new Mesh(faces, materials.faces), lines: new LineSegments(lines, materials.lines), hiddenLines,
      buildings: this.buildings, triangles: this.index.length / 3, bvh: null, areas: triangles.values, lengths: edges.values
    };
  }
}

/** The places of values ordered by their sizes, the largest first, as exactly as leaving out needs it (a quarter of an octave), and
    these sizes in that order. */
function orderBy(count: number, valueOf: (i: number) => number): {order: Uint32Array; values: Float32Array} {
  const kSteps = 4, kFloor = 2 ** -14;
  const classOf = (value: number) => Math.max(0, Math.round(kSteps * Math.log2(Math.max(value, kFloor) / kFloor)));
  const classes = Uint16Array.from({length: count}, (_, i) => classOf(valueOf(i)));
  const most = classes.reduce((max, c) => Math.max(max, c), 0);
  const begins = new Uint32Array(most + 2);
  for (const c of classes) ++begins[most - c + 1]!;
  for (let c = 1; c < begins.length; ++c) begins[c]! += begins[c - 1]!;
  const order = new Uint32Array(count);
  const values = new Float32Array(count);
  classes.forEach((c, i) => {
    const place = begins[most - c]!++;
    order[place] = i;
    values[place] = kFloor * 2 ** (c / kSteps);
  });
  return {order, values};
}

/** The tree that finds what a ray hits, made when it is first asked for. */
export function bvhOf(chunk: Chunk): MeshBVH {
  if (!chunk.bvh) {
    chunk.mesh.geometry.setDrawRange(0, Infinity);  // also of what is left out from afar
    chunk.bvh = new MeshBVH(chunk.mesh.geometry, {indirect: true});
  }
  return chunk.bvh;
}

function isRoof(surface: string | undefined, normal: Point): boolean {
  if (surface) return surface === 'RoofSurface';
  return normal[2] > kRoof;
}

function noteEdge(edges: Map<number, Edge>, vertexCount: number, from: number, to: number, number: number,
                  planes: [number, number, number][], base: number, refs: PolygonRef[]): void {
  if (from === to) return;
  const a = Math.min(from, to), b = Math.max(from, to);
  const key = a * vertexCount + b;
  const edge = edges.get(key);
  if (!edge) {
    edges.set(key, {a, b, first: number, second: number, isCrease: true});
    return;
  }
  if (edge.second !== edge.first) { edge.isCrease = true; return; }
  edge.second = number;
  const p = planes[edge.first - base]!, q = planes[number - base]!;
  const isFlat = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] > kFlat;
  edge.isCrease = !isFlat || refs[edge.first]!.owners[0] !== refs[number]!.owners[0];
}
