// All words of the page, grouped by the room that says them. Translate this file and nothing else. What comes from the engine
// (sentences of findings, of explanations) is not here.
const count = (n: number, one: string, many: string) => `${n.toLocaleString('en')} ${n === 1 ? one : many}`;

export const words = {
  source: {
    gone: 'The studio does not answer. Is the program still running?',
    restarted: (verb: string) => {
      const again: Record<string, string> = {
        save: 'The pack was not saved: save it again.', correct: 'The correction was not written: say again what the part is.',
        learn: 'Nothing was learnt: start the search again.', scale: 'The building was not drawn: choose the scale again.',
        explain: 'Choose the part again to see what would change its label.', ask: 'Ask again for the parts that are worth a look.'
      };
      return `The studio ended at this and was started again. ${again[verb] ?? 'Please try again.'}`;
    },
    back: 'The studio had a fault and was started again. It reads the buildings anew; the pack in the editor is as it was.',
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
    loadBar: 'Buildings that are loaded',
    noneGood: 'The pack has errors, so nothing is labelled yet; they are listed below it.',
    keep: 'The pack has errors. You see the labels of the last good version.',
    unknown: (n: number) => `${n.toLocaleString('en')} unknown`,
    features: (n: number) => count(n, 'feature', 'features'),
    ms: (n: number) => `${n < 10 ? n.toFixed(1) : Math.round(n)} ms`,
    f1: (f: number) => `F1 ${f.toFixed(3)}`,
    theme: 'Dark or light', help: 'Keys',
    noWebGl: 'This browser draws no 3D (WebGL 2 is missing). Lists, search and explanations work.'
  },
  welcome: {
    title: 'No buildings here yet',
    how: 'Start the studio with files or a folder of buildings, as in oriel studio houses/. Or begin with three sample houses and what is true of them; they are put into a folder oriel-samples.',
    samples: 'Open the sample houses', packs: 'A pack to begin with', experiment: 'An experiment',
    experimentHow: 'What is each rule worth? It comes with the sample houses:',
    command: 'oriel experiment run oriel-samples/experiment.yaml -o results',
    opened: (folder: string) => `The sample houses, their truth and an experiment are in ${folder}.`
  },
  keys: [
    ['← → ↑ ↓', 'turn the building (in its picture)'],
    ['⇧ ← →', 'move it'],
    ['+ −', 'zoom'],
    ['F', 'see everything, or what is chosen'],
    ['1 2 3', 'from the front, from the side, from above'],
    ['H', 'hidden lines'],
    ['O', 'only the chosen building, or all'],
    ['X', 'cut'],
    ['M', 'measure'],
    ['R', 'relations of the chosen part'],
    ['T', 'truth'],
    ['C', 'correct the chosen part'],
    ['N ⇧N', 'next and previous unknown part'],
    ['D', 'next doubtful part'],
    ['W', 'next wrong part'],
    ['/', 'search'],
    ['Ctrl S', 'format and save the pack'],
    ['Ctrl Space', 'what can stand here'],
    ['F12', 'go to the definition'],
    ['F2', 'rename'],
    ['Ctrl Z', 'undo'],
    ['Esc Tab', 'leave the editor'],
    ['Esc', 'forget what is chosen'],
    ['?', 'this list']
  ] as [string, string][],
  scene: {
    name: 'The buildings in 3D. Arrow keys turn, with shift they move, plus and minus zoom, N goes to the next unknown part.',
    tools: 'Tools of the picture', fit: 'See everything', only: 'Only this building', hiddenLines: 'Hidden lines', section: 'Cut', measure: 'Measure', relations: 'Relations',
    changes: 'What changed', truth: 'Truth', colours: 'Colours', colour: 'Colours', pattern: 'Patterns', heat: 'Heat map', heatOf: 'Heat map of',
    heatKinds: {unknown: 'unknown parts', doubtful: 'doubtful parts', wrong: 'wrong parts', changed: 'changed parts'},
    unread: (n: number, first: string) => `${count(n, 'fault', 'faults')} in what was read; the first: ${first}`,
    moved: 'Buildings on one spot or of other systems stand apart.',
    away: (n: number) => `${count(n, 'building lies', 'buildings lie')} too far away for this picture:`,
    awayBy: (name: string, m: number) => `${name} (${Math.round(m / 1000).toLocaleString('en')} km)`,
    unknown: 'unknown', surface: 'surface', measureHint: 'Click two points. Corners attract; Esc ends it.',
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
    shareOf: (name: string) => `Share of ${name} in a building`,
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
    others: (n: number) => `${count(n, 'rule does', 'rules do')} not hold`, line: (n: number) => `line ${n}`, corrected: (name: string) => `Corrected by hand: ${name}`, onlyRelation: 'Draw the lines of this relation only',
    more: (n: number) => `and ${n.toLocaleString('en')} more`, attributes: (n: number) => `All ${n} measures`,
    found: (n: number) => count(n, 'part', 'parts'),
    senses: {hole: 'hole', protrusion: 'protrusion', cavity: 'cavity', imprint: 'panel'}, senseIs: (sense: string) => `is a ${sense}`,
    flipSearch: 'Looking for the smallest change that would give another label …',
    mustBe: (sense: string) => `must be a ${sense}`, mustBeOneOf: (list: string[]) => `must be a ${list.join(' or a ')}`,
    missing: (attribute: string) => `${attribute} is missing`,
    scores: (score: number) => `scores ${score.toFixed(2)}`, andMore: (n: number) => `${n} more`, otherLabels: (n: number) => count(n, 'label is', 'labels are') + ' farther away',
    bySurfaceRule: (rule: string) => `The rule ${rule} says so.`, measures: 'Measures', rules: 'Rules in their order',
    surfaceName: (type: string) => ({WallSurface: 'Wall', RoofSurface: 'Roof', GroundSurface: 'Ground', OuterFloorSurface: 'Outer floor',
      OuterCeilingSurface: 'Outer ceiling', ClosureSurface: 'Closure'} as Record<string, string>)[type] ?? (type || 'Surface'),
    building: (w: number, d: number, h: number, n: number) =>
      `${w.toFixed(1)} × ${d.toFixed(1)} m, ${h.toFixed(1)} m high, with ${count(n, 'feature', 'features')}.`
  },
  search: {
    title: 'Search', label: 'Search by id, name, label, rule or expression', placeholder: 'window, an id, width > 3 m',
    found: (n: number, text: string) => `${count(n, 'part', 'parts')}: ${text}`, buildings: (n: number, text: string) => `${count(n, 'building', 'buildings')}: ${text}`,
    nothing: (text: string) => `Nothing is called '${text}'.`
  },
  editor: {
    title: 'Pack',
    name: 'The rule pack', bar: 'Pack',
    line: (n: number) => `Line ${n}`,
    findings: 'Findings',
    summary: (errors: number, others: number) =>
      [errors > 0 ? count(errors, 'error', 'errors') : '', others > 0 ? count(others, 'remark', 'remarks') : ''].filter(Boolean).join(' · '),
    undo: 'Undo', undoHint: 'Undo (Ctrl Z)', redo: 'Redo', redoHint: 'Redo (Ctrl Y)',
    noDefinition: 'This word is not defined in the pack.',
    formatted: 'The pack is in its canonical form.', notFormatted: 'A pack with errors cannot be formatted.',
    emptyPack: 'This pack is empty. Write one, or begin with a small one:', startOpenings: 'Windows and doors', startExtending: 'Extend residential',
    rename: 'Rename', cancel: 'Cancel', newName: 'New name',
    renameOf: (name: string) => `Rename ${name} to`,
    renamed: (places: number, name: string) => `${count(places, 'place is', 'places are')} called ${name} now.`,
    notRenamed: 'Only what the pack defines can be renamed.',
    phrases: {} as Record<string, string>
  },
  save: {
    save: 'Save', saveHint: 'Format and save (Ctrl S)', diff: 'Changes', diffHint: 'Show what differs from the saved file',
    unsaved: 'not saved', saved: 'saved', builtIn: 'built in',
    done: (path: string) => `Saved as ${path}.`,
    notSaved: 'Nothing was written.', taken: 'The pack is the one on the disk now.',
    takeBack: 'Take back', takeOver: 'Take this over from the disk',
    changedOnDisk: 'Someone else has changed the file of this pack.', compare: 'Compare', later: 'Later',
    where: 'Save the pack as', path: 'File', cancel: 'Cancel',
    builtInWhy: 'This pack is built into the program. A copy becomes a file of your own.',
    readOnly: 'The file of this pack cannot be written. Choose another name.',
    conflict: 'The file has changed on the disk',
    conflictWhy: 'Someone else has written the file since you opened it. Take over what you want from the left, then save the right side; or take the file as it is.',
    onDisk: 'On the disk', inEditor: 'In the editor', takeDisk: 'Take the file', keepOwn: 'Save the right side'
  },
  params: {
    title: 'Params',
    filter: 'Find a param', measure: 'What the curves show', measureShort: 'Curves', allClasses: 'all classes',
    empty: 'This pack has no params. Give a number a name, a range and a reason under params: to see it as a slider.',
    openHint: 'Go to its line',
    valueOf: (name: string) => `Value of ${name}`,
    f1: (f1: number) => `F1 ${f1.toFixed(3)}`,
    best: (f1: number, value: string) => `best ${f1.toFixed(3)} at ${value}`
  },
  outline: {
    title: 'Classes',
    empty: 'The pack has no classes yet.',
    countHint: 'Parts with this label', f1Hint: 'F1 of this class',
    kind: (kind: string) => ({macro: 'Macros', relation: 'Relations', group: 'Groups', generalise: 'Generalisation'})[kind] ?? kind
  },
  changes: {
    name: 'Changes', since: 'Compared with', sinceEdit: 'since the last edit', sinceSave: 'since the pack was saved',
    unknown: 'unknown', becomes: 'becomes', showAll: 'Show all in the picture',
    part: (feature: number) => `part ${feature}`,
    title: (before: string, after: string, n: number) => `${before} → ${after}: ${count(n, 'part', 'parts')}`,
    more: (n: number) => `and ${n.toLocaleString('en')} more`,
    sum: (n: number, before: number | null, after: number | null) =>
      (n === 0 ? 'No label has changed.' : `${count(n, 'label has', 'labels have')} changed.`) +
      (before !== null && after !== null && Math.abs(after - before) >= 5e-4 ? ` F1 ${before.toFixed(3)} → ${after.toFixed(3)}.` : '')
  },
  truth: {
    title: 'Truth',
    none: 'No truth was given. Start the studio with --truth FILE to see how well the rules do.',
    overlay: 'Show the truth in the picture', macroF1: 'F1, mean of the classes',
    confusion: 'What is what', corner: 'truth ↓ label →', cellHint: 'Rows are the truth, columns the labels. Choose a number to see the parts behind it.',
    cellTitle: (truth: string, label: string, n: number) => `${count(n, 'part', 'parts')}: truth ${truth}, label ${label}`,
    nothing: 'no object', notFound: 'no label',
    missedOnly: (n: number) => `${count(n, 'object of the truth has', 'objects of the truth have')} no part: the picture shows the truth.`,
    classes: 'Classes', classColumns: ['Class', 'Precision', 'Recall', 'F1', 'Found'],
    foundOf: (found: number, all: number) => `${found} of ${all}`,
    rules: 'Rules', ruleColumns: ['Rule', 'Right', 'Wrong', 'Precision'], ruleHint: 'Right and wrong by the truth',
    ruleShort: (right: number, wrong: number) => `${right} ✓ ${wrong > 0 ? `${wrong} ✗` : ''}`,
    showWrong: (n: number) => `Show the ${count(n, 'part that is', 'parts that are')} wrong`,
    wrong: (n: number) => `${count(n, 'part', 'parts')} with a wrong label`
  },
  correct: {
    title: 'Correct the label', hint: 'Say what it is (C)', setParam: (name: string, value: string) => `Set ${name} to ${value}`, label: 'What it is', why: 'Why (if you like)', noClass: 'none of them', withdraw: 'Withdraw the correction',
    of: (name: string, label: string) => `${name} is called ${label}. It is`,
    done: (name: string) => `Corrected to ${name}.`, withdrawn: 'The correction is withdrawn.', failed: 'The correction was not written.',
    conflict: 'Someone else has corrected this part', own: 'What you say', nothing: 'no correction', takeDisk: 'Keep what is on the disk', keepOwn: 'Write what you say'
  },
  samples: {
    title: 'Samples',
    choose: 'Choose a part and press C, or right-click it, to say what it is.', correct: 'Correct',
    corrections: 'Corrections',
    noCorrections: (path: string) => `None yet. They go to ${path || 'corrections.jsonl'}.`,
    inFile: (n: number, path: string) => `${count(n, 'correction', 'corrections')} in ${path}`,
    withdraw: (name: string) => `Withdraw the correction of ${name}`,
    worth: 'Worth a look', worthWhy: 'The parts whose right label would tell most.', ask: 'Find them', say: 'Say what it is',
    nothingToAsk: 'Nothing is in doubt.'
  },
  learn: {
    title: 'Learn', why: 'Searches the ranges of the params for values that fit the truth and the corrections better. You go on working meanwhile.',
    objective: 'For', macroF1: 'F1 of all classes', f1Of: (name: string) => `F1 of ${name}`, proposeRules: 'list changes of rules, too',
    start: 'Learn', stop: 'Stop', progress: 'How far the search is', running: 'Searching …', stopped: 'Stopped.', lost: 'The studio was started again and the search is lost. Learn again.', failed: 'Nothing could be learnt.',
    done: 'This is the proposal. Leave out what you do not believe.', nothing: 'The pack is as good as it gets within the ranges of its params.',
    report: 'Report', rules: 'Changes of rules that would pay',
    gain: (all: number, heldOut: number) => `F1 +${all.toFixed(3)}, +${heldOut.toFixed(3)} on buildings held out`,
    proposal: 'The proposed pack', leaveOut: 'Leave out', accept: 'Accept', reject: 'Reject', accepted: 'Accepted. Undo takes it back.', rejected: 'Rejected.',
    showDiff: 'What it changes', acceptRule: 'Make this change', acceptedRule: (rule: string) => `${rule} is changed. Undo takes it back.`,
    outdated: 'The pack has changed since the search began. Learn again.'
  },
  scale: {
    title: 'Scale', slider: 'Scale of the map', lods: 'Levels of detail', original: 'As it is', generalised: 'Generalised', beside: 'Beside the original',
    hint: 'Move the slider to see the building as a map of that scale has it, by the entries of generalise: in the pack.',
    polygons: (before: number, after: number) => `${before.toLocaleString('en')} → ${count(after, 'polygon', 'polygons')}`,
    drawing: (name: string, stop: string) => `Drawing ${name} at ${stop} …`, seconds: (s: number) => `${s < 10 ? s.toFixed(1) : Math.round(s)} s`,
    stages: {labelling: 'labelling', drawing: 'drawing', checking: 'checking the solid', repairing: 'repairing the solid'} as Record<string, string>,
    cancel: 'Cancel', cancelHint: 'Keep the picture as it is (Esc)', cancelled: 'Cancelled. The picture is as it was.',
    long: 'A large building takes up to a minute the first time. You can go on working, or choose another scale.',
    valid: 'A valid solid.', invalid: 'Not a valid solid.', kept: 'kept', nothing: 'Nothing had to be done.'
  }
};
