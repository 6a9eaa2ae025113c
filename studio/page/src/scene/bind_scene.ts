// Ties the picture to the store: what is shown there follows what the page knows, and what the reader points at goes back.
import {Vector3} from 'three';
import type {App} from '../app';
import type {BoxMm, Change, Part, RelationEntry} from '../source';
import {labelOf, nameOf, type Selection} from '../store';
import {words} from '../strings';
import type {BuildingScene, Hit} from './building_scene';
import {Overlay, type OverlayLine, type OverlayMark} from './overlay';
import type {Paint} from './paint';
import {heatOf} from './heat';
import {looksOf, rgb, type Look} from './palette';
import {ownersOf} from './shape';

/** More marks than these hide the building; the list of changes has them all. */
const kMostMarks = 24;
const kMostLines = 60;
/** A relation to more others is drawn only when it is asked for by its name. */
const kMostUnasked = 3;

export function bindScene(scene: BuildingScene, app: App): void {
  const {store} = app;
  const overlay = new Overlay(scene);
  const binding = new Binding(scene, app, overlay);
  store.watch(['is_dark'], () => binding.takeColours());
  store.watch(['geometry'], () => binding.takeGeometry());
  store.watch(['buildings'], () => binding.takeBoxes());
  store.watch(['labels', 'classes', 'filter', 'colours', 'selection', 'only', 'is_dark', 'found', 'changed', 'shows_changes', 'score', 'doubtful'],
    () => scene.setPaint(binding.paint()));
  store.watch(['hover'], () => binding.takeHover());
  store.watch(['selection', 'geometry'], () => overlay.setOutline(store.value.selection ? scene.outlineOf(store.value.selection) : []));
  store.watch(['shows_hidden_lines'], () => scene.setHiddenLines(store.value.shows_hidden_lines));
  store.watch(['truth', 'shows_truth', 'classes', 'buildings'], () => binding.takeTruth());
  store.watch(['selection', 'relation', 'shows_relations', 'changed', 'shows_changes', 'is_measuring', 'geometry', 'buildings', 'only'], () => void binding.takeLines());
  scene.onPick.push((hit, event) => binding.pick(hit, event));
  scene.onHover.push((hit, event) => binding.hover(hit, event));
}

/** What the paint of a picture is by the store; the second picture of a divider uses it as well. */
export function paintOf(app: App, looks: Look[]): Paint {
  const {labels, filter, selection, only, found, changed, shows_changes, colours, hover} = app.store.value;
  return {
    labels, looks, unknown: {colour: '#e7e2d8', pattern: colours === 'pattern' ? 5 : 0}, hidden: filter.hidden,
    heat: colours === 'heat' ? heatOf(app.store.value) : null, selection, only, hover, found, open: openBuildings(app),
    changed: shows_changes ? partsOf(changed) : kNoParts
  };
}

const kNoParts: Part[] = [];
const partsOfChanges = new WeakMap<readonly Change[], Part[]>();

/** The same list for the same changes. */
function partsOf(changed: readonly Change[]): Part[] {
  if (changed.length === 0) return kNoParts;
  let parts = partsOfChanges.get(changed);
  if (!parts) partsOfChanges.set(changed, parts = changed.map(({building, feature}): Part => [building, feature]));
  return parts;
}

const openOf = new WeakMap<object, ReadonlySet<number>>();

/** Those that are no closed bodies. */
function openBuildings(app: App): ReadonlySet<number> {
  const {buildings} = app.store.value;
  let open = openOf.get(buildings);
  if (!open) openOf.set(buildings, open = new Set(buildings.flatMap(({is_open}, number) => (is_open ? [number] : []))));
  return open;
}

export const kSceneColours = {
  light: {ground: '#f6f5f2', accent: '#ffb000', change: '#a3271b', edge: '#2b3036', brightness: 1},
  dark: {ground: '#16191c', accent: '#ffb000', change: '#ff8d80', edge: '#0c0e10', brightness: 0.9}
};

