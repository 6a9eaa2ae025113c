// How well the pack does against the truth: F1, the table of confusions, classes, and rules by what they get wrong.
import type {App, Panel} from '../app';
import {el, replace} from '../dom';
import type {ClassScore, RuleScore, Score} from '../source';
import {words} from '../strings';
import {confusionTable, wrongParts} from './confusion';

const percent = (share: number) => (100 * share).toFixed(1);

function classTable(score: Score): HTMLElement {
  const row = (entry: ClassScore) => el('tr', {}, el('th', {scope: 'row'}, entry.name),
    ...[percent(entry.precision), percent(entry.recall), entry.f1.toFixed(3)].map(text => el('td', {class: 'number'}, text)),
    el('td', {class: 'number quiet'}, words.truth.foundOf(entry.found, entry.found + entry.missed)));
  return el('table', {class: 'score-table'},
    el('thead', {}, el('tr', {}, ...words.truth.classColumns.map(name => el('th', {scope: 'col'}, name)))),
    el('tbody', {}, ...score.classes.map(row)));
}

function ruleRow(app: App, rule: RuleScore): HTMLElement {
  const all = rule.right + rule.wrong;
  const bar = el('span', {class: 'share', 'aria-hidden': 'true'});
  bar.style.setProperty('--share', String(all > 0 ? rule.right / all : 0));
  return el('tr', {},
    el('th', {scope: 'row'}, el('button', {type: 'button', class: 'link', onclick: () => app.openLine(rule.line)}, rule.rule)),
    el('td', {class: 'number'}, String(rule.right)), el('td', {class: 'number'}, String(rule.wrong)),
    el('td', {class: 'number share-cell'}, bar, all > 0 ? percent(rule.right / all) : '–'));
}

function ruleTable(app: App, score: Score): HTMLElement {
  const rules = score.rules.filter(rule => rule.right + rule.wrong > 0)
    .sort((a, b) => b.wrong - a.wrong || b.right - a.right || (a.rule < b.rule ? -1 : 1));
  return el('table', {class: 'score-table'},
    el('thead', {}, el('tr', {}, ...words.truth.ruleColumns.map(name => el('th', {scope: 'col'}, name)))),
    el('tbody', {}, ...rules.map(rule => ruleRow(app, rule))));
}

function fill(app: App, body: HTMLElement, score: Score): void {
  const wrong = wrongParts(score);
  replace(body,
    el('p', {class: 'big-number'}, el('strong', {class: 'number'}, score.macro_f1.toFixed(3)), ' ', words.truth.macroF1),
    wrong.length > 0 ? el('p', {}, el('button', {type: 'button', class: 'link', onclick: () => app.show(wrong, words.truth.wrong(wrong.length))},
      words.truth.showWrong(wrong.length))) : null,
    el('section', {}, el('h3', {}, words.truth.confusion), el('div', {class: 'wide'}, confusionTable(app, score)), el('p', {class: 'small quiet'}, words.truth.cellHint)),
    el('section', {}, el('h3', {}, words.truth.classes), el('div', {class: 'wide'}, classTable(score))),
    el('section', {}, el('h3', {}, words.truth.rules), el('div', {class: 'wide'}, ruleTable(app, score))));
}

export function truthPanel(app: App): Panel {
  const body = el('div', {class: 'truth-body'});
  const empty = el('p', {class: 'empty'}, words.truth.none);
  const overlay = el('input', {type: 'checkbox', onchange: () => app.store.set({shows_truth: overlay.checked})});
  const head = el('label', {class: 'check'}, overlay, words.truth.overlay);
  const element = el('div', {class: 'panel truth'}, empty, head, body);
  let isShown = false;
  let shown: Score | null = null;
  const update = () => {
    const {score, has_truth, shows_truth} = app.store.value;
    empty.hidden = has_truth;
    head.hidden = !has_truth;
    overlay.checked = shows_truth;
    if (!isShown || shown === score) return;
    shown = score;
    if (score) fill(app, body, score);
    else replace(body);
  };
  app.store.watch(['score', 'has_truth', 'shows_truth'], update);
  return {id: 'truth', title: words.truth.title, element, onShow: () => { isShown = true; update(); }};
}
