// Buildings whose geometry has not come stand as boxes: one call for all of them, however many.
import {Box3, BoxGeometry, BufferAttribute, Color, DynamicDrawUsage, InstancedMesh, Matrix4, Group, Vector3, type Ray} from 'three';
import type {Vec3} from '../source';
import {makeBoxMaterial} from './materials';
import type {Paint} from './paint';
import {heatColour, surfaceColours} from './palette';

/** As much of the ground is in what is faded: as in materials.ts. */
const kFaded = 0.62;

/** A building's box in metres from the origin of the scene. */
export interface PlacedBox { building: number; from: Vec3; to: Vec3; isFar: boolean }

const kPlain = new Color(surfaceColours.wall);

export class BuildingBoxes {
  readonly object = new Group();
  readonly bounds = new Box3();
  readonly material = makeBoxMaterial();
  private placed: PlacedBox[] = [];
  private mesh: InstancedMesh | null = null;
  private away: {has(building: number): boolean} = new Set();
  private only: number | null = null;
  private painted: unknown[] = [];

  set(boxes: PlacedBox[], away: {has(building: number): boolean}): void {
    this.placed = boxes;
    this.bounds.makeEmpty();
    for (const box of boxes) if (!box.isFar) this.bounds.expandByPoint(new Vector3(...box.from)).expandByPoint(new Vector3(...box.to));
    this.mesh?.dispose();
    this.object.clear();
    this.mesh = null;
    if (boxes.length === 0) return;
    this.mesh = new InstancedMesh(shadedBox(), this.material, boxes.length);
    this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    this.mesh.frustumCulled = false;
    this.object.add(this.mesh);
    for (let i = 0; i < boxes.length; ++i) this.mesh.setColorAt(i, kPlain);
    this.leaveOut(away);
  }

  /** The corners of the boxes of these buildings, or of all that are not far away. */
  corners(buildings?: {has(building: number): boolean}): Vector3[] {
    return this.placed.filter(({building, isFar}) => buildings?.has(building) ?? !isFar).flatMap(({from, to}) => [0, 1, 2, 3, 4, 5, 6, 7].map(i =>
      new Vector3(i & 1 ? to[0] : from[0], i & 2 ? to[1] : from[1], i & 4 ? to[2] : from[2])));
  }

  /** Whether there is a box of a building that is not among these, or far away. */
  hasOthers(buildings: {has(building: number): boolean}): boolean { return this.placed.some(({building, isFar}) => isFar || !buildings.has(building)); }

  /** Those that are drawn as they are leave their boxes. */
  leaveOut(away: {has(building: number): boolean}): void {
    this.away = away;
    if (!this.mesh) return;
    const matrix = new Matrix4();
    this.placed.forEach(({building, from, to}, i) => {
      const size = this.isAway(building) ? [0, 0, 0] : to.map((x, k) => Math.max(0.1, x - from[k]!));
      matrix.makeScale(size[0]!, size[1]!, size[2]!);
      matrix.setPosition((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, (from[2] + to[2]) / 2);
      this.mesh!.setMatrixAt(i, matrix);
    });
    this.mesh.instanceMatrix.needsUpdate = true;
    this.mesh.visible = this.placed.some(({building}) => !this.isAway(building));
  }

  private isAway(building: number): boolean { return this.away.has(building) || (this.only !== null && this.only !== building); }

  /** False if all are as they were. */
  paint(paint: Paint, ground: Vector3): boolean {
    const chosen = paint.found.length === 0 ? paint.selection?.building : undefined;
    const by = [this.mesh, paint.heat, chosen, paint.only, ground.x];
    if (!this.mesh || by.every((value, i) => value === this.painted[i])) return false;
    this.painted = by;
    if (paint.only !== this.only) {
      this.only = paint.only;
      this.leaveOut(this.away);
    }
    const around = new Color(ground.x, ground.y, ground.z);
    this.placed.forEach(({building}, i) => {
      const heat = paint.heat?.get(building);
      const colour = heat === undefined ? kPlain.clone() : new Color(heatColour(heat));
      this.mesh!.setColorAt(i, chosen === undefined || chosen === building ? colour : colour.lerp(around, kFaded));
    });
    this.mesh.instanceColor!.needsUpdate = true;
    return this.mesh.visible;
  }

  hit(ray: Ray): {building: number; distance: number; point: Vector3} | null {
    let best: {building: number; distance: number; point: Vector3} | null = null;
    const box = new Box3();
    for (const {building, from, to} of this.placed) {
      if (this.isAway(building)) continue;
      box.min.set(...from);
      box.max.set(...to);
      const point = ray.intersectBox(box, new Vector3());
      if (!point) continue;
      const distance = point.distanceTo(ray.origin);
      if (!best || distance < best.distance) best = {building, distance, point};
    }
    return best;
  }
}

/** A unit box whose sides have the shades that materials.ts gives them, so that it needs no light. */
function shadedBox(): BoxGeometry {
  const box = new BoxGeometry(1, 1, 1);
  const shades = [0.86, 0.8, 0.76, 0.9, 1, 0.7];
  const corners = Array.from({length: 24}, (_, corner) => shades[Math.floor(corner / 4)]!);
  box.setAttribute('shade', new BufferAttribute(new Float32Array(corners), 1));
  return box;
}