class Binding {
  private looks: Look[] = [];
  private looksKey = '';
  private relations: {of: string; entries: RelationEntry[]} = {of: '', entries: []};
  private measure: Vector3[] = [];
  private hovered: number[] = [];

  constructor(private readonly scene: BuildingScene, private readonly app: App, private readonly overlay: Overlay) {}

  paint(): Paint {
    const {classes, colours} = this.app.store.value;
    const isPattern = colours === 'pattern';
    const key = JSON.stringify([classes.map(({name, is_abstract}) => [name, is_abstract]), isPattern]);
    if (key !== this.looksKey) {
      this.looksKey = key;
      this.looks = looksOf(classes, isPattern);
    }
    return paintOf(this.app, this.looks);
  }

  takeColours(): void { this.scene.setColours(kSceneColours[this.app.store.value.is_dark ? 'dark' : 'light']); }

  takeGeometry(): void {
    this.scene.setBuildings(this.app.store.value.geometry);
  }

  takeBoxes(): void {
    this.scene.setBoxes(this.app.store.value.buildings.map(({at_m: from, size_m: size, away_m}, building) =>
      ({building, from, to: [from[0] + size[0], from[1] + size[1], from[2] + size[2]], isFar: away_m !== undefined})));
  }

  takeHover(): void {
    const now = this.app.store.value.hover ? [this.app.store.value.hover.building] : [];
    this.scene.setPaint(this.paint(), new Set([...this.hovered, ...now]));
    this.hovered = now;
  }

  takeTruth(): void {
    const {truth, shows_truth} = this.app.store.value;
    if (!shows_truth) return this.scene.setExtraLines(null);
    const {classes} = this.app.store.value;
    const looks = looksOf(classes, false);
    const byClass = new Map(classes.map(({name}, i) => [name, looks[i]!.colour]));
    this.scene.setExtraLines(new Float32Array(truth.flatMap(object => boxLines(object.box_mm))),
      new Float32Array(truth.flatMap(object => Array(24).fill(rgb(byClass.get(object.class) ?? '#000000').map(c => c / 255)).flat())));
  }

  async takeLines(): Promise<void> {
    const {selection, shows_relations, relation, is_measuring} = this.app.store.value;
    if (!is_measuring) this.measure = [];
    this.overlay.set(this.measureLines(), this.marks());
    if (!selection || selection.feature === undefined || !shows_relations) return;
    const part: Part = [selection.building, selection.feature];
    const entries = await this.relationsOf(part);
    if (this.app.store.value.selection !== selection) return;
    const from = this.scene.centreOf(part);
    if (!from) return;
    const lines: OverlayLine[] = [];
    for (const entry of entries) {
      if (relation !== null ? entry.name !== relation : entry.features.length > kMostUnasked) continue;
      for (const feature of entry.features) {
        const to = this.scene.centreOf([part[0], feature]);
        if (to && lines.length < kMostLines)
          lines.push({from, to, kind: 'relation', ...(entry.features.length === 1 || relation !== null ? {label: entry.name} : {})});
      }
    }
    this.overlay.set([...this.measureLines(), ...lines], this.marks());
  }

  private async relationsOf([building, feature]: Part): Promise<RelationEntry[]> {
    const of = `${building} ${feature} ${this.app.store.value.version}`;
    if (this.relations.of === of) return this.relations.entries;
    try {
      const entries = (await this.app.source.explain(building, feature, true)).relations;
      this.relations = {of, entries};
      return entries;
    } catch {
      return [];  // the explanation itself says why
    }
  }

  private marks(): OverlayMark[] { return [...this.changeMarks(), ...this.nameMarks()]; }

  /** The names of buildings that stand where they do not belong. */
  private nameMarks(): OverlayMark[] {
    const {buildings, only} = this.app.store.value;
    return buildings.flatMap(({at_m: [x, y, z], size_m: [width, depth, height], is_moved}, building): OverlayMark[] => (is_moved && (only ?? building) === building ?
      [{at: new Vector3(x + width / 2, y + depth / 2, z + height), text: nameOf(this.app.store.value, building), kind: 'name'}] : []));
  }

