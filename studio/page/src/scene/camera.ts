// Where the picture is seen from: turned, moved, zoomed to the cursor by mouse, touch or keys; two may be tied together.
import {Box2, Box3, MOUSE, PerspectiveCamera, Spherical, Vector2, Vector3} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

const kFieldDeg = 40;
const kTurn = Math.PI / 24;
const kFlightMs = 320;
/** A part is shown with some of what is around it. */
const kContext = 2;
const kLeastRadiusM = 3;
const kMargin = 1.12;
const kFirstDirection = new Vector3(0.5, -0.8, 0.5).normalize();

export interface FreeArea { left: number; top: number; width: number; height: number }

export class Camera {
  readonly three = new PerspectiveCamera(kFieldDeg, 1, 0.1, 1e5);
  private readonly controls: OrbitControls;
  private readonly tied: Camera[] = [];
  private flight = 0;
  /** Where it was put last. */
  private put: {target: Vector3; distance: number} | null = null;
  /** Where nothing lies over the picture, as shares of its width and height: what is looked at comes into the middle of that. */
  freeArea: () => FreeArea = () => ({left: 0, top: 0, width: 1, height: 1});
  /** From the middle of the picture to the middle of the view, as shares of its size. */
  private readonly viewShift = new Vector2();

  constructor(element: HTMLElement, private readonly onChange: () => void) {
    this.three.up.set(0, 0, 1);
    this.three.position.set(20, -30, 20);
    this.controls = new OrbitControls(this.three, element);
    this.controls.zoomToCursor = true;
    this.controls.minDistance = 0.3;
    this.controls.mouseButtons = {LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.PAN};
    this.controls.addEventListener('change', () => this.moved());
    this.controls.addEventListener('start', () => { this.flight = 0; });
    element.addEventListener('keydown', event => this.onKey(event));
  }

  get distance(): number { return this.three.position.distanceTo(this.controls.target); }
  /** The reader has moved or zoomed it since it was put where it is; who has turned it still looks at the same. */
  get isMoved(): boolean {
    const {put, distance} = this;
    return put !== null && Math.max(put.target.distanceTo(this.target), Math.abs(put.distance - distance)) > 1e-3 * distance;
  }
  get target(): Vector3 { return this.controls.target; }
  /** From the camera into the picture. */
  get direction(): Vector3 { return this.controls.target.clone().sub(this.three.position).normalize(); }

  resize(width: number, height: number): void {
    this.three.aspect = width / height;
    this.place(this.viewShift);
  }

  private place(shift: Vector2): void {
    this.viewShift.copy(shift);
    this.three.setViewOffset(1000 * this.three.aspect, 1000, -1000 * this.three.aspect * shift.x, -1000 * shift.y, 1000 * this.three.aspect, 1000);
  }

  /** The nearest and the farthest depth that are drawn, so that precision goes to what there is. */
  fitDepth(bounds: Box3): void {
    if (bounds.isEmpty()) return;
    const size = bounds.getSize(new Vector3()).length();
    const away = this.three.position.distanceTo(bounds.getCenter(new Vector3()));
    this.three.far = away + size + 10;
    this.three.near = Math.max(0.02, Math.min(this.distance / 20, Math.max(0, away - size)) , this.three.far / 2e4);
    this.three.updateProjectionMatrix();
  }

  /** Looks at points so that they fill the picture, from `outside` and a little above, or as it first looks. */
  flyTo(points: Vector3[], outside: Vector3 | null, around = outside ? kContext : 1): void {
    const direction = outside ? outside.clone().add(new Vector3(-0.35 * outside.y, 0.35 * outside.x, 0.4)).normalize() : kFirstDirection;
    this.look(points, direction, around);
  }

  /** Puts points into the picture at once, seen from the side from which it looks by now. */
  frame(points: Vector3[]): void { this.look(points, this.put ? this.direction.negate() : kFirstDirection, 1, true); }

