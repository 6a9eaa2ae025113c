// What is chosen, in words: one plain sentence, then why, why not something else, what would change it, and how it lies to others.
import type {App, Panel} from '../app';
import {el, replace} from '../dom';
import {pause} from '../pause';
import {looksOf, patchStyle} from '../scene/palette';
import {ownersOf as ownersOfPolygon} from '../scene/shape';
import {SourceError, type AttributeEntry, type ConditionRow, type ExplainAnswer, type NearestMiss, type Part, type RelationEntry, type RuleReason} from '../source';
import {labelOf, nameOf, type Selection} from '../store';
import {words} from '../strings';
import {isCode, missesOf, plainWords, surfaceReason} from './plain_words';

class Explanation {
  readonly element = el('div', {class: 'panel explain'});
  private readonly head = el('div', {class: 'explain-head'});
  private readonly body = el('div', {class: 'explain-body', 'aria-live': 'polite'});
  private shown = '';
  private shownNames: unknown;
  /** Ends what is still asked about the part that was chosen before. */
  private asking = new AbortController();
  /** What is said of the chosen part: made anew when names come. */
  private content: () => HTMLElement[] = () => [];

  constructor(private readonly app: App) {
    this.element.append(this.head, this.body);
    app.store.watch(['selection', 'version', 'found', 'found_title', 'geometry', 'features', 'labels'], () => void this.show());
  }

  private async show(): Promise<void> {
    const {selection, found, found_title, version, geometry, features} = this.app.store.value;
    const key = JSON.stringify([selection, version, selection ? geometry.has(selection.building) : 0, found.length, found_title]);
    const names = selection ? features.get(selection.building) : features;
    if (key === this.shown && names === this.shownNames) return;
    const isOther = key !== this.shown;
    this.shown = key;
    this.shownNames = names;
    replace(this.head, ...headOf(this.app, selection));
    if (!isOther) return this.draw();
    this.asking.abort();
    const {signal} = this.asking = new AbortController();
    if (!selection) {
      this.content = () => (found.length > 0 ? foundList(this.app, found, found_title) : [el('p', {class: 'quiet'}, words.explain.nothing)]);
      return this.draw();
    }
    try {
      const content = await contentOf(this.app, selection, signal);
      if (signal.aborted) return;
      this.content = content;
      this.draw();
      if (selection.feature !== undefined && this.app.source.can.edit) await this.addFlip([selection.building, selection.feature], signal);
    } catch (error) {
      if (signal.aborted) return;
      this.content = () => [el('p', {class: 'grave'}, error instanceof Error ? error.message : words.source.garbled)];
      this.draw();
    }
  }

  /** What would change the label takes time to find: it is searched for where somebody stays. */
  private async addFlip(part: Part, signal: AbortSignal): Promise<void> {
    await pause(kFlipPause_ms);
    if (signal.aborted) return;
    const without = this.content;
    const put = (...children: HTMLElement[]) => {
      const place = this.body.querySelector<HTMLElement>('#flip-place');
      if (place) replace(place, ...children);
    };
    const slow = setTimeout(() => put(...toolsContent(this.app, part, null), el('p', {class: 'quiet small is-working', id: 'flip-search'}, words.explain.flipSearch)), kFlipSlow_ms);
    const told = await this.app.source.explain(...part, false, signal).catch((error: unknown) => error).finally(() => clearTimeout(slow));
    if (signal.aborted || this.content !== without) return;
    if (told instanceof SourceError && told.isSuperseded) return put(...toolsContent(this.app, part, null));
    const flip = () => (told instanceof Error ? [...toolsContent(this.app, part, null), el('p', {class: 'grave small'}, told.message)] :
      flipContent(this.app, part, told as ExplainAnswer));
    this.content = () => {
      const elements = without();
      const place = elements.find(({id}) => id === 'flip-place');
      if (place) replace(place, ...flip());
      return elements;
    };
    put(...flip());
  }

  private draw(): void { replace(this.body, ...this.content()); }
}

const kFlipPause_ms = 300;
const kFlipSlow_ms = 700;

export function explainPanel(app: App): Panel { return {id: 'explain', title: words.explain.title, element: new Explanation(app).element}; }

function flipContent(app: App, part: Part, answer: ExplainAnswer): HTMLElement[] {
  const note = answer.flip ? [el('p', {class: 'note', id: 'flip'}, answer.flip.sentence, ' ', lineLink(app, answer.flip.line))] : [];
  return [...note, ...toolsContent(app, part, answer)];
}

function toolsContent(app: App, part: Part, answer: ExplainAnswer | null): HTMLElement[] {
  const tools = app.partTools?.(part, answer);
  return tools ? [tools] : [];
}

