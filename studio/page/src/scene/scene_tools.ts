import type {App} from '../app';
import {el} from '../dom';
import type {BuildingScene} from './building_scene';
export function sceneTools(_app: App, _scene: BuildingScene): HTMLElement { return el('div', {class: 'scene-tools'}); }
