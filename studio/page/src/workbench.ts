// The page as a whole: builds the shell with its panels, asks the source for what there is, and keeps the store.
import type {App, Panel} from './app';
import {SourceError, type Feature, type PackInfo, type Part, type Source, type StateAnswer} from './source';
import type {Selection, Store} from './store';
import {el} from './dom';
import {FeatureNames} from './loading/feature_names';
import {ShapeLoader} from './loading/shape_loader';
import {nextPicture, pause} from './pause';
import {PackRunner} from './pack_runner';
import {Shell} from './shell/shell';
import {watchTheme} from './shell/theme';
import {BuildingScene} from './scene/building_scene';
import {bindScene} from './scene/bind_scene';
import {sceneTools} from './scene/scene_tools';
import {legendPanel} from './legend/legend';
import {listPanel} from './list/list';
import {explainPanel} from './explain/explain';
import {searchBox} from './search/search';
import {words} from './strings';

const kPollMs = 400;
/** So long the panels wait for the parts of the first picture, of which they would take the time. */
const kMostWait_ms = 300;

export class Workbench implements App {
  readonly shell: Shell;
  readonly scene: BuildingScene;
  readonly packs: PackRunner;
  partTools?: App['partTools'] & {};
  private lineOpener: ((line: number) => void) | null = null;
  private readonly names: FeatureNames;
  readonly shapes: ShapeLoader;
  private isFollowing = false;
  /** All has come: from now on only the reader moves the picture. */
  private isSettled = false;

  constructor(readonly source: Source, readonly store: Store, title: string) {
    this.names = new FeatureNames(source, store);
    this.packs = new PackRunner(source, store, buildings => this.names.outdate(buildings));
    watchTheme(store);
    const root = document.getElementById('app');
    if (!root) throw new Error('the page has no #app');
    this.shell = new Shell(root, store, title);
    this.scene = new BuildingScene(this.shell.sceneHost);
    this.shapes = new ShapeLoader(this, this.scene);
    if (!this.scene.isDrawing) this.shell.sceneHost.append(el('p', {class: 'no-picture', role: 'alert'}, words.shell.noWebGl));
    bindScene(this.scene, this);
    store.watch(['buildings', 'geometry'], () => this.frame());
    this.shell.sceneHost.append(sceneTools(this, this.scene));
    this.shell.addSearch(searchBox(this));
    this.shell.addLegend(legendPanel(this));
    this.addRight(explainPanel, listPanel);
  }

  addLeft(...makers: ((app: App) => Panel)[]): void { for (const make of makers) this.shell.add('left', make(this)); }
  addRight(...makers: ((app: App) => Panel)[]): void { for (const make of makers) this.shell.add('right', make(this)); }

  async start(): Promise<void> {
    this.shell.settle();
    if (!this.scene.isDrawing) this.open('list');
    this.source.onRestart = () => {
      this.store.say(words.source.back, true);
      void this.followLoading();
    };
    try {
      const {pack} = await this.readState();
      await Promise.all([this.begin(pack), this.packs.run(pack.text, undefined, true)]);
    } catch (error) {
      this.tell(error);
    }
    this.shell.reveal();
    this.openAddress();
    document.documentElement.dataset['ready'] = 'yes';
    await this.followLoading();
  }

  /** First the picture comes, then what is around it, and the pack into the editor. */
  private async begin(pack: PackInfo): Promise<void> {
    const first = this.shapes.first();
    await Promise.race([first, pause(kMostWait_ms)]);
    this.frame();
    await nextPicture();
    this.shell.reveal();
    this.store.set({pack, text: pack.text});
    await first;
    this.frame();
  }

  /** Buildings that come in while the page is open are drawn and labelled. */
  async followLoading(): Promise<void> {
    if (this.isFollowing) return;
    this.isFollowing = true;
    this.isSettled = false;
    let {done, all} = this.store.value.loading;
    for (let isNew = true; isNew || done < all;) {
      if (!isNew) await pause(kPollMs);
      try {
        await this.readState();
        const {loading} = this.store.value;
        if (loading.done !== done) await this.packs.run(this.store.value.text);
        isNew = false;
        ({done, all} = loading);
      } catch (error) {
        this.tell(error);
        await pause(kPollMs);
        if (error instanceof SourceError && error.status === 0) break;
      }
    }
    this.isFollowing = false;
    this.frame();
    this.isSettled = true;
  }

  /** As long as buildings come in, all of them are in the picture, unless the reader looks at something else. */
  private frame(): void {
    const {selection, found, buildings} = this.store.value;
    if (buildings.length > 0 && !this.isSettled && !selection && found.length === 0 && !this.scene.camera.isMoved) this.scene.frame();
  }

  select(selection: Selection | null, fly = false): void {
    const {only} = this.store.value;
    this.store.set({selection, only: selection && only !== null ? selection.building : only, ...(selection ? {} : {found: [], found_title: ''})});
    if (selection?.feature !== undefined || selection?.polygon !== undefined) this.open('explain', true);
    if (fly && selection) void this.need([selection.building]).then(() => this.scene.fly(selection));
  }

  show(parts: Part[], title: string): void {
    this.store.set({found: parts, found_title: title, selection: null, only: null});
    void this.need([...new Set(parts.map(([building]) => building))]).then(() => this.scene.flyToParts(parts));
  }

  need(buildings: number[]): Promise<void> { return this.shapes.need(buildings); }
  feature(building: number, feature: number): Feature | undefined { return this.names.of(building, feature); }

  open(panel: string, onlyIfSeen = false): void { this.shell.open(panel, onlyIfSeen); }
  openLine(line: number): void { this.lineOpener?.(line); }
  onOpenLine(call: (line: number) => void): void { this.lineOpener = call; }

  private async readState(): Promise<StateAnswer> {
    const state = await this.source.state();
    const {buildings, loading} = state;
    this.store.set({
      program: state.program, buildings, loading, has_truth: state.has_truth, issues: state.issues, offers_samples: state.offers_samples ?? false,
      corrections: state.corrections, scales: state.scales, lods: state.lods
    });
    return state;
  }

  /** A feature or building named behind # is chosen. */
  private openAddress(): void {
    const name = decodeURIComponent(location.hash.slice(1));
    if (name) this.shell.search?.(name);
  }

  private tell(error: unknown): void {
    if (error instanceof SourceError && error.isSuperseded) return;
    this.store.say(error instanceof Error ? error.message : words.source.garbled, true);
  }
}
