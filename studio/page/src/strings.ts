// All words of the page, grouped by the room that says them. Translate this file and nothing else. What comes from the engine
// (sentences of findings, of explanations) is not here.
const count = (n: number, one: string, many: string) => `${n.toLocaleString('en')} ${n === 1 ? one : many}`;

export const words = {
  source: {
    gone: 'The studio does not answer. Is the program still running?',
    garbled: 'The studio gave an answer that the page does not understand.',
    refused: (status: number) => `The studio refused (${status}).`,
    lacks: 'This page is a file: the studio (oriel studio) can do that.'
  },
  shell: {
    title: 'oriel studio',
    viewTitle: 'oriel view',
    skip: 'Skip to the building',
    left: 'Rules', right: 'What there is',
    panels: 'Panels',
    close: 'Close', open: 'Open',
    divider: 'Width of the rules', sheet: 'Height of the panel',
    loading: (done: number, all: number) => `${done.toLocaleString('en')} of ${count(all, 'building', 'buildings')}`,
    keep: 'The pack has errors. You see the labels of the last good version.',
    unknown: (n: number) => `${n.toLocaleString('en')} unknown`,
    features: (n: number) => count(n, 'feature', 'features'),
    ms: (n: number) => `${n < 10 ? n.toFixed(1) : Math.round(n)} ms`,
    f1: (f: number) => `F1 ${f.toFixed(3)}`,
    theme: 'Dark or light', help: 'Keys',
    noWebGl: 'This browser draws no 3D (WebGL 2 is missing). Lists, search and explanations work.'
  },
  keys: [
    ['← → ↑ ↓', 'turn the building (in its picture)'],
    ['⇧ ← →', 'move it'],
    ['+ −', 'zoom'],
    ['F', 'see everything, or what is chosen'],
    ['1 2 3', 'from the front, from the side, from above'],
    ['H', 'hidden lines'],
    ['X', 'cut'],
    ['M', 'measure'],
    ['N ⇧N', 'next and previous unknown part'],
    ['D', 'next doubtful part'],
    ['W', 'next wrong part'],
    ['/', 'search'],
    ['Esc', 'forget what is chosen'],
    ['?', 'this list']
  ] as [string, string][],
  scene: {
    name: 'The buildings in 3D. Arrow keys turn, with shift they move, plus and minus zoom, N goes to the next unknown part.',
    tools: 'Tools of the picture', fit: 'See everything', hiddenLines: 'Hidden lines', section: 'Cut', measure: 'Measure', relations: 'Relations',
    changes: 'What changed', truth: 'Truth', colours: 'Colours', colour: 'Colours', pattern: 'Patterns', heat: 'Heat map', heatOf: 'Heat map of',
    heatKinds: {unknown: 'unknown parts', doubtful: 'doubtful parts', wrong: 'wrong parts', changed: 'changed parts'},
    unknown: 'unknown', measureHint: 'Click two points. Corners attract; Esc ends it.',
    distance: (all: number, level: number, up: number) =>
      up < 0.005 || level < 0.005 ? `${all.toFixed(2)} m` : `${all.toFixed(2)} m  (${level.toFixed(2)} level, ${up.toFixed(2)} up)`
  },
  cut: {
    none: 'Whole', level: 'Level', front: 'Along the front', side: 'Along the side', view: 'As seen now', place: 'Where', storeys: 'Storeys',
    storey: (i: number) => (i === 0 ? 'open the ground floor' : `open storey ${i}`), storeyShort: (i: number) => (i === 0 ? 'G' : String(i))
  },
  divider: {before: 'before', after: 'after', name: 'Line between before and after'},
  legend: {
    title: 'Legend', unknown: 'unknown', surfaces: 'walls and roofs', all: 'Show all', only: 'only', show: 'Show', hide: 'Hide',
    row: (name: string, n: number) => `${name}, ${n.toLocaleString('en')}`, onlyOf: (name: string) => `Only ${name}`,
    markAll: (name: string) => `Mark all: ${name}`
  },
  list: {
    title: 'Buildings', jumps: 'Go through parts', sort: 'Order',
    orders: {file: 'as in the files', name: 'by name', unknown: 'most unknown', doubtful: 'most doubtful', wrong: 'most wrong', changed: 'most changed'},
    kinds: {unknown: 'unknown', doubtful: 'doubtful', wrong: 'wrong', changed: 'changed'},
    next: {unknown: 'Next unknown part', doubtful: 'Next doubtful part', wrong: 'Next wrong part', changed: 'Next changed part'},
    previous: {unknown: 'Previous unknown part', doubtful: 'Previous doubtful part', wrong: 'Previous wrong part', changed: 'Previous changed part'},
    badge: (n: number, kind: string) => `${n.toLocaleString('en')} ${kind}`,
    none: {unknown: 'Nothing is unknown.', doubtful: 'Nothing is doubtful.', wrong: 'Nothing is wrong.', changed: 'Nothing has changed.'},
    nth: {
      unknown: (i: number, n: number) => `Unknown part ${i} of ${n}`, doubtful: (i: number, n: number) => `Doubtful part ${i} of ${n}`,
      wrong: (i: number, n: number) => `Wrong part ${i} of ${n}`, changed: (i: number, n: number) => `Changed part ${i} of ${n}`
    }
  },
  explain: {
    title: 'Part', nothing: 'Click a part of the building: what it is called, why, and why not something else.',
    liesIn: 'What it lies in', surface: 'surface', why: 'Why', whyNot: 'Why not', relations: 'How it lies to others',
    noRule: 'No rule calls it anything.', holds: 'holds', fails: 'does not hold', isOpen: 'could not be decided', id: 'Id',
    line: (n: number) => `line ${n}`, corrected: (name: string) => `Corrected by hand: ${name}`, onlyRelation: 'Draw the lines of this relation only',
    more: (n: number) => `and ${n.toLocaleString('en')} more`, attributes: (n: number) => `All ${n} measures`,
    found: (n: number) => count(n, 'part', 'parts'),
    surfaceName: (type: string) => ({WallSurface: 'Wall', RoofSurface: 'Roof', GroundSurface: 'Ground', OuterFloorSurface: 'Outer floor',
      OuterCeilingSurface: 'Outer ceiling', ClosureSurface: 'Closure'} as Record<string, string>)[type] ?? (type || 'Surface'),
    building: (w: number, d: number, h: number, n: number) =>
      `${w.toFixed(1)} × ${d.toFixed(1)} m, ${h.toFixed(1)} m high, with ${count(n, 'feature', 'features')}.`
  },
  search: {
    title: 'Search', label: 'Search by id, name, label, rule or expression', placeholder: 'window, an id, width > 3 m',
    found: (n: number, text: string) => `${count(n, 'part', 'parts')}: ${text}`, nothing: (text: string) => `Nothing is called '${text}'.`
  },
  editor: {title: 'Pack'},
  params: {title: 'Params'},
  truth: {title: 'Truth'},
  scale: {title: 'Scale'},
  learn: {title: 'Learn'}
};
