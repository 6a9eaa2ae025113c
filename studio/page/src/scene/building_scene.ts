// The picture of buildings: one canvas. It may be made twice (before and after), see divider.ts. It draws when something has changed,
// and not before.
import {
  Box3, BufferAttribute, BufferGeometry, Color, ColorManagement, DoubleSide, Frustum, Group, InstancedMesh, LineSegments,
  LinearSRGBColorSpace, Matrix4, Mesh, Plane, Raycaster, Scene, Vector2, Vector3, WebGLRenderer, type Ray
} from 'three';
import type {Part, Shape, Vec3} from '../source';
import type {Selection} from '../store';
import {BuildingBoxes, type PlacedBox} from './building_boxes';
import {Camera, type FreeArea} from './camera';
import {Cap} from './cap';
import {buildChunk, bvhOf, leaveOutSmall, placedAt, type Chunk, type PlacedShape} from './chunk';
import {makeExtraLineMaterial, makeMaterials, makeUniforms} from './materials';
import {NumberSpace} from './number_space';
import {mainFacade} from './facade';
import {isMeant, kNothing, Painter, shownFeature, type Paint} from './paint';
import {rgb} from './palette';
import {hasOwner, pointOf, polygonCount, ringsOf, vertexCount} from './shape';
import {normalOf, unit} from './triangulate';

/** What lies under a point of the picture. */
export interface Hit { selection: Selection; point: Vector3 }

ColorManagement.enabled = false;

