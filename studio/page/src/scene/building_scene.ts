// The picture of buildings: one canvas. It may be made twice (before and after), see divider.ts. It draws when something has changed,
// and not before.
import {
  Box3, BufferAttribute, BufferGeometry, ColorManagement, Group, LinearSRGBColorSpace, LineSegments, Raycaster, Scene, Vector2,
  Vector3, WebGLRenderer
} from 'three';
import type {Part} from '../source';
import type {Selection} from '../store';
import {BuildingBoxes, type PlacedBox} from './building_boxes';
import {Camera} from './camera';
import {bvhOf, ChunkBuilder, leaveOutSmall, type Chunk, type PolygonRef} from './chunk';
import {makeExtraLineMaterial, makeMaterials, makeUniforms} from './materials';
import {isMeant, kNothing, Painter, shownFeature, type Paint} from './paint';
import {rgb} from './palette';
import {normalOf, unit} from './triangulate';

/** A building as the scene draws it. The polygons of a generalised one have `feature` as their only owner. */
export interface SceneBuilding {
  number: number;
  vertices_mm: number[];
  /** `surface` says what a polygon without a labelled feature is: WallSurface, RoofSurface … */
  polygons: {rings: number[][]; owners: number[]; surface?: string}[];
  storeys_mm: number[];
}

/** What lies under a point of the picture. */
export interface Hit { selection: Selection; point: Vector3 }

ColorManagement.enabled = false;

/** Three calls a chunk, so at most 150 for all, however many buildings there are. */
const kMostChunks = 45;
const kChunkBuildings = 40;

export class BuildingScene {
  readonly element: HTMLElement;
  readonly camera: Camera;
  readonly boxes = new BuildingBoxes();
  /** False where the browser has no WebGL 2: everything else of the page works. */
  readonly isDrawing: boolean;
  readonly onPick: ((hit: Hit | null, event: PointerEvent) => void)[] = [];
  readonly onHover: ((hit: Hit | null, event: PointerEvent) => void)[] = [];
  readonly onContext: ((hit: Hit | null, event: MouseEvent) => void)[] = [];
  readonly onRender: (() => void)[] = [];
  private readonly renderer: WebGLRenderer | null = null;
  private readonly scene = new Scene();
  private readonly chunkGroup = new Group();
  private readonly uniforms = makeUniforms();
  private readonly materials = makeMaterials(this.uniforms);
  private refs: PolygonRef[] = [];
  private painter = new Painter(this.uniforms, this.refs);
  private chunks: Chunk[] = [];
  private buildings = new Map<number, SceneBuilding>();
  private paint: Paint = kNothing;
  private box = new Box3();
  private isWaiting = false;
  private extra: LineSegments | null = null;

  constructor(readonly host: HTMLElement) {
    this.element = document.createElement('div');
    this.element.className = 'picture';
    this.element.tabIndex = 0;
    host.prepend(this.element);
    this.scene.add(this.chunkGroup, this.boxes.object);
    this.camera = new Camera(this.element, () => this.requestRender());
    try {
      this.renderer = new WebGLRenderer({antialias: true});
    } catch { /* said by the shell */ }
    this.isDrawing = this.renderer !== null;
    if (!this.renderer) return;
    this.renderer.outputColorSpace = LinearSRGBColorSpace;  // colours are taken as they are
    this.element.append(this.renderer.domElement);
    new ResizeObserver(() => this.resize()).observe(this.element);
    this.listen();
  }

  // ---- what is drawn ----

  /** Draws these buildings instead of those that were drawn; those that are the same objects are kept. */
  setBuildings(buildings: SceneBuilding[]): void {
    const given = new Map(buildings.map(building => [building.number, building]));
    const isKept = [...this.buildings].every(([number, old]) => given.get(number) === old);
    const added = isKept ? buildings.filter(b => !this.buildings.has(b.number)) : buildings;
    if (isKept && added.length === 0) return;
    const chunks = Math.ceil(added.length / kChunkBuildings) + (isKept ? this.chunks.length : 0);
    this.buildings = given;
    if (!isKept || chunks > kMostChunks) this.rebuild(buildings);
    else this.append(added, kChunkBuildings);
    this.box = new Box3();
    for (const chunk of this.chunks) {
      if (!chunk.mesh.geometry.boundingBox) chunk.mesh.geometry.computeBoundingBox();
      if (chunk.triangles > 0) this.box.union(chunk.mesh.geometry.boundingBox!);
    }
    this.boxes.leaveOut(this.buildings);
    this.painter.paint(this.paint);
    this.requestRender();
  }

  /** Boxes for buildings whose geometry has not come. */
  setBoxes(boxes: PlacedBox[]): void {
    this.boxes.set(boxes, this.buildings);
    this.requestRender();
  }

