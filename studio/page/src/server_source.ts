// The source of the studio: every verb is a POST to the server that gave the page.
import {
  SourceError, type CorrectQuestion, type LanguageQuestion, type LearnQuestion, type PackQuestion, type SaveQuestion,
  type ScaleQuestion, type Source
} from './source';
import {words} from './strings';

const kAskedAgain = new Set(['state', 'geometry', 'surfaces', 'pack', 'language', 'search', 'truth', 'disk']);

export class ServerSource implements Source {
  readonly can = {edit: true, explain: true, search: true, scale: true, truth: true};

  constructor(private readonly token: string) {}

  private request(verb: string, body: object): Promise<Response> {
    return fetch(`/api/${verb}`, {
      method: 'POST', headers: {'Content-Type': 'application/json', 'X-Oriel-Token': this.token}, body: JSON.stringify(body)
    });
  }

  /** A question that changes nothing is asked again: a worker that ended takes the questions at hand with it, and another follows. */
  private async requestTwice(verb: string, body: object): Promise<Response> {
    try {
      return await this.request(verb, body);
    } catch (error) {
      if (!kAskedAgain.has(verb)) throw error;
      return this.request(verb, body);
    }
  }

  private async post(verb: string, body: object): Promise<any> {
    let response: Response;
    try {
      response = await this.requestTwice(verb, body);
    } catch {
      throw new SourceError(words.source.gone, 0);
    }
    let answer: unknown = null;
    try {
      answer = await response.json();
    } catch {
      if (response.ok) throw new SourceError(words.source.garbled, response.status);
    }
    if (response.ok) return answer;
    const told = (answer ?? {}) as Record<string, unknown>;
    throw new SourceError(typeof told['error'] === 'string' ? told['error'] : words.source.refused(response.status), response.status, told);
  }

  state() { return this.post('state', {}); }
  geometry(buildings: number[]) { return this.post('geometry', {buildings}); }
  surfaces(building: number) { return this.post('surfaces', {building}); }
  pack(question: PackQuestion) { return this.post('pack', question); }
  explain(building: number, feature: number, quick = false) { return this.post('explain', {building, feature, quick}); }
  language(question: LanguageQuestion) { return this.post('language', question); }
  curve(param: string, ofClass?: string) { return this.post('curve', ofClass === undefined ? {param} : {param, class: ofClass}); }
  search(text: string) { return this.post('search', {text}); }
  correct(question: CorrectQuestion) { return this.post('correct', question); }
  corrections() { return this.post('corrections', {}); }
  ask(count: number) { return this.post('ask', {count}); }
  learn(question: LearnQuestion) { return this.post('learn', question); }
  scale(question: ScaleQuestion) { return this.post('scale', question); }
  save(question: SaveQuestion) { return this.post('save', question); }
  disk() { return this.post('disk', {}); }
  truth(buildings: number[]) { return this.post('truth', {buildings}); }
}
