// The form of the params: a row each, over the same text that the editor shows.
import type {App, Panel} from '../app';
import {el, replace} from '../dom';
import {authorOf} from '../editor/author';
import {words} from '../strings';
import {CurveQueue} from './curve_queue';
import {ParamRow} from './param_row';

class ParamsForm {
  readonly element: HTMLElement;
  private readonly rows = new Map<string, ParamRow>();
  private readonly list = el('div', {class: 'param-list'});
  private readonly filter = el('input', {type: 'search', placeholder: words.params.filter, 'aria-label': words.params.filter, class: 'param-filter'});
  private readonly measure = el('select', {'aria-label': words.params.measure, class: 'param-measure'});
  private readonly empty = el('p', {class: 'empty'}, words.params.empty);
  private readonly curves: CurveQueue;
  private readonly seen: IntersectionObserver;

  constructor(private readonly app: App) {
    const author = authorOf(app);
    const isIdle = () => author.loop.isCurrent && ![...this.rows.values()].some(row => row.isDragging);
    this.curves = new CurveQueue(app, param => this.showCurve(param), isIdle);
    this.seen = new IntersectionObserver(entries => {
      for (const entry of entries) this.curves.want((entry.target as HTMLElement).dataset['param']!, entry.isIntersecting);
    });
    this.filter.addEventListener('input', () => this.applyFilter());
    this.measure.addEventListener('change', () => this.curves.measure(this.measure.value || undefined));
    this.element = el('div', {class: 'panel params'},
      el('div', {class: 'params-head'}, this.filter, el('label', {class: 'measure-label'}, words.params.measureShort, this.measure)), this.list, this.empty);
    author.watch(param => this.curves.outdate(param));
    app.store.watch(['params'], () => this.fill());
    app.store.watch(['classes', 'score', 'has_truth'], () => this.fillMeasures());
  }

  private fill(): void {
    const params = this.app.store.value.params;
    const names = params.map(param => param.name);
    if (names.join('\n') !== [...this.rows.keys()].join('\n')) this.rebuild();
    for (const param of params) this.rows.get(param.name)?.update(param);
    this.empty.hidden = params.length > 0;
    this.filter.hidden = params.length < 8;
  }

  private rebuild(): void {
    const author = authorOf(this.app);
    this.seen.disconnect();
    this.rows.clear();
    for (const param of this.app.store.value.params) {
      this.rows.set(param.name, new ParamRow(param, {
        onValue: (name, text, isFirst) => author.setParam(name, text, isFirst),
        onOpen: line => this.app.openLine(line)
      }));
    }
    replace(this.list, ...[...this.rows.values()].map(row => row.element));
    for (const [name, row] of this.rows) {
      this.seen.observe(row.element);
      this.showCurve(name);
    }
    this.applyFilter();
  }

  private fillMeasures(): void {
    const {score, has_truth} = this.app.store.value;
    const classes = score?.classes.map(entry => entry.name) ?? [];
    (this.measure.parentElement as HTMLElement).hidden = !has_truth;
    const wanted = ['', ...classes];
    if (wanted.join('\n') === [...this.measure.options].map(option => option.value).join('\n')) return;
    const chosen = this.measure.value;
    replace(this.measure, ...wanted.map(name => el('option', {value: name}, name === '' ? words.params.allClasses : name)));
    this.measure.value = wanted.includes(chosen) ? chosen : '';
  }

  private applyFilter(): void {
    const text = this.filter.value.trim().toLowerCase();
    const params = new Map(this.app.store.value.params.map(param => [param.name, param]));
    for (const [name, row] of this.rows) {
      const prose = `${name} ${params.get(name)?.reason ?? ''}`.toLowerCase();
      row.element.hidden = !prose.includes(text);
    }
  }

  private showCurve(name: string): void {
    const kept = this.curves.curveOf(name);
    this.rows.get(name)?.setCurve(kept?.curve ?? null, kept?.isFresh ?? false);
  }
}

export function paramsPanel(app: App): Panel {
  return {id: 'params', title: words.params.title, element: new ParamsForm(app).element};
}
