// The picture of buildings: one canvas. It may be made twice (before and after), see divider.ts.
import type {Part} from '../source';
import type {Selection} from '../store';

/** A building as the scene draws it. The polygons of a generalised one have `feature` as their only owner. */
export interface SceneBuilding {
  number: number;
  vertices_mm: number[];
  /** `surface` says what a polygon without a labelled feature is: WallSurface, RoofSurface … */
  polygons: {rings: number[][]; owners: number[]; surface?: string}[];
  storeys_mm: number[];
}

export class BuildingScene {
  constructor(readonly host: HTMLElement) {}
  /** Draws these buildings instead of those that were drawn. */
  setBuildings(_buildings: SceneBuilding[]): void {}
  /** The class number of a feature (-1 unknown) is asked for again. */
  setLabels(_labels: ReadonlyMap<number, number[]>): void {}
  fly(_selection: Selection | null): void {}
  flyToParts(_parts: Part[]): void {}
  /** Looks from where the other looks, and the other from where this one does. */
  follow(_other: BuildingScene): void {}
  dispose(): void {}
}