async function contentOf(app: App, selection: Selection, signal: AbortSignal): Promise<() => HTMLElement[]> {
  const {building, feature, polygon} = selection;
  if (feature !== undefined) {
    const answer = await app.source.explain(building, feature, true, signal);
    return () => featureContent(app, [building, feature], answer);
  }
  if (polygon !== undefined) {
    const {types, why} = await app.source.surfaces(building);
    return () => surfaceContent(types[polygon] ?? '', why[polygon] ?? '');
  }
  return () => buildingContent(app, building);
}

// ---- above: what lies in what ----

function headOf(app: App, selection: Selection | null): HTMLElement[] {
  if (!selection) return [];
  const {classes} = app.store.value;
  const {building, polygon, feature} = selection;
  const name = (f: number) => classes[labelOf(app.store.value, building, f)]?.name ?? app.feature(building, f)?.kind ?? words.scene.unknown;
  const crumb = (text: string, chosen: Selection, isCurrent: boolean) => el('button', {type: 'button', class: 'crumb', 'aria-pressed': String(isCurrent),
    onclick: () => app.select(chosen)}, text);
  const owners = ownersOf(app, selection);
  return [el('nav', {class: 'crumbs', 'aria-label': words.explain.liesIn},
    crumb(nameOf(app.store.value, building), {building}, feature === undefined && polygon === undefined),
    ...(polygon === undefined ? [] : [crumb(words.explain.surface, {building, polygon}, feature === undefined)]),
    ...owners.map(f => crumb(name(f), polygon === undefined ? {building, feature: f} : {building, polygon, feature: f}, f === feature)))];
}

/** The features around the chosen one, the largest first. */
function ownersOf(app: App, {building, polygon, feature}: Selection): number[] {
  const shape = app.store.value.geometry.get(building);
  if (polygon !== undefined) return shape ? ownersOfPolygon(shape, polygon).reverse() : [];
  if (feature === undefined) return [];
  const chain: number[] = [];
  for (let f = feature; f >= 0 && chain.length < 8 && !chain.includes(f); f = app.feature(building, f)?.parent ?? -1) chain.unshift(f);
  return chain;
}

// ---- a feature ----

function featureContent(app: App, [building, feature]: Part, answer: ExplainAnswer): HTMLElement[] {
  const {classes} = app.store.value;
  const label = answer.label ?? words.scene.unknown;
  const number = classes.findIndex(({name}) => name === answer.label);
  const look = number >= 0 ? looksOf(classes, app.store.value.colours === 'pattern')[number]! : null;
  const about = app.feature(building, feature);
  const [first, ...rest] = splitSentence(answer.sentence, label);
  const content: (HTMLElement | null)[] = [
    el('h2', {id: 'chosen', class: 'verdict'}, look ? el('span', {class: 'patch', style: patchStyle(look)}) : null, el('span', {}, first!)),
    el('p', {class: 'sentence', id: 'sentence'}, rest.join('')),
    about ? el('p', {class: 'quiet small', id: 'name'}, about.name) : null,
    answer.correction ? el('p', {class: 'note'}, words.explain.corrected(answer.correction.class)) : null,
    el('div', {id: 'flip-place'}, ...flipContent(app, [building, feature], answer)),
    section(words.explain.why, 'why', answer.why.filter(isReason).map(rule => ruleElement(app, rule, rule.rule === answer.rule)), words.explain.noRule),
    section(words.explain.whyNot, 'whynot', [...missElements(app, answer.why_not), othersElement(app, answer.why.filter(rule => !isReason(rule)))]),
    section(words.explain.relations, 'relations', answer.relations.filter(r => r.features.length > 0).map(r => relationElement(app, building, r))),
    attributesElement(answer.attributes),
    !app.source.can.edit ? el('p', {class: 'quiet small', id: 'head'}, answer.head) : null,
    about ? el('p', {class: 'quiet small', id: 'id'}, words.explain.id, ' ', el('code', {}, about.id)) : null
  ];
  return content.filter((child): child is HTMLElement => child !== null);
}

/** The rules that do not hold, each with its first obstacle; they stay folded. */
function othersElement(app: App, rules: RuleReason[]): HTMLElement {
  const box = el('details', {class: 'others', hidden: rules.length === 0}, el('summary', {}, words.explain.others(rules.length)));
  const list = el('div', {});
  box.append(list);
  box.addEventListener('toggle', () => { if (box.open) replace(list, ...rules.map(rule => ruleElement(app, rule, false))); });
  return box;
}