  /** With other looks of classes, `looks` is a new object; the rest may change from call to call. */
  setPaint(paint: Paint, buildings?: Iterable<number>): void {
    const hasNewLooks = paint.looks !== this.paint.looks || paint.unknown !== this.paint.unknown;
    this.paint = paint;
    if (hasNewLooks) this.painter.setLooks(paint);
    this.painter.paint(paint, buildings);
    this.boxes.paint(paint);
    this.requestRender();
  }

  setColours(colours: {ground: string; accent: string; change: string; edge: string; brightness: number}): void {
    this.uniforms.brightness.value = colours.brightness;
    for (const name of ['ground', 'accent', 'change', 'edge'] as const)
      this.uniforms[name].value.fromArray(rgb(colours[name]).map(c => c / 255));
    this.renderer?.setClearColor(parseInt(colours.ground.slice(1), 16));
    this.requestRender();
  }

  setHiddenLines(areShown: boolean): void {
    for (const chunk of this.chunks) chunk.hiddenLines.visible = areShown;
    this.materials.hiddenLines.visible = areShown;
    this.requestRender();
  }

  /** Leaves out what lies on the side of a plane to which its normal points; null shows all. */
  setCut(normal: Vector3 | null, offset = 0): void {
    this.uniforms.cut.value.set(normal?.x ?? 0, normal?.y ?? 0, normal?.z ?? 0, offset);
    this.requestRender();
  }

