// Writes the pack to the disk, shows what differs from the saved one, and notices when someone else has written the file: then
// both texts are shown, and nothing is overwritten without being asked.
import {format} from '../editor/assistance';
import type {Author} from '../editor/author';
import type {App} from '../app';
import {el, replace} from '../dom';
import {SourceError, type SaveQuestion} from '../source';
import {words} from '../strings';
import {askForPath} from './path_dialog';
import {openConflict} from './conflict_dialog';
import {diffAgainst} from './diff';

const kDiskCheck_ms = 3000;

export class Saving {
  readonly banner = el('div', {class: 'banner', role: 'alert', hidden: true});
  isDiffOpen = false;
  private readonly watchers: (() => void)[] = [];
  private isSaving = false;
  /** The hash of a changed file that the reader has been told about and left as it is. */
  private dismissedHash = '';

  constructor(private readonly app: App, private readonly author: Author) {}

  onChange(call: () => void): void { this.watchers.push(call); }

  /** Writes the pack, in its canonical form if it has no errors. Returns what to tell the reader. */
  async save(): Promise<string> {
    if (this.isSaving) return '';
    this.isSaving = true;
    try {
      const path = await this.pathToWrite();
      if (path === null) return '';
      if (this.app.store.value.is_good) await format(this.author.view, this.app.source).catch(() => false);
      return await this.write(path === '' ? {} : {path});
    } finally {
      this.isSaving = false;
    }
  }

  /** '' for the pack's own file, the path that was typed for one that has none, null if the reader changed their mind. */
  private async pathToWrite(): Promise<string | null> {
    const {pack} = this.app.store.value;
    if (pack.path !== null && pack.is_writable) return '';
    return askForPath(pack.name, pack.path !== null);
  }

  private async write(how: {path?: string; force?: boolean}): Promise<string> {
    const text = this.author.text;
    const question: SaveQuestion = {text, hash: this.author.savedHash, ...how};
    try {
      const answer = await this.app.source.save(question);
      return this.tookOver(text, answer.hash, answer.path);
    } catch (error) {
      if (!(error instanceof SourceError) || error.status !== 409 || typeof error.body['disk_text'] !== 'string') throw error;
      // Asked twice, since the first answer was lost: it is written.
      if (error.body['disk_text'] === text) return this.tookOver(text, String(error.body['disk_hash'] ?? ''), how.path ?? this.app.store.value.pack.path ?? '');
      return this.resolve(error.body['disk_text'], String(error.body['disk_hash'] ?? ''), how);
    }
  }

  private tookOver(text: string, hash: string, path: string): string {
    this.author.saved(text, hash);
    this.app.store.set({pack: {...this.app.store.value.pack, path, hash, text, is_writable: true}});
    this.hideBanner();
    this.showDiff();
    return words.save.done(path);
  }

  /** Both texts side by side; the reader takes one, or makes one of the two. */
  private async resolve(diskText: string, diskHash: string, how: {path?: string}): Promise<string> {
    const choice = await openConflict(diskText, this.author.text);
    if (choice === null) return words.save.notSaved;
    this.author.replaceText(choice.text, 'input.conflict');
    this.author.saved(diskText, diskHash);
    if (choice.text === diskText) {
      this.hideBanner();
      return words.save.taken;
    }
    return this.write(how);
  }

  /** Shows in the text what differs from the saved one, or stops showing it. */
  toggleDiff(): void {
    this.isDiffOpen = !this.isDiffOpen;
    this.showDiff();
  }

  private showDiff(): void {
    this.author.setExtensions(this.isDiffOpen ? diffAgainst(this.author.savedText) : []);
    for (const call of this.watchers) call();
  }

  /** Asks now and then whether the file has been changed by someone else; not while the page is hidden. */
  watchDisk(): void {
    setInterval(() => { if (document.visibilityState === 'visible') void this.checkDisk(); }, kDiskCheck_ms);
    document.addEventListener('visibilitychange', () => { if (document.visibilityState === 'visible') void this.checkDisk(); });
    window.addEventListener('beforeunload', event => { if (this.author.isDirty) event.preventDefault(); });
  }

  private async checkDisk(): Promise<void> {
    if (this.app.store.value.pack.path === null || this.isSaving) return;
    try {
      const disk = await this.app.source.disk();
      if (disk.hash === this.author.savedHash || !disk.is_changed) this.hideBanner();
      else if (disk.hash !== this.dismissedHash && this.banner.hidden) this.showBanner(disk.hash);
    } catch {
      // The loop of the pack tells when the studio is gone.
    }
  }

  private showBanner(hash: string): void {
    const compare = el('button', {type: 'button', class: 'button button-main', onclick: () => void this.compare()}, words.save.compare);
    const leave = el('button', {type: 'button', class: 'button', onclick: () => { this.dismissedHash = hash; this.hideBanner(); }}, words.save.later);
    replace(this.banner, el('p', {}, words.save.changedOnDisk), compare, leave);
    this.banner.hidden = false;
  }

  private hideBanner(): void { this.banner.hidden = true; }

  /** A save with the old hash is refused with the text on the disk: that is how the page learns it. */
  private async compare(): Promise<void> {
    this.isSaving = true;
    try {
      const told = await this.write({});
      if (told !== '') this.app.store.say(told);
    } catch (error) {
      this.app.store.say(error instanceof Error ? error.message : words.save.notSaved, true);
    } finally {
      this.isSaving = false;
    }
  }
}
