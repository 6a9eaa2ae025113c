// What every panel is given, and what a panel is.
import type {PackRunner} from './pack_runner';
import type {BuildingScene} from './scene/building_scene';
import type {ExplainAnswer, Feature, Part, Source} from './source';
import type {Selection, Store} from './store';

export interface Panel {
  /** One word, for the address and for tests: `data-panel`. */
  id: string;
  title: string;
  element: HTMLElement;
  /** Called when its tab comes to the front. */
  onShow?(): void;
}

/** What panels do beside watching the store. */
export interface App {
  source: Source;
  store: Store;
  /** Runs a text of the pack and puts the answer into the store. The editor and the sliders of params call it. */
  packs: PackRunner;
  /** The picture of the buildings as they are; divider.ts lays a second one over it. */
  scene: BuildingScene;
  /** Chooses something, and brings it into view with `fly`. */
  select(selection: Selection | null, fly?: boolean): void;
  /** Marks several parts and brings them into view; `title` says what they are. */
  show(parts: Part[], title: string): void;
  /** Loads the geometry of buildings before that of all others. */
  need(buildings: number[]): Promise<void>;
  /** Id, name and kind of a feature. Undefined until they have come: watch `features` of the store. */
  feature(building: number, feature: number): Feature | undefined;
  /** Brings a panel to the front. */
  open(panel: string): void;
  /** Puts the cursor of the editor on a line of the pack; nothing in a page without editor. */
  openLine(line: number): void;
  /** The editor says here how that is done. */
  onOpenLine(call: (line: number) => void): void;
  /** What an author can do about an explained part: correct it, set the param that would flip it. Only the studio has it. */
  partTools?: (part: Part, answer: ExplainAnswer | null) => HTMLElement;
}