  /** Lines beside the buildings (the boxes of the truth): three coordinates in metres a point, two points a line. */
  setExtraLines(positions: Float32Array | null, colours = new Float32Array(0)): void {
    if (this.extra) {
      this.scene.remove(this.extra);
      this.extra.geometry.dispose();
      this.extra = null;
    }
    if (positions) {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(positions, 3));
      geometry.setAttribute('tint', new BufferAttribute(colours, 3));
      this.extra = new LineSegments(geometry, makeExtraLineMaterial());
      this.extra.renderOrder = 3;
      this.scene.add(this.extra);
    }
    this.requestRender();
  }

  // ---- where it looks ----

  get bounds(): Box3 {
    const all = this.box.clone();
    return all.union(this.boxes.bounds);
  }

  /** The corners of all that is drawn; of very many buildings those of their boxes. */
  corners(): Vector3[] {
    const kMost = 20000;
    const buildings = [...this.buildings.values()];
    const vertices = buildings.reduce((sum, {vertices_mm}) => sum + vertices_mm.length / 3, 0);
    if (vertices === 0 || vertices > kMost) return this.boxes.corners();
    const points: Vector3[] = [];
    for (const {vertices_mm: mm} of buildings)
      for (let i = 0; i + 2 < mm.length; i += 3) points.push(new Vector3(mm[i]! / 1000, mm[i + 1]! / 1000, mm[i + 2]! / 1000));
    return points;
  }

  /** To a selection, from outside and a little above; to everything if there is none. */
  fly(selection: Selection | null): void {
    this.settle();
    if (!selection) return this.camera.flyTo(this.corners(), null);
    this.flyToRefs(this.refs.filter(ref => ref.building === selection.building &&
      (selection.feature === undefined && selection.polygon === undefined || isMeant(ref, selection))));
  }

  flyToParts(parts: Part[]): void {
    this.settle();
    const wanted = new Set(parts.map(([b, f]) => `${b} ${f}`));
    this.flyToRefs(this.refs.filter(ref => ref.owners.some(f => wanted.has(`${ref.building} ${f}`))));
  }

  private flyToRefs(refs: PolygonRef[]): void {
    const all: Vector3[] = [];
    const outside = new Vector3();
    for (const ref of refs) {
      const {vertices_mm: mm, polygons} = this.buildings.get(ref.building)!;
      const ring = polygons[ref.polygon]!.rings[0] ?? [];
      const points = ring.map(v => new Vector3(mm[3 * v]! / 1000, mm[3 * v + 1]! / 1000, mm[3 * v + 2]! / 1000));
      all.push(...points);
      for (let i = 2; i < points.length; ++i)
        outside.add(points[i - 1]!.clone().sub(points[0]!).cross(points[i]!.clone().sub(points[0]!)));
    }
    const isPart = refs.length > 0 && refs.length < this.refs.length / 2;
    this.camera.flyTo(all, isPart && outside.length() > 0.05 ? outside.normalize() : null);
  }

  /** Looks from where the other looks, and the other from where this one does. */
  follow(other: BuildingScene): void { this.camera.tie(other.camera); }

  /** The middle of the box of a feature's polygons; null if it has none here. */
  centreOf([building, feature]: Part): Vector3 | null {
    const found = this.buildings.get(building);
    if (!found) return null;
    const box = new Box3();
    for (const polygon of found.polygons) {
      if (!polygon.owners.includes(feature)) continue;
      for (const v of polygon.rings[0] ?? [])
        box.expandByPoint(new Vector3(found.vertices_mm[3 * v]! / 1000, found.vertices_mm[3 * v + 1]! / 1000, found.vertices_mm[3 * v + 2]! / 1000));
    }
    return box.isEmpty() ? null : box.getCenter(new Vector3());
  }

  /** The edges around what is chosen and between its faces, as pairs of points; none of a whole building. */
  outlineOf(selection: Selection): [Vector3, Vector3][] {
    const found = this.buildings.get(selection.building);
    if (!found || (selection.feature === undefined && selection.polygon === undefined)) return [];
    const at = (v: number) => new Vector3(found.vertices_mm[3 * v]! / 1000, found.vertices_mm[3 * v + 1]! / 1000, found.vertices_mm[3 * v + 2]! / 1000);
    const edges = new Map<string, {ends: [number, number]; normals: [number, number, number][]}>();
    found.polygons.forEach((polygon, number) => {
      if (selection.feature !== undefined ? !polygon.owners.includes(selection.feature) : number !== selection.polygon) return;
      const normal = unit(normalOf((polygon.rings[0] ?? []).map(v => at(v).toArray())));
      for (const ring of polygon.rings)
        ring.forEach((v, i) => {
          const w = ring[(i + 1) % ring.length]!;
          const key = v < w ? `${v} ${w}` : `${w} ${v}`;
          if (!edges.has(key)) edges.set(key, {ends: [v, w], normals: []});
          edges.get(key)!.normals.push(normal);
        });
    });
    const isFlat = ([p, q]: [number, number, number][]) => q !== undefined && p![0] * q[0] + p![1] * q[1] + p![2] * q[2] > 0.996;
    return [...edges.values()].filter(({normals}) => !isFlat(normals)).map(({ends}) => [at(ends[0]), at(ends[1])]);
  }

  /** Where a point of the world lies in the picture, in CSS pixels; null behind the camera. */
  project(point: Vector3): {x: number; y: number} | null {
    const p = point.clone().project(this.camera.three);
    if (p.z > 1) return null;
    return {x: (p.x + 1) / 2 * this.element.clientWidth, y: (1 - p.y) / 2 * this.element.clientHeight};
  }

  /** What lies under a point of the window that is neither hidden nor cut away. */
  hitAt(clientX: number, clientY: number): Hit | null {
    const area = this.element.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(2 * (clientX - area.left) / area.width - 1, 1 - 2 * (clientY - area.top) / area.height), this.camera.three);
    let best: {distance: number; hit: Hit} | null = null;
    for (const chunk of this.chunks) {
      const sphere = chunk.mesh.geometry.boundingSphere;
      if (chunk.triangles === 0 || (sphere && !ray.ray.intersectsSphere(sphere))) continue;
      for (const found of bvhOf(chunk).raycast(ray.ray, 2)) {
        if (best && found.distance >= best.distance) continue;
        const number = chunk.mesh.geometry.getAttribute('number').getX(found.face!.a);
        const ref = this.refs[number];
        if (ref && !this.isAway(ref, found.point)) best = {distance: found.distance, hit: {selection: this.selectionOf(ref), point: found.point}};
      }
    }
    const box = this.boxes.hit(ray.ray);
    if (box && (!best || box.distance < best.distance)) return {selection: {building: box.building}, point: box.point};
    return best?.hit ?? null;
  }

  /** The corner of the buildings that is nearest to a point, of the polygon that was hit. */
  cornerNear(hit: Hit): Vector3 {
    const {building, polygon} = hit.selection;
    const found = this.buildings.get(building);
    let best = hit.point, distance = Infinity;
    for (const ring of found?.polygons[polygon ?? -1]?.rings ?? [])
      for (const v of ring) {
        const corner = new Vector3(found!.vertices_mm[3 * v]! / 1000, found!.vertices_mm[3 * v + 1]! / 1000, found!.vertices_mm[3 * v + 2]! / 1000);
        if (corner.distanceTo(hit.point) < distance) { distance = corner.distanceTo(hit.point); best = corner; }
      }
    return best;
  }

  private selectionOf(ref: PolygonRef): Selection {
    const feature = shownFeature(ref.owners, this.paint.labels.get(ref.building));
    return {building: ref.building, polygon: ref.polygon, ...(feature >= 0 ? {feature} : {})};
  }

  private isAway(ref: PolygonRef, point: Vector3): boolean {
    const cut = this.uniforms.cut.value;
    if (cut.x * cut.x + cut.y * cut.y + cut.z * cut.z > 0.5 && cut.x * point.x + cut.y * point.y + cut.z * point.z > cut.w) return true;
    const labels = this.paint.labels.get(ref.building);
    const feature = shownFeature(ref.owners, labels);
    return this.paint.hidden.has(feature < 0 ? -2 : labels?.[feature] ?? -1);
  }

  // ---- drawing ----

  requestRender(): void {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => { this.isWaiting = false; this.render(); });
  }

  /** Calls that the last picture took. */
  get drawCalls(): number { return this.renderer?.info.render.calls ?? 0; }

  private render(): void {
    if (!this.renderer || this.element.clientWidth === 0) return;
    this.camera.fitDepth(this.bounds);
    // A pattern's period is some ten pixels where the camera looks at.
    const height = this.element.clientHeight;
    this.uniforms.period.value = 9 * this.camera.distance * 0.73 / height;
    const pixelAt1m = 0.73 / (height * this.renderer.getPixelRatio());
    for (const chunk of this.chunks) leaveOutSmall(chunk, pixelAt1m * this.distanceTo(chunk));
    this.renderer.render(this.scene, this.camera.three);
    this.host.dataset['drawCalls'] = String(this.drawCalls);
    for (const call of this.onRender) call();
  }

  /** From the camera to the nearest place of a chunk, 0 within it. */
  private distanceTo(chunk: Chunk): number {
    return chunk.triangles > 0 ? chunk.mesh.geometry.boundingBox!.distanceToPoint(this.camera.three.position) : 0;
  }

  /** The picture has the shape of its place already before the browser tells of it. */
  private settle(): void {
    const {clientWidth: width, clientHeight: height} = this.element;
    if (width > 0 && height > 0) this.camera.resize(width, height);
  }

  private resize(): void {
    const {clientWidth: width, clientHeight: height} = this.element;
    if (width === 0 || height === 0 || !this.renderer) return;
    this.camera.resize(width, height);
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.render();
  }

  private rebuild(buildings: SceneBuilding[]): void {
    for (const chunk of this.chunks) this.drop(chunk);
    this.chunks = [];
    this.refs = [];
    this.painter = new Painter(this.uniforms, this.refs);
    this.painter.setLooks(this.paint);
    this.append(buildings, Math.max(kChunkBuildings, Math.ceil(buildings.length / (kMostChunks / 2))));
  }

  private append(buildings: SceneBuilding[], size: number): void {
    for (let i = 0; i < buildings.length; i += size) {
      const builder = new ChunkBuilder(this.refs);
      for (const building of buildings.slice(i, i + size)) {
        const begin = this.refs.length;
        builder.add(building);
        this.painter.noteRange(building.number, begin, this.refs.length);
      }
      const chunk = builder.finish(this.materials);
      chunk.hiddenLines.visible = this.materials.hiddenLines.visible;
      this.chunks.push(chunk);
      this.chunkGroup.add(chunk.mesh, chunk.lines, chunk.hiddenLines);
    }
  }

  private drop(chunk: Chunk): void {
    this.chunkGroup.remove(chunk.mesh, chunk.lines, chunk.hiddenLines);
    chunk.mesh.geometry.dispose();
    chunk.lines.geometry.dispose();
  }

  dispose(): void {
    for (const chunk of this.chunks) this.drop(chunk);
    this.chunks = [];
    this.camera.dispose();
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
    this.element.remove();
  }

  // ---- pointer ----

  /** A click is a press without a move: the end of turning the scene chooses nothing. */
  private listen(): void {
    const kSteadyPx = 5;
    let down: PointerEvent | null = null;
    const canvas = this.element;  // OrbitControls captures the pointer for it
    canvas.addEventListener('pointerdown', event => { down = event; });
    canvas.addEventListener('pointerup', event => {
      if (!down || event.button !== 0 || Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) > kSteadyPx) return;
      const hit = this.hitAt(event.clientX, event.clientY);
      for (const call of this.onPick) call(hit, event);
    });
    let isAsked = false;
    canvas.addEventListener('pointermove', event => {
      if (isAsked || event.buttons !== 0 || event.pointerType === 'touch') return;
      isAsked = true;
      requestAnimationFrame(() => {
        isAsked = false;
        const hit = this.hitAt(event.clientX, event.clientY);
        for (const call of this.onHover) call(hit, event);
      });
    });
    canvas.addEventListener('pointerleave', event => { for (const call of this.onHover) call(null, event); });
    canvas.addEventListener('contextmenu', event => {
      event.preventDefault();
      if (down && Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) > kSteadyPx) return;
      const hit = this.hitAt(event.clientX, event.clientY);
      for (const call of this.onContext) call(hit, event);
    });
  }
}