/** "window: a 1.1 × 1.4 m hole …" as the label and what is said of it. */
function splitSentence(sentence: string, label: string): string[] {
  const colon = sentence.indexOf(': ');
  if (colon < 0 || sentence.slice(0, colon) !== label) return [label, sentence];
  const rest = sentence.slice(colon + 2);
  return [label, rest.charAt(0).toUpperCase() + rest.slice(1) + (rest.endsWith('.') ? '' : '.')];
}

const isReason = (rule: RuleReason) => rule.holds === true;

function section(title: string, id: string, children: HTMLElement[], empty = ''): HTMLElement | null {
  if (children.length === 0 && !empty) return null;
  return el('section', {class: 'part', 'aria-labelledby': `title-${id}`}, el('h3', {id: `title-${id}`}, title),
    el('div', {id}, ...(children.length > 0 ? children : [el('p', {class: 'quiet'}, empty)])));
}

function lineLink(app: App, line: number | null): HTMLElement | null {
  if (!line) return null;
  return el('button', {type: 'button', class: 'link small', 'data-line': line, onclick: () => app.openLine(line)}, words.explain.line(line));
}

function ruleElement(app: App, rule: RuleReason, isOpen: boolean): HTMLElement {
  const obstacle = rule.holds === true ? null : rule.conditions.find(({holds}) => holds !== true);
  return el('details', {class: 'rule', open: isOpen, 'data-rule': rule.rule}, el('summary', {},
    el('span', {class: `rule-state ${kindOf(rule.holds)}`}, saidOf(rule.holds)),
    el('code', {}, rule.rule), rule.label ? ` → ${rule.label}` : '',
    obstacle ? el('span', {class: 'obstacle quiet'}, plainWords(obstacle.found || obstacle.text)) : null),
    el('ul', {class: 'conditions'}, ...rule.conditions.map(conditionElement)),
    app.source.can.edit ? lineLink(app, rule.line) : el('span', {class: 'quiet small'}, rule.place));
}

const kindOf = (holds: boolean | null) => (holds === null ? 'open' : holds ? 'good' : 'grave');
const saidOf = (holds: boolean | null) => (holds === null ? words.explain.isOpen : holds ? words.explain.holds : words.explain.fails);

/** What was found first, then what was asked; the pack's own words where nothing was found. */
function conditionElement(condition: ConditionRow): HTMLElement {
  const {holds, found, asked, text, depth, missed_by, without_value, score} = condition;
  const isTerm = score !== undefined;
  const kind = isTerm ? 'term' : kindOf(holds);
  const main = found || text;
  const more = [asked, missed_by, ...(without_value ?? []).map(words.explain.missing), typeof score === 'number' ? words.explain.scores(score) : ''].filter((part): part is string => Boolean(part));
  return el('li', {class: `condition is-${kind}`, style: {'--depth': String(depth)}, title: text, 'data-found': found},
    el('span', {class: 'mark', role: 'img', 'aria-label': isTerm ? words.explain.scores(score ?? 0) : saidOf(holds)}, {open: '?', good: '✓', grave: '✗', term: '·'}[kind]),
    el(isCode(plainWords(main)) ? 'code' : 'span', {class: 'found'}, plainWords(main)),
    more.length > 0 ? el('span', {class: 'asked quiet'}, more.map(plainWords).join(', ')) : null);
}

const kMisses = 4, kReasons = 2;

/** The labels that come nearest; those farther away stay folded. */
function missElements(app: App, misses: NearestMiss[]): HTMLElement[] {
  const far = misses.slice(kMisses);
  const box = el('details', {class: 'others', hidden: far.length === 0}, el('summary', {}, words.explain.otherLabels(far.length)),
    el('div', {}, ...far.map(miss => missElement(app, miss))));
  return [...misses.slice(0, kMisses).map(miss => missElement(app, miss)), box];
}

function missElement(app: App, miss: NearestMiss): HTMLElement {
  const reasons = missesOf(miss.sentence);
  const more = reasons.length - kReasons;
  return el('div', {class: 'miss', title: reasons.join('\n')}, el('p', {}, el('strong', {}, miss.label), ' ', el('code', {class: 'quiet'}, miss.rule), ' ', lineLink(app, miss.line)),
    el('ul', {class: 'reasons'}, ...reasons.slice(0, kReasons).map(reason => el('li', {}, reason)),
      more > 0 ? el('li', {class: 'quiet'}, words.explain.andMore(more)) : null));
}