  /** The picture is first centred on the box of the points, then twice on what is seen of them. */
  look(points: Vector3[], direction: Vector3, around = 1, isAtOnce = false): void {
    if (points.length === 0) return;
    const centre = new Box3().setFromPoints(points).getCenter(new Vector3());
    const free = this.freeArea();
    const tall = Math.tan(kFieldDeg * Math.PI / 360) * free.height;
    const wide = Math.tan(kFieldDeg * Math.PI / 360) * this.three.aspect * free.width;
    const right = new Vector3().crossVectors(this.three.up, direction).normalize();
    const up = new Vector3().crossVectors(direction, right);
    let distance = 0;
    for (let round = 0; round < 3; ++round) {
      distance = kLeastRadiusM / tall;
      for (const point of points) {
        const p = point.clone().sub(centre).multiplyScalar(around * kMargin);
        distance = Math.max(distance, p.dot(direction) + Math.max(Math.abs(p.dot(right)) / wide, Math.abs(p.dot(up)) / tall));
      }
      const seen = new Box2();
      for (const point of points) {
        const p = point.clone().sub(centre);
        const depth = Math.max(0.01, distance - p.dot(direction));
        seen.expandByPoint(new Vector2(p.dot(right) / depth, p.dot(up) / depth));
      }
      const middle = seen.getCenter(new Vector2()).multiplyScalar(distance);
      if (round < 2) centre.addScaledVector(right, middle.x).addScaledVector(up, middle.y);
    }
    this.goTo(centre.clone().addScaledVector(direction, distance), centre,
      new Vector2(free.left + free.width / 2 - 0.5, free.top + free.height / 2 - 0.5), isAtOnce);
  }

  /** From the front, the side, above: the numbers 1, 2, 3. */
  lookAlong(axis: 'front' | 'side' | 'above', points: Vector3[]): void {
    const direction = {front: new Vector3(0, -1, 0.02), side: new Vector3(1, 0, 0.02), above: new Vector3(0, -0.001, 1)}[axis];
    this.look(points, direction.normalize());
  }

  private goTo(position: Vector3, target: Vector3, shift: Vector2, isAtOnce: boolean): void {
    const number = ++this.flight;
    this.put = {target, distance: position.distanceTo(target)};
    const from = {position: this.three.position.clone(), target: this.controls.target.clone(), shift: this.viewShift.clone()};
    const isStill = isAtOnce || matchMedia('(prefers-reduced-motion: reduce)').matches;
    const begin = performance.now();
    const step = () => {
      if (number !== this.flight) return;
      const t = isStill ? 1 : Math.min(1, (performance.now() - begin) / kFlightMs);
      const eased = 1 - (1 - t) ** 3;
      this.three.position.lerpVectors(from.position, position, eased);
      this.controls.target.lerpVectors(from.target, target, eased);
      this.place(from.shift.clone().lerp(shift, eased));
      this.controls.update();
      this.moved();
      if (t < 1) requestAnimationFrame(step);
    };
    step();
  }

  tie(other: Camera): void {
    if (!this.tied.includes(other)) this.tied.push(other);
    if (!other.tied.includes(this)) other.tied.push(this);
    this.copy(other);
  }

  private copy(other: Camera): void {
    this.three.position.copy(other.three.position);
    this.three.quaternion.copy(other.three.quaternion);
    this.controls.target.copy(other.controls.target);
    this.place(other.viewShift);
    this.three.updateMatrixWorld();
    this.onChange();
  }

  private moved(): void {
    for (const other of this.tied) other.copy(this);
    this.onChange();
  }

  private turn(sideways: number, upwards: number): void {
    const offset = this.three.position.clone().sub(this.controls.target);
    const place = new Spherical().setFromVector3(new Vector3(offset.x, offset.z, -offset.y));
    place.theta += sideways;
    place.phi = Math.max(0.01, Math.min(Math.PI - 0.01, place.phi + upwards));
    const turned = new Vector3().setFromSpherical(place);
    this.three.position.copy(this.controls.target).add(new Vector3(turned.x, -turned.z, turned.y));
    this.controls.update();
    this.moved();
  }

  private shift(right: number, up: number): void {
    const step = this.distance / 20;
    const move = new Vector3().setFromMatrixColumn(this.three.matrix, 0).multiplyScalar(right * step)
      .add(new Vector3().setFromMatrixColumn(this.three.matrix, 1).multiplyScalar(up * step));
    this.three.position.add(move);
    this.controls.target.add(move);
    this.controls.update();
    this.moved();
  }

  zoom(factor: number): void {
    this.three.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.moved();
  }

  private onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrow = ({ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]} as Record<string, [number, number]>)[event.key];
    if (arrow) event.shiftKey ? this.shift(...arrow) : this.turn(arrow[0] * kTurn, -arrow[1] * kTurn);
    else if (event.key === '+' || event.key === '=') this.zoom(0.85);
    else if (event.key === '-') this.zoom(1 / 0.85);
    else return;
    event.preventDefault();
  }

  dispose(): void {
    this.controls.dispose();
    for (const other of this.tied) other.tied.splice(other.tied.indexOf(this), 1);
  }
}