  private changeMarks(): OverlayMark[] {
    const {changed, shows_changes, classes} = this.app.store.value;
    if (!shows_changes || changed.length > kMostMarks) return [];
    const name = (label: number) => classes[label]?.name ?? words.scene.unknown;
    return changed.flatMap(({building, feature, before, after}): OverlayMark[] => {
      const at = this.scene.centreOf([building, feature]);
      return at ? [{at, text: `${name(before)} → ${name(after)}`, kind: 'change'}] : [];
    });
  }

  private measureLines(): OverlayLine[] {
    const [from, to] = this.measure;
    if (!from) return [];
    if (!to) return [{from, to: from, kind: 'measure'}];
    const level = Math.hypot(to.x - from.x, to.y - from.y);
    return [{from, to, kind: 'measure', label: words.scene.distance(from.distanceTo(to), level, Math.abs(to.z - from.z))}];
  }

  pick(hit: Hit | null, event: PointerEvent): void {
    const {store} = this.app;
    if (store.value.is_measuring) return this.addMeasure(hit);
    if (!hit) return this.app.select(null);
    if (event.detail > 1) return this.app.select(hit.selection, true);
    if (hit.selection.polygon === undefined) void this.app.need([hit.selection.building]);
    this.app.select(this.inner(hit.selection));
  }

  /** A second click on the same place goes to the feature around it. */
  private inner(selection: Selection): Selection {
    const old = this.app.store.value.selection;
    const shape = this.app.store.value.geometry.get(selection.building);
    if (!old || !shape || selection.polygon === undefined || old.building !== selection.building || old.polygon !== selection.polygon) return selection;
    const owners = ownersOf(shape, selection.polygon);
    const at = owners.indexOf(old.feature ?? -1);
    const next = owners[at + 1];
    return at >= 0 && next !== undefined ? {...selection, feature: next} : selection;
  }

  private addMeasure(hit: Hit | null): void {
    if (!hit) { this.measure = []; }
    else {
      const corner = this.scene.cornerNear(hit);
      const a = this.scene.project(corner), b = this.scene.project(hit.point);
      const isNear = a && b && Math.hypot(a.x - b.x, a.y - b.y) < 14;
      if (this.measure.length > 1) this.measure = [];
      this.measure.push(isNear ? corner : hit.point);
    }
    void this.takeLines();
    this.scene.requestRender();
  }

  hover(hit: Hit | null, event: PointerEvent): void {
    const {store} = this.app;
    const old = store.value.hover;
    const now = hit?.selection ?? null;
    if (old?.building !== now?.building || old?.feature !== now?.feature || old?.polygon !== now?.polygon) store.set({hover: now});
    this.overlay.say(now ? this.nameOf(now) : null, event.clientX, event.clientY);
  }

  private nameOf({building, feature, polygon}: Selection): string {
    const {classes, buildings} = this.app.store.value;
    if (feature === undefined) return buildings.length > 1 || polygon === undefined ? nameOf(this.app.store.value, building) : words.scene.surface;
    const label = classes[labelOf(this.app.store.value, building, feature)]?.name ?? words.scene.unknown;
    const name = this.app.feature(building, feature)?.name ?? '';
    return name.startsWith(label) ? name : name ? `${label} · ${name}` : label;
  }
}

/** The twelve edges of a box, in metres. */
function boxLines(box: BoxMm): number[] {
  const [x0, y0, z0, x1, y1, z1] = box.map(mm => mm / 1000) as BoxMm;
  const corner = (i: number) => [i & 1 ? x1 : x0, i & 2 ? y1 : y0, i & 4 ? z1 : z0];
  return [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]]
    .flatMap(([a, b]) => [...corner(a!), ...corner(b!)]);
}