/** Three calls a chunk and two more with a cut, so at most 180 for all, however many buildings there are. */
const kMostChunks = 35;
/** Chunks that are brought together become no larger than this, unless there would be too many. */
const kChunkCorners = 200_000;
const kChunkBuildings = 100;

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
  private readonly painter = new Painter(this.uniforms);
  private readonly numbers = new NumberSpace();
  private readonly cap = new Cap(this.uniforms);
  private chunks: Chunk[] = [];
  private buildings: ReadonlyMap<number, Shape> = new Map();
  private paint: Paint = kNothing;
  private box = new Box3();
  /** The scene whose cut goes through this one, too. */
  private followed: BuildingScene | null = null;
  private readonly followers: BuildingScene[] = [];
  private isWaiting = false;
  private extra: LineSegments | null = null;
  /** Nothing was to be drawn yet: the first picture costs a browser that draws in software much time, so it is one of buildings. */
  private isNew = true;

  constructor(readonly host: HTMLElement) {
    this.element = document.createElement('div');
    this.element.className = 'picture';
    this.element.tabIndex = 0;
    host.prepend(this.element);
    this.scene.add(this.chunkGroup, this.boxes.object, this.cap.mesh);
    this.camera = new Camera(this.element, () => this.requestRender());
    this.camera.freeArea = () => freeAreaOf(host);
    try {
      this.renderer = new WebGLRenderer({antialias: true, stencil: true});
    } catch { /* said by the workbench */ }
    this.isDrawing = this.renderer !== null;
    if (!this.renderer) return;
    this.renderer.debug.checkShaderErrors = false;  // asking for them waits for the compiler
    this.renderer.outputColorSpace = LinearSRGBColorSpace;  // colours are taken as they are
    this.element.append(this.renderer.domElement);
    this.prepare(this.renderer);
    new ResizeObserver(() => this.resize()).observe(this.element);
    this.listen();
  }

  /** Has the browser compile what the first pictures need, while the buildings are asked for. */
  private prepare(renderer: WebGLRenderer): void {
    const none = new BufferGeometry();
    const box = new InstancedMesh(none, this.boxes.material, 1);
    box.setColorAt(0, new Color());
    const first = new Scene();
    first.add(box, new Mesh(none, this.materials.faces), new LineSegments(none, this.materials.lines));
    renderer.compile(first, this.camera.three);
  }

  // ---- what is drawn ----

  /** Draws these buildings instead of those that were drawn; those that are the same objects are kept. What comes together is drawn
      together, so it should lie together. */
  setBuildings(buildings: ReadonlyMap<number, Shape>): void {
    const added = [...buildings.values()].filter(shape => this.buildings.get(shape.number) !== shape);
    const gone = new Set([...this.buildings.values()].filter(shape => buildings.get(shape.number) !== shape));
    if (added.length === 0 && gone.size === 0) return;
    this.buildings = buildings;
    this.isNew = false;
    for (const chunk of [...this.chunks]) {
      const kept = chunk.shapes.map(({shape}) => shape).filter(shape => !gone.has(shape));
      if (kept.length === chunk.shapes.length) continue;
      this.drop(chunk);
      if (kept.length > 0) this.append(kept);
    }
    for (let i = 0; i < added.length; i += kChunkBuildings) this.append(added.slice(i, i + kChunkBuildings));
    if (this.chunks.length > kMostChunks) this.merge();
    this.box = new Box3();
    for (const chunk of this.chunks) if (chunk.triangles > 0) this.box.union(chunk.mesh.geometry.boundingBox!);
    this.boxes.leaveOut(this.buildings);
    this.painter.paint(this.paint, added.map(({number}) => number));
    this.layCap();
    this.requestRender();
  }

  private append(shapes: Shape[]): void {
    const polygons = shapes.reduce((sum, shape) => sum + polygonCount(shape), 0);
    const chunk = buildChunk(shapes, this.numbers.take(polygons), this.materials);
    for (const placed of chunk.shapes) this.painter.add(placed);
    this.painter.paint(this.paint, shapes.map(({number}) => number));
    chunk.hiddenLines.visible = this.materials.hiddenLines.visible;
    this.chunks.push(chunk);
    this.chunkGroup.add(chunk.mesh, chunk.lines, chunk.hiddenLines, chunk.backs, chunk.fronts);
  }

  /** Brings the smallest chunks together, until there are few again. */
  private merge(): void {
    const sizeOf = (chunk: Chunk) => chunk.mesh.geometry.getAttribute('position').count;
    const inOrder = [...this.chunks].sort((p, q) => sizeOf(p) - sizeOf(q));
    for (let most = kChunkCorners; this.chunks.length > kMostChunks * 3 / 4; most *= 2)
      for (let first = 0; first < inOrder.length && this.chunks.length > kMostChunks / 2;) {
        let size = 0, last = first;
        while (last < inOrder.length && (size += sizeOf(inOrder[last]!)) <= most) ++last;
        if (last <= first + 1) break;
        const together = inOrder.splice(first, last - first);
        for (const chunk of together) this.drop(chunk);
        this.append(together.flatMap(({shapes}) => shapes.map(({shape}) => shape)));
        inOrder.splice(first, 0, this.chunks.at(-1)!);
        ++first;
      }
  }

  /** Boxes for buildings whose geometry has not come. */
  setBoxes(boxes: PlacedBox[]): void {
    this.boxes.set(boxes, this.buildings);
    this.isNew = this.isNew && boxes.length === 0;
    this.requestRender();
  }

  /** With other looks of classes, `looks` is a new object; the rest may change from call to call. */
  setPaint(paint: Paint, buildings?: Iterable<number>): void {
    const hasNewLooks = paint.looks !== this.paint.looks || paint.unknown.pattern !== this.paint.unknown.pattern;
    if (!buildings && onlyLabelsDiffer(paint, this.paint))
      buildings = [...this.buildings.keys()].filter(number => paint.labels.get(number) !== this.paint.labels.get(number));
    this.paint = paint;
    if (hasNewLooks) this.painter.setLooks(paint);
    const areOther = this.painter.paint(paint, buildings);
    const areBoxesOther = this.boxes.paint(paint, this.uniforms.ground.value);
    if (hasNewLooks || areOther || areBoxesOther) this.requestRender();
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

  /** Leaves out what lies on the side of a plane to which its normal points, and closes the bodies that it goes through; null shows all. */
  setCut(normal: Vector3 | null, offset = 0): void {
    this.uniforms.cut.value.set(normal?.x ?? 0, normal?.y ?? 0, normal?.z ?? 0, offset);
    this.layCap();
    this.requestRender();
    for (const other of this.followers) other.setCut(normal, offset);
  }

  private get isCut(): boolean { return this.normalOfCut.lengthSq() > 0.5; }
  private get normalOfCut(): Vector3 {
    const {x, y, z} = this.uniforms.cut.value;
    return new Vector3(x, y, z);
  }
  private layCap(): void { this.cap.set(this.isCut ? this.normalOfCut : null, this.uniforms.cut.value.w, this.bounds); }

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
    return this.boxes.bounds.isEmpty() ? this.box : this.boxes.bounds;
  }

  /** The corners of all that is drawn but far away; of many buildings those of their boxes. */
  corners(): Vector3[] {
    const kMost = 20000;
    if (this.paint.only !== null) return this.boxes.corners(new Set([this.paint.only]));
    const shapes = [...this.buildings.values()];
    const vertices = shapes.reduce((sum, shape) => sum + vertexCount(shape), 0);
    if (vertices === 0 || vertices > kMost || this.boxes.hasOthers(this.buildings)) return this.boxes.corners();
    return shapes.flatMap(shape => Array.from({length: vertexCount(shape)}, (_, v) => new Vector3(...pointOf(shape, v))));
  }

  /** Everything comes into the picture, without a flight. */
  frame(): void {
    this.settle();
    this.camera.frame(this.corners());
  }

  /** To a selection, from outside and a little above; to everything if there is none. */
  fly(selection: Selection | null): void {
    this.settle();
    if (!selection) return this.camera.flyTo(this.corners(), null);
    const {building, feature, polygon} = selection;
    const shape = this.buildings.get(building);
    if (!shape) return this.camera.flyTo(this.boxes.corners(new Set([building])), null);
    if (feature === undefined && polygon === undefined) {
      const facade = this.boxes.hasOthers(new Set([building])) ? mainFacade(shape, this.paint.labels.get(building)) : null;
      return this.camera.flyTo(Array.from({length: vertexCount(shape)}, (_, v) => new Vector3(...pointOf(shape, v))), facade, 1);
    }
    this.flyToPolygons(polygonsOf(shape, i => isMeant(shape, i, selection)), false);
  }

  /** Of parts whose buildings have not come, to the boxes of these. */
  flyToParts(parts: Part[]): void {
    this.settle();
    const features = new Map<number, Set<number>>();
    for (const [building, feature] of parts) features.set(building, (features.get(building) ?? new Set()).add(feature));
    const missing = new Set([...features.keys()].filter(building => !this.buildings.has(building)));
    const polygons = [...features].flatMap(([building, wanted]) => {
      const shape = this.buildings.get(building);
      return shape ? polygonsOf(shape, i => [...wanted].some(feature => hasOwner(shape, i, feature))) : [];
    });
    const all = [...this.buildings.values()].reduce((sum, shape) => sum + polygonCount(shape), 0);
    this.flyToPolygons(polygons, polygons.length > all / 2, this.boxes.corners(missing));
  }

  private flyToPolygons(polygons: [Shape, number][], isWhole: boolean, more: Vector3[] = []): void {
    const all: Vector3[] = [...more];
    const outside = new Vector3();
    for (const [shape, polygon] of polygons) {
      const points = (ringsOf(shape, polygon)[0] ?? []).map(v => new Vector3(...pointOf(shape, v)));
      all.push(...points);
      for (let i = 2; i < points.length; ++i)
        outside.add(points[i - 1]!.clone().sub(points[0]!).cross(points[i]!.clone().sub(points[0]!)));
    }
    this.camera.flyTo(all, !isWhole && outside.length() > 0.05 ? outside.normalize() : null);
  }

  /** Looks from where the other looks, and the other from where this one does; a cut of the other goes through this one, too. */
  follow(other: BuildingScene): void {
    this.camera.tie(other.camera);
    this.followed = other;
    other.followers.push(this);
    if (other.isCut) this.setCut(other.normalOfCut, other.uniforms.cut.value.w);
  }

  /** The middle of the box of a feature's polygons; null if it has none here. */
  centreOf([building, feature]: Part): Vector3 | null {
    const shape = this.buildings.get(building);
    if (!shape) return null;
    const box = new Box3();
    for (const [, polygon] of polygonsOf(shape, i => hasOwner(shape, i, feature)))
      for (const v of ringsOf(shape, polygon)[0] ?? []) box.expandByPoint(new Vector3(...pointOf(shape, v)));
    return box.isEmpty() ? null : box.getCenter(new Vector3());
  }

  /** The edges around what is chosen and between its faces, as pairs of points; none of a whole building. */
  outlineOf(selection: Selection): [Vector3, Vector3][] {
    const shape = this.buildings.get(selection.building);
    if (!shape || (selection.feature === undefined && selection.polygon === undefined)) return [];
    const at = (v: number) => new Vector3(...pointOf(shape, v));
    const edges = new Map<string, {ends: [number, number]; normals: [number, number, number][]}>();
    for (const [, polygon] of polygonsOf(shape, i => isMeant(shape, i, selection))) {
      const rings = ringsOf(shape, polygon);
      const normal = unit(normalOf((rings[0] ?? []).map(v => pointOf(shape, v))));
      for (const ring of rings)
        ring.forEach((v, i) => {
          const w = ring[(i + 1) % ring.length]!;
          const key = v < w ? `${v} ${w}` : `${w} ${v}`;
          if (!edges.has(key)) edges.set(key, {ends: [v, w], normals: []});
          edges.get(key)!.normals.push(normal);
        });
    }
    const isFlat = ([p, q]: [number, number, number][]) => q !== undefined && p![0] * q[0] + p![1] * q[1] + p![2] * q[2] > 0.996;
    return [...edges.values()].filter(({normals}) => !isFlat(normals)).map(({ends}) => [at(ends[0]), at(ends[1])]);
  }

  /** How large boxes are in the picture, in CSS pixels; of those out of sight as if they were far away. */
  sizesOf(boxes: readonly {at_m: Vec3; size_m: Vec3}[]): number[] {
    const kOutOfSight = 0.02;
    const camera = this.camera.three;
    camera.updateMatrixWorld();
    const sight = new Frustum().setFromProjectionMatrix(new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
    const perRadian = this.element.clientHeight / 0.73;
    const box = new Box3(), size = new Vector3();
    return boxes.map(({at_m, size_m}) => {
      box.min.set(...at_m);
      box.max.set(at_m[0] + size_m[0], at_m[1] + size_m[1], at_m[2] + size_m[2]);
      const distance = Math.max(0.1, box.distanceToPoint(camera.position));
      return perRadian * box.getSize(size).length() / distance * (sight.intersectsBox(box) ? 1 : kOutOfSight);
    });
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
      for (const found of bvhOf(chunk).raycast(ray.ray, DoubleSide)) {
        if (best && found.distance >= best.distance) continue;
        const number = chunk.mesh.geometry.getAttribute('number').getX(found.face!.a);
        const placed = placedAt(chunk, number);
        if (this.isAway(placed, number, found.point)) continue;
        best = {distance: found.distance, hit: this.isInside(ray.ray, new Vector3().fromBufferAttribute(chunk.mesh.geometry.getAttribute('normal'), found.face!.a), placed) ? this.hitOfCap(placed, ray.ray) :
          {selection: this.selectionOf(placed, number), point: found.point}};
      }
    }
    const box = this.boxes.hit(ray.ray);
    if (box && (!best || box.distance < best.distance)) return {selection: {building: box.building}, point: box.point};
    return best?.hit ?? null;
  }

  /** A face of a closed body that is first seen from within lies behind the cut. */
  private isInside(ray: Ray, normal: Vector3, placed: PlacedShape): boolean {
    return this.isCut && normal.dot(ray.direction) > 0 && !this.paint.open.has(placed.shape.number) && this.paint.hidden.size === 0;
  }

  private hitOfCap({shape}: PlacedShape, ray: Ray): Hit {
    const plane = new Plane(this.normalOfCut, -this.uniforms.cut.value.w);
    return {selection: {building: shape.number}, point: ray.intersectPlane(plane, new Vector3()) ?? ray.origin};
  }

  /** The corner of the buildings that is nearest to a point, of the polygon that was hit. */
  cornerNear(hit: Hit): Vector3 {
    const {building, polygon} = hit.selection;
    const shape = this.buildings.get(building);
    let best = hit.point, distance = Infinity;
    for (const v of shape && polygon !== undefined ? ringsOf(shape, polygon).flat() : []) {
      const corner = new Vector3(...pointOf(shape!, v));
      if (corner.distanceTo(hit.point) < distance) { distance = corner.distanceTo(hit.point); best = corner; }
    }
    return best;
  }

  private selectionOf({shape, begin}: PlacedShape, number: number): Selection {
    const feature = shownFeature(shape, number - begin, this.paint.labels.get(shape.number));
    return {building: shape.number, polygon: number - begin, ...(feature >= 0 ? {feature} : {})};
  }

  private isAway({shape, begin}: PlacedShape, number: number, point: Vector3): boolean {
    const cut = this.uniforms.cut.value;
    if (this.paint.only !== null && this.paint.only !== shape.number) return true;
    if (this.isCut && cut.x * point.x + cut.y * point.y + cut.z * point.z > cut.w) return true;
    const labels = this.paint.labels.get(shape.number);
    const feature = shownFeature(shape, number - begin, labels);
    return this.paint.hidden.has(feature < 0 ? -2 : labels?.[feature] ?? -1);
  }

  // ---- drawing ----

  requestRender(): void {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => { this.isWaiting = false; this.render(); });
  }

  private render(): void {
    if (!this.renderer || this.element.clientWidth === 0 || this.isNew) return;
    this.camera.fitDepth(this.bounds);
    // A pattern's period is some ten pixels where the camera looks at.
    const height = this.element.clientHeight;
    this.uniforms.period.value = 9 * this.camera.distance * 0.73 / height;
    const pixelAt1m = 0.73 / (height * this.renderer.getPixelRatio());
    for (const chunk of this.chunks) {
      leaveOutSmall(chunk, pixelAt1m * this.distanceTo(chunk));
      chunk.backs.visible = chunk.fronts.visible = this.isCut;
      if (this.isCut) chunk.mesh.geometry.setDrawRange(0, Infinity);  // what is left out would not be counted
    }
    this.renderer.render(this.scene, this.camera.three);
    this.host.dataset['drawCalls'] = String(this.renderer.info.render.calls);
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

  private drop(chunk: Chunk): void {
    this.chunkGroup.remove(chunk.mesh, chunk.lines, chunk.hiddenLines, chunk.backs, chunk.fronts);
    this.chunks.splice(this.chunks.indexOf(chunk), 1);
    this.numbers.give(chunk.begin, chunk.end);
    for (const placed of chunk.shapes) if (this.painter.of(placed.shape.number) === placed) this.painter.drop(placed.shape.number);
    chunk.mesh.geometry.dispose();
    chunk.lines.geometry.dispose();
  }

  dispose(): void {
    for (const chunk of [...this.chunks]) this.drop(chunk);
    this.cap.dispose();
    this.followed?.followers.splice(this.followed.followers.indexOf(this), 1);
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

function polygonsOf(shape: Shape, isWanted: (polygon: number) => boolean): [Shape, number][] {
  return Array.from({length: polygonCount(shape)}, (_, polygon): [Shape, number] => [shape, polygon]).filter(([, polygon]) => isWanted(polygon));
}

/** The larger of what is beside the legend and what is over it, below the tools. */
function freeAreaOf(host: HTMLElement): FreeArea {
  const all = host.getBoundingClientRect();
  const bar = [...host.querySelectorAll('.tool-bar, .scene-note:not(:empty)')].at(-1)?.getBoundingClientRect();
  const card = host.querySelector('.legend-card')?.getBoundingClientRect();
  if (all.width === 0 || all.height === 0) return {left: 0, top: 0, width: 1, height: 1};
  const top = bar ? bar.bottom - all.top : 0;
  const areaOf = (left: number, bottom: number): FreeArea =>
    ({left: left / all.width, top: top / all.height, width: 1 - left / all.width, height: Math.max(0.2, (bottom - top) / all.height)});
  if (!card || card.width === 0) return areaOf(0, all.height);
  const beside = areaOf(card.right - all.left, all.height), over = areaOf(0, card.top - all.top);
  const sideOf = ({width, height}: FreeArea) => Math.min(width * all.width, height * all.height);
  return sideOf(beside) >= sideOf(over) ? beside : over;
}

/** Labels of buildings that have not changed are the same lists: after a key in the pack only a few are painted anew. */
function onlyLabelsDiffer(p: Paint, q: Paint): boolean {
  const same = ['looks', 'hidden', 'heat', 'selection', 'only', 'hover', 'found', 'changed', 'open'] as const;
  return p.unknown.pattern === q.unknown.pattern && same.every(name => p[name] === q[name]);
}
