// The section plane: level (a storey is opened from above), or upright along the front, the side or the present view.
import {Box3, Vector3} from 'three';
import type {App} from '../app';
import {el, replace} from '../dom';
import {words} from '../strings';
import type {BuildingScene} from './building_scene';

export type CutKind = 'none' | 'level' | 'front' | 'side' | 'view';
/** A storey is opened this far over its floor, so that its windows are cut. */
const kOverFloorM = 1.2;

export class Cut {
  kind: CutKind = 'none';
  private normal = new Vector3(0, 0, 1);
  private at = 0.5;
  readonly onChange: (() => void)[] = [];

  constructor(readonly app: App, private readonly scene: BuildingScene) {}

  choose(kind: CutKind): void {
    this.kind = kind;
    const view = this.scene.camera.direction.multiplyScalar(-1);
    this.normal = {none: view, level: new Vector3(0, 0, 1), front: new Vector3(0, -1, 0), side: new Vector3(1, 0, 0), view}[kind];
    this.apply();
  }

  /** A place from 0 to 1 through all that is drawn. */
  get place(): number { return this.at; }
  set place(at: number) { this.at = Math.max(0, Math.min(1, at)); this.apply(); }

  /** Over the floor of a storey, in metres from the origin. */
  openStorey(floor: number): void {
    this.kind = 'level';
    this.normal = new Vector3(0, 0, 1);
    const [from, to] = this.range();
    this.at = (floor + kOverFloorM - from) / Math.max(1e-6, to - from);
    this.apply();
  }

  /** The floors of the chosen building's storeys, else of the first one's. */
  storeys(): number[] {
    const {geometry, selection} = this.app.store.value;
    const building = geometry.get(selection?.building ?? -1) ?? geometry.values().next().value;
    return building ? building.storeys_mm.map(mm => mm / 1000) : [];
  }

  private range(): [number, number] {
    const box: Box3 = this.scene.bounds;
    const ends = [0, 1, 2, 3, 4, 5, 6, 7].map(i =>
      new Vector3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z).dot(this.normal));
    return [Math.min(...ends), Math.max(...ends)];
  }

  private apply(): void {
    const [from, to] = this.range();
    this.scene.setCut(this.kind === 'none' ? null : this.normal, from + (to - from) * this.at);
    for (const call of this.onChange) call();
  }
}

export function cutPanel(cut: Cut): HTMLElement {
  const kinds: [CutKind, string][] = [['none', words.cut.none], ['level', words.cut.level], ['front', words.cut.front], ['side', words.cut.side],
    ['view', words.cut.view]];
  const inputs = kinds.map(([kind, label]) => {
    const input = el('input', {type: 'radio', name: 'cut', value: kind, onchange: () => cut.choose(kind)});
    input.checked = kind === 'none';
    cut.onChange.push(() => { input.checked = cut.kind === kind; });
    return el('label', {class: 'choice'}, input, label);
  });
  const slider = el('input', {type: 'range', min: '0', max: '1', step: '0.002', value: '0.5', 'aria-label': words.cut.place, id: 'cut-place',
    oninput: () => { if (cut.kind === 'none') cut.choose('level'); cut.place = Number(slider.value); }});
  cut.onChange.push(() => { if (document.activeElement !== slider) slider.value = String(cut.place); });
  const storeys = el('div', {class: 'storeys'});
  cut.app.store.watch(['geometry', 'selection'], () => {
    const floors = cut.storeys();
    storeys.hidden = floors.length === 0;
    replace(storeys, el('span', {class: 'quiet small'}, words.cut.storeys),
      ...floors.map((floor, i) => el('button', {type: 'button', class: 'button small', 'aria-label': words.cut.storey(i), onclick: () => cut.openStorey(floor)},
        words.cut.storeyShort(i))));
  });
  return el('div', {class: 'popover', hidden: true, role: 'group', 'aria-label': words.scene.section, id: 'cut'}, ...inputs,
    el('label', {class: 'row'}, words.cut.place, slider), storeys);
}
