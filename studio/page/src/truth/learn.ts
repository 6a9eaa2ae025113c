// Learning runs in the background; what it proposes is shown as a diff of the pack and changes nothing until it is accepted.
import type {App} from '../app';
import {el, replace} from '../dom';
import {authorOf} from '../editor/author';
import {pause} from '../pause';
import {changeView, proposalView} from '../saving/diff';
import type {LearnAnswer, RuleProposal} from '../source';
import {words} from '../strings';

const kPoll_ms = 400;

export class LearnBox {
  readonly element: HTMLElement;
  private readonly objective = el('select', {'aria-label': words.learn.objective});
  private readonly proposes = el('input', {type: 'checkbox'});
  private readonly start = el('button', {type: 'button', class: 'button button-main', onclick: () => void this.begin()}, words.learn.start);
  private readonly stop = el('button', {type: 'button', class: 'button', hidden: true, onclick: () => void this.end()}, words.learn.stop);
  private readonly bar = el('progress', {hidden: true, 'aria-label': words.learn.progress});
  private readonly told = el('p', {class: 'small', role: 'status'});
  private readonly result = el('div', {class: 'proposal'});
  /** The text that the running search began with: the proposal is compared with it. */
  private asked = '';
  private isStopped = false;
  /** What ends the diffs that are shown. */
  private readonly views: (() => void)[] = [];

  constructor(private readonly app: App) {
    this.element = el('section', {class: 'learn'}, el('h3', {}, words.learn.title), el('p', {class: 'small quiet'}, words.learn.why),
      el('div', {class: 'learn-form'}, el('label', {}, words.learn.objective, this.objective), el('label', {class: 'check'}, this.proposes, words.learn.proposeRules),
        el('div', {class: 'learn-buttons'}, this.start, this.stop)),
      this.bar, this.told, this.result);
    app.store.watch(['score'], () => this.fillObjectives());
  }

  private fillObjectives(): void {
    const classes = this.app.store.value.score?.classes.map(entry => entry.name) ?? [];
    const wanted = ['macro_f1', ...classes];
    if (wanted.join('\n') === [...this.objective.options].map(option => option.value).join('\n')) return;
    const chosen = this.objective.value;
    replace(this.objective, ...wanted.map((value, at) => el('option', {value}, at === 0 ? words.learn.macroF1 : words.learn.f1Of(classes[at - 1]!))));
    this.objective.value = wanted.includes(chosen) ? chosen : 'macro_f1';
  }

  private setRunning(isRunning: boolean): void {
    this.start.disabled = isRunning;
    this.stop.hidden = this.bar.hidden = !isRunning;
  }

  private async begin(): Promise<void> {
    this.clear();
    this.isStopped = false;
    this.asked = authorOf(this.app).text;
    this.setRunning(true);
    this.told.textContent = words.learn.running;
    try {
      let answer = await this.app.source.learn({objective: this.objective.value || 'macro_f1', propose: this.proposes.checked});
      while (answer.state === 'running') {
        this.showProgress(answer);
        await pause(kPoll_ms);
        answer = await this.app.source.learn({});
      }
      if (answer.state === 'idle' && !this.isStopped) this.told.textContent = words.learn.lost;
      else this.show(answer);
    } catch (error) {
      this.told.textContent = error instanceof Error ? error.message : words.source.garbled;
    }
    this.setRunning(false);
  }

  private async end(): Promise<void> {
    this.stop.disabled = true;
    this.isStopped = true;
    await this.app.source.learn({stop: true}).catch(() => undefined);
    this.stop.disabled = false;
  }

  private showProgress(answer: LearnAnswer): void {
    if (answer.all > 0) {
      this.bar.max = answer.all;
      this.bar.value = answer.done;
    } else {
      this.bar.removeAttribute('value');
    }
  }

  private show(answer: LearnAnswer): void {
    const sentences = answer.issues.map(issue => el('li', {class: issue.severity === 'error' ? 'grave' : ''}, issue.sentence));
    const isProposal = answer.state === 'done' && answer.text !== '' && answer.text !== this.asked;
    this.told.textContent = answer.state === 'failed' ? words.learn.failed : answer.state === 'idle' ? words.learn.stopped : isProposal ? words.learn.done : words.learn.nothing;
    replace(this.result,
      answer.summary !== '' ? el('p', {class: 'small'}, answer.summary) : null,
      answer.report ? el('details', {class: 'small'}, el('summary', {}, words.learn.report), el('pre', {class: 'learn-summary'}, answer.report)) : null,
      this.proposalsOf(answer),
      sentences.length > 0 ? el('ul', {class: 'plain small'}, ...sentences) : null);
    if (isProposal) this.showProposal(answer.text);
  }

  /** Changes of rules that would pay: only a person can tell whether they make sense, so that none is made by itself. */
  private proposalsOf(answer: LearnAnswer): HTMLElement | null {
    const list = answer.proposals ?? [];
    if (list.length === 0) return null;
    return el('section', {}, el('h3', {}, words.learn.rules),
      el('ul', {class: 'plain small rule-proposals'}, ...list.map((proposal, index) => this.proposalItem(proposal, index))));
  }

  /** What it says; opened, the diff that it makes, with a button that makes it. */
  private proposalItem(proposal: RuleProposal, index: number): HTMLElement {
    const said = [el('code', {}, proposal.rule), ' ', proposal.what, ' ', el('span', {class: 'quiet number'}, words.learn.gain(proposal.gain, proposal.held_out_gain))];
    if (!proposal.text) return el('li', {}, ...said, proposal.why_not ? el('p', {class: 'quiet'}, proposal.why_not) : null);
    const box = el('details', {}, el('summary', {}, words.learn.showDiff));
    box.addEventListener('toggle', () => {
      if (!box.open || box.childElementCount > 1) return;
      const view = changeView(this.asked, proposal.text!);
      this.views.push(view.destroy);
      box.append(view.element, el('div', {class: 'dialog-buttons'}, el('button', {type: 'button', class: 'button tool',
        onclick: () => void this.acceptRule(proposal.rule, index)}, words.learn.acceptRule)));
    });
    return el('li', {}, ...said, box);
  }

  /** The pack may have been edited since the search, or another change been made: it is made in the text as it stands. */
  private async acceptRule(rule: string, index: number): Promise<void> {
    const author = authorOf(this.app);
    const before = author.text;
    try {
      const {text, why_not} = await this.app.source.acceptProposal(index, before);
      if (text === '' || author.text !== before) this.told.textContent = why_not || words.learn.outdated;
      else {
        author.replaceText(text, 'input.proposal');
        this.told.textContent = words.learn.acceptedRule(rule);
      }
    } catch (error) {
      this.told.textContent = error instanceof Error ? error.message : words.source.garbled;
    }
  }

  private showProposal(text: string): void {
    const view = proposalView(this.asked, text);
    this.views.push(view.destroy);
    const accept = () => {
      const author = authorOf(this.app);
      if (author.text !== this.asked) {
        this.told.textContent = words.learn.outdated;
        return;
      }
      author.replaceText(view.textOf(), 'input.proposal');
      this.clear();
      this.told.textContent = words.learn.accepted;
    };
    this.result.append(view.element, el('div', {class: 'dialog-buttons'},
      el('button', {type: 'button', class: 'button', onclick: () => { this.clear(); this.told.textContent = words.learn.rejected; }}, words.learn.reject),
      el('button', {type: 'button', class: 'button button-main', onclick: accept}, words.learn.accept)));
  }

  private clear(): void {
    for (const destroy of this.views.splice(0)) destroy();
    replace(this.result);
  }
}
