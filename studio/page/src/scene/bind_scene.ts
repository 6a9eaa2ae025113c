import type {App} from '../app';
import type {BuildingScene} from './building_scene';
export function bindScene(_scene: BuildingScene, _app: App): void {}
