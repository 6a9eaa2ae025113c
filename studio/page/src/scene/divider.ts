// A second picture over the first, cut off at a line that is dragged or moved by arrow keys: before at its left, after at its right.
import type {App} from '../app';
import {BuildingScene} from './building_scene';

export class Divider {
  /** The picture at the right of the line; give it buildings by `setBuildings`. */
  readonly after: BuildingScene;

  constructor(app: App) { this.after = new BuildingScene(app.scene.host); }
  /** Shows or hides the second picture and the line. */
  set isShown(_isShown: boolean) {}
}
