// The source of the studio: every verb is a POST to the server that gave the page.
import {pause} from './pause';
import {shapesOfBytes} from './scene/shape';
import {
  SourceError, type CorrectQuestion, type LanguageQuestion, type LearnQuestion, type PackQuestion, type SaveQuestion,
  type ScaleQuestion, type Source
} from './source';
import {words} from './strings';

/** Questions that change nothing, or change the same when they are asked twice. A search for params is not among them, nor what may
    take a minute: who asked for it decides whether to ask again. */
const kAskedAgain = new Set(['state', 'geometry', 'features', 'surfaces', 'pack', 'language', 'search', 'truth', 'disk', 'corrections', 'ask', 'curve',
  'save', 'correct']);
const kPause_ms = 300;
const kMostTries = 10;
/** A worker that was started again reads the buildings first. */
const kMostWait_ms = 60_000;

export class ServerSource implements Source {
  readonly can = {edit: true, explain: true, search: true, scale: true, truth: true};
  onRestart: (() => void) | null = null;
  private restart: Promise<boolean> | null = null;

  /** `firstState`: the answer to the first question for the state, which the page has asked already. */
  constructor(private readonly token: string, private firstState?: Promise<Response>) {}

  private request(verb: string, body: object, signal: AbortSignal | null = null): Promise<Response> {
    const asked = verb === 'state' ? this.firstState : undefined;
    if (asked) this.firstState = undefined;
    return asked ?? fetch(`/api/${verb}`, {
      method: 'POST', headers: {'Content-Type': 'application/json', 'X-Oriel-Token': this.token}, body: JSON.stringify(body), signal
    });
  }

  /** A worker that ends takes the questions at hand with it, and another follows: what is safe is asked again. */
  private async requestTwice(verb: string, body: object, signal: AbortSignal | null): Promise<Response> {
    try {
      return await this.request(verb, body, signal);
    } catch (error) {
      if (signal?.aborted) throw error;
    }
    if (!await this.hasRestarted()) throw new SourceError(words.source.gone, 0);
    const again = kAskedAgain.has(verb) ? await this.request(verb, body, signal).catch(() => null) : null;
    if (!again) throw new SourceError(words.source.restarted(verb), 0);
    return again;
  }

  /** True once a new worker answers; false if the program has ended. Questions that fail together wait for the same answer. */
  private hasRestarted(): Promise<boolean> {
    this.restart ??= this.waitForWorker().finally(() => { this.restart = null; });
    return this.restart;
  }

  private async waitForWorker(): Promise<boolean> {
    for (let i = 0; i < kMostTries; ++i) {
      if (i > 0) await pause(kPause_ms);
      const response = await this.request('state', {}).catch(() => null);
      if (!response) continue;
      void response.body?.cancel();
      this.onRestart?.();
      return true;
    }
    return false;
  }

  private async answerOf(verb: string, body: object, signal: AbortSignal | null): Promise<Response> {
    const response = await this.requestTwice(verb, body, signal);
    if (response.ok) return response;
    const told = (await response.json().catch(() => null) ?? {}) as Record<string, unknown>;
    throw new SourceError(typeof told['error'] === 'string' ? told['error'] : words.source.refused(response.status), response.status, told);
  }

  private async post(verb: string, body: object, signal: AbortSignal | null = null): Promise<any> {
    const response = await this.answerOf(verb, body, signal);
    try {
      return await response.json();
    } catch (error) {
      if (signal?.aborted) throw error;
      throw new SourceError(words.source.garbled, response.status);
    }
  }

  /** A correction of a building that a new worker has not read yet waits for it. */
  async correct(question: CorrectQuestion): Promise<{count: number}> {
    for (const end = Date.now() + kMostWait_ms;;) {
      try {
        return await this.post('correct', question);
      } catch (error) {
        const isUnread = error instanceof SourceError && error.status === 409 && (await this.state()).buildings[question.building]?.is_loaded !== true;
        if (!isUnread || Date.now() > end) throw error;
        await pause(kPause_ms);
      }
    }
  }

  async geometry(buildings: number[]) { return shapesOfBytes(await (await this.answerOf('geometry', {buildings}, null)).arrayBuffer()); }
  state() { return this.post('state', {}); }
  features(buildings: number[]) { return this.post('features', {buildings}); }
  surfaces(building: number) { return this.post('surfaces', {building}); }
  pack(question: PackQuestion) { return this.post('pack', question); }
  explain(building: number, feature: number, quick = false, signal: AbortSignal | null = null) {
    return this.post('explain', {building, feature, quick}, signal);
  }
  language(question: LanguageQuestion) { return this.post('language', question); }
  curve(param: string, ofClass?: string) { return this.post('curve', ofClass === undefined ? {param} : {param, class: ofClass}); }
  search(text: string) { return this.post('search', {text}); }
  corrections() { return this.post('corrections', {}); }
  ask(count: number) { return this.post('ask', {count}); }
  learn(question: LearnQuestion) { return this.post('learn', question); }
  scale(question: ScaleQuestion, signal: AbortSignal | null = null) { return this.post('scale', question, signal); }
  scaleProgress() { return this.post('scale', {progress: true}); }
  stopScale() { return this.post('scale', {stop: true}); }
  acceptProposal(index: number, text: string) { return this.post('learn', {accept: index, text}); }
  save(question: SaveQuestion) { return this.post('save', question); }
  openSamples() { return this.post('samples', {}); }
  disk() { return this.post('disk', {}); }
  truth(buildings: number[]) { return this.post('truth', {buildings}); }
}