function relationElement(app: App, building: number, relation: RelationEntry): HTMLElement {
  const {classes} = app.store.value;
  const kShown = 12;
  const name = (f: number) => classes[labelOf(app.store.value, building, f)]?.name ?? app.feature(building, f)?.kind ?? words.scene.unknown;
  const only = () => app.store.set({relation: app.store.value.relation === relation.name ? null : relation.name, shows_relations: true});
  const button = el('button', {type: 'button', class: 'relation-name', title: relation.meaning ?? words.explain.onlyRelation, onclick: only}, relation.name.replaceAll('_', ' '));
  button.setAttribute('aria-pressed', String(app.store.value.relation === relation.name));
  button.addEventListener('click', () => queueMicrotask(() => button.setAttribute('aria-pressed', String(app.store.value.relation === relation.name))));
  return el('div', {class: 'relation'}, button, el('span', {class: 'relation-ends'},
    ...relation.features.slice(0, kShown).map(f => el('button', {type: 'button', class: 'link small', onclick: () => app.select({building, feature: f}),
      onpointerenter: () => app.store.set({hover: {building, feature: f}}), onpointerleave: () => app.store.set({hover: null})}, name(f))),
    relation.features.length > kShown ? el('span', {class: 'quiet small'}, words.explain.more(relation.features.length - kShown)) : null));
}

function attributesElement(attributes: AttributeEntry[]): HTMLElement | null {
  if (attributes.length === 0) return null;
  return el('details', {class: 'part attributes'}, el('summary', {}, words.explain.attributes(attributes.length)),
    el('table', {}, ...attributes.map(a => el('tr', {title: a.meaning}, el('th', {scope: 'row'}, a.name),
      el('td', {class: 'number'}, a.unit && !a.value.endsWith(a.unit) ? `${a.value} ${a.unit}` : a.value)))));
}

// ---- a surface, a building, several parts ----

function surfaceContent(type: string, why: string): HTMLElement[] {
  const reason = surfaceReason(why);
  const isRuled = reason.rule !== '';
  return [
    el('h2', {id: 'chosen'}, words.explain.surfaceName(type)),
    el('p', {class: 'why-line'}, isRuled ? words.explain.bySurfaceRule(reason.rule) : why),
    ...(isRuled ? [
      el('section', {class: 'part'}, el('h3', {}, words.explain.measures), el('table', {class: 'counts'}, ...reason.measures.map(({name, value, meaning}) =>
        el('tr', {title: meaning}, el('th', {scope: 'row'}, name), el('td', {class: 'number'}, value))))),
      el('section', {class: 'part'}, el('h3', {}, words.explain.rules), el('ul', {class: 'conditions'}, ...reason.rules.map(({rule, holds, text}) =>
        el('li', {class: `condition is-${kindOf(holds)}`}, el('span', {class: 'mark', role: 'img', 'aria-label': saidOf(holds)}, holds ? '✓' : '✗'),
          el('code', {class: 'found'}, rule), el('span', {class: 'asked quiet'}, text)))))
    ] : [])
  ];
}

function buildingContent(app: App, building: number): HTMLElement[] {
  const {buildings, labels, classes} = app.store.value;
  const entry = buildings[building];
  if (!entry) return [];
  const counts = new Map<number, number>();
  for (const label of labels.get(building) ?? []) counts.set(label, (counts.get(label) ?? 0) + 1);
  const rows = [...counts].sort((a, b) => b[1] - a[1]);
  const [width, depth, height] = entry.size_m;
  return [
    el('h2', {id: 'chosen'}, entry.id),
    el('p', {class: 'sentence'}, words.explain.building(width, depth, height, entry.features)),
    el('table', {class: 'counts'}, ...rows.map(([label, count]) => el('tr', {}, el('th', {scope: 'row'}, classes[label]?.name ?? words.scene.unknown),
      el('td', {class: 'number'}, count.toLocaleString('en'))))),
    ...entry.issues.map(issue => el('p', {class: `issue is-${issue.severity}`}, issue.sentence, ' ', el('code', {class: 'quiet'}, issue.code))),
    el('p', {class: 'quiet small'}, entry.file)
  ];
}

function foundList(app: App, parts: Part[], title: string): HTMLElement[] {
  const {classes, buildings} = app.store.value;
  const kShown = 200;
  return [
    el('h2', {id: 'chosen'}, title), el('p', {class: 'quiet'}, words.explain.found(parts.length)),
    el('ul', {class: 'found-list'}, ...parts.slice(0, kShown).map(([building, feature]) => el('li', {}, el('button', {type: 'button', class: 'link',
      onclick: () => app.select({building, feature}, true)}, classes[labelOf(app.store.value, building, feature)]?.name ?? words.scene.unknown),
      ' ', el('span', {class: 'quiet small'}, app.feature(building, feature)?.name ?? '', buildings.length > 1 ? ` · ${nameOf(app.store.value, building)}` : '')))),
    ...(parts.length > kShown ? [el('p', {class: 'quiet small'}, words.explain.more(parts.length - kShown))] : [])
  ];
}
