// The one editor of the page and what other panels do to its text: a slider sets a param, a proposal replaces the pack, an
// entry of the outline moves the cursor.
import {isolateHistory} from '@codemirror/commands';
import {Compartment, EditorState, type Extension} from '@codemirror/state';
import {EditorView} from '@codemirror/view';

import type {App} from '../app';
import {withNonce} from './editor_setup';
import {PackLoop} from './pack_loop';
import {changeOfParam} from './pack_text';
import {offsetOf, smallestChange} from './text_places';

export class Author {
  readonly loop: PackLoop;
  readonly view: EditorView;
  /** What the disk had when the pack was last read or written. */
  savedText = '';
  savedHash = '';
  private readonly watchers: ((param: string | null) => void)[] = [];
  private readonly settings = new Compartment();
  /** The param whose slider is changing the text just now. */
  private param: string | null = null;

  constructor(readonly app: App) {
    this.loop = new PackLoop(app);
    this.view = new EditorView({extensions: withNonce()});
    app.onOpenLine(line => this.openLine(line));
  }

  /** Fills the editor for the first time; undo does not go behind it. */
  begin(text: string, hash: string, extensions: Extension): void {
    this.savedText = text;
    this.savedHash = hash;
    this.loop.adopt(text);
    const told = EditorView.updateListener.of(update => {
      if (!update.docChanged) return;
      this.loop.change(update.state.doc.toString());
      this.tell();
    });
    this.view.setState(EditorState.create({doc: text, extensions: [extensions, this.settings.of([]), told]}));
    this.tell();
  }

  get text(): string { return this.view.state.doc.toString(); }
  get isDirty(): boolean { return this.text !== this.savedText; }

  /** Calls `call` now and whenever the text, or what is saved, has changed; with the param if a slider has changed only its value. */
  watch(call: (param: string | null) => void): void {
    this.watchers.push(call);
    call(null);
  }

  /** Says that the disk has this text now. */
  saved(text: string, hash: string): void {
    this.savedText = text;
    this.savedHash = hash;
    this.tell();
  }

  /** Extensions that come and go, as the diff in the editor. */
  setExtensions(extensions: Extension): void {
    this.view.dispatch({effects: this.settings.reconfigure(extensions)});
  }

  /**
   * Writes the value of a param into the text and asks at once. `isFirst` begins a new step of undo; the moves that follow belong
   * to it, so that one drag is undone at once.
   */
  setParam(name: string, value: string, isFirst: boolean): void {
    const text = this.text;
    const change = changeOfParam(text, name, value);
    if (text.slice(change.from, change.to) === change.insert) return;
    this.param = name;
    this.view.dispatch(isFirst
      ? {changes: change, userEvent: 'input.param', annotations: isolateHistory.of('before')}
      : {changes: change, userEvent: 'input.type.compose'});
    this.param = null;
  }

  /** Makes the text `text`, as one step of undo. */
  replaceText(text: string, userEvent = 'input.replace'): void {
    const change = smallestChange(this.text, text);
    if (change) this.view.dispatch({changes: change, userEvent, annotations: isolateHistory.of('full')});
  }

  openLine(line: number): void {
    this.app.open('editor');
    const doc = this.view.state.doc;
    const from = offsetOf(doc, {line, column: 1});
    const indent = /^\s*/.exec(doc.lineAt(from).text)?.[0].length ?? 0;
    this.view.dispatch({
      selection: {anchor: from + indent}, userEvent: 'select.line', effects: EditorView.scrollIntoView(from, {y: 'center'})
    });
    this.view.focus();
  }

  private tell(): void {
    for (const call of this.watchers) call(this.param);
  }
}

const kAuthors = new WeakMap<App, Author>();

/** The author of a page; the first who asks makes it. */
export function authorOf(app: App): Author {
  let author = kAuthors.get(app);
  if (!author) kAuthors.set(app, author = new Author(app));
  return author;
}
