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
    name: 'The buildings in 3D. Arrow keys turn, plus and minus zoom.',
    fit: 'See everything', hiddenLines: 'Hidden lines', section: 'Cut', measure: 'Measure', relations: 'Relations', changes: 'Changes',
    truth: 'Truth', colour: 'Colours', pattern: 'Patterns', heat: 'Heat map'
  },
  legend: {title: 'Legend'},
  list: {title: 'Buildings'},
  explain: {title: 'Part'},
  search: {title: 'Search'},
  editor: {title: 'Pack'},
  params: {title: 'Params'},
  truth: {title: 'Truth'},
  scale: {title: 'Scale'},
  learn: {title: 'Learn'}
};
