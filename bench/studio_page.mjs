#!/usr/bin/env node
// Measures what somebody sees of the studio, in a headless Chromium: from the address to the first picture and to the geometry of all
// buildings, from a key in the editor to labels and F1 on the screen, and the updates of a dragged slider.
//
//   bench/studio_page.mjs [--only WORD] [--repeat N] [--houses N] [ORIEL [ORIEL-GENERATE]]
//
// Sets are those of bench/studio.py. Needs Chromium and playwright-core (tests/studio/browser/run.sh gets them). Chromium draws without
// a graphics card here. Times are milliseconds: the median, and the longest of N (20). Run it on a quiet machine.
import {execFileSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, readdirSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {Studio} from '../tests/studio/browser/studio.mjs';

const root = path.resolve(path.dirname(new URL(import.meta.url).pathname), '..');
const given = {only: '', repeat: '20', houses: '1000'};
const programs = [];
for (let i = 2; i < process.argv.length; ++i) {
  const name = process.argv[i].startsWith('--') ? process.argv[i].slice(2) : '';
  if (name === '') programs.push(path.resolve(process.argv[i]));
  else if (name in given) given[name] = process.argv[++i];
  else throw new Error(`unknown option --${name}`);
}
const oriel = programs[0] ?? path.join(root, 'build/release/cli/oriel');
const generate = programs[1] ?? path.join(root, 'build/release/examples/generator/oriel-generate');
const repeat = Number(given.repeat);
const packages = path.join(root, 'build/release/tests/studio_browser');
const {chromium} = createRequire(path.join(packages, 'package.json'))('playwright-core');

const median = list => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];
function line(what, times, note = '') {
  console.log(`  ${what.padEnd(58)} ${median(times).toFixed(0).padStart(9)} ${Math.max(...times).toFixed(0).padStart(9)}  ${note}`);
}

async function segmented(studio) {
  for (;;) {
    const {loading, buildings} = await studio.ask('state');
    if (loading.done === loading.all && buildings.length > 0) return buildings;
    await new Promise(resolve => setTimeout(resolve, 50));
  }
}

/** Waits in the page for what a function of its store says, looking at every frame; the time by the page's clock. */
const when = (page, test, argument) => page.evaluate(([source, value]) => new Promise(done => {
  const tests = {
    boxes: values => values.buildings.length > 0 && Number(document.querySelector('#scene')?.dataset.drawCalls) > 0,
    some: values => values.geometry.size > 0,
    labels: values => values.counts.length > 0,
    all: values => values.buildings.length > 0 && values.geometry.size === values.buildings.length && values.labels.size === values.buildings.length
  };
  const look = () => {
    const values = window.oriel?.store.value;
    if (values && tests[source](values, value)) requestAnimationFrame(() => done(performance.now()));
    else requestAnimationFrame(look);
  };
  look();
}), [test, argument]);

async function measureOpening(page, studio, buildings) {
  await page.goto(studio.address, {waitUntil: 'commit'});
  await page.waitForFunction(() => window.oriel !== undefined);
  const [boxes, some, labels, all] = await Promise.all(['boxes', 'some', 'labels', 'all'].map(test => when(page, test)));
  const bytes = await page.evaluate(() => [...window.oriel.store.value.geometry.values()].map(shape => ['vertices_mm', 'ring_ends', 'corner_ends', 'corners',
    'owner_ends', 'owners'].reduce((sum, name) => sum + shape[name].byteLength, 0)).reduce((sum, size) => sum + size, 0));
  line('the first picture: boxes', [boxes]);
  line('the first buildings as they are', [some]);
  line('labels and F1', [labels]);
  line('all buildings as they are, with their labels', [all], `${buildings.length} buildings, ${(bytes / 1e6).toFixed(1)} MB`);
  await page.waitForSelector('html[data-ready]');
}

/** From a key to the frame that shows its labels. */
async function measureKeys(page, what, keys) {
  await page.evaluate(() => {
    window.times = [];
    let begin = 0, version = window.oriel.store.value.version;
    addEventListener('keydown', event => { begin ||= event.timeStamp; }, true);
    window.oriel.store.watch(['version'], () => {
      const now = window.oriel.store.value.version;
      if (now === version || begin === 0) return;
      version = now;
      const from = begin;
      begin = 0;
      requestAnimationFrame(() => setTimeout(() => window.times.push(performance.now() - from), 0));
    });
  });
  for (const key of keys) {
    const count = await page.evaluate(() => window.times.length);
    await page.keyboard.press(key);
    await page.waitForFunction(before => window.times.length > before, count);
    await page.waitForTimeout(100);
  }
  line(what, await page.evaluate(() => window.times));
}

/** Moves a slider by one step at each frame, as a hand does. */
async function measureSlider(page, name, seconds) {
  await page.click('#tab-params');
  const counted = await page.evaluate(([param, length]) => new Promise(done => {
    const slider = document.querySelector(`[data-param=${param}] .param-slider`);
    const {min, max} = slider;
    let labels = 0, frames = 0;
    const end = window.oriel.store.watch(['version'], () => { ++labels; });
    const begin = performance.now();
    const step = () => {
      const share = (performance.now() - begin) / 1000 / length;
      if (share >= 1) {
        end();
        done({labels: (labels - 1) / length, frames: frames / length});
        return;
      }
      ++frames;
      slider.value = String(Number(min) + share * (Number(max) - Number(min)));
      slider.dispatchEvent(new Event('input', {bubbles: true}));
      requestAnimationFrame(step);
    };
    slider.dispatchEvent(new PointerEvent('pointerdown', {bubbles: true}));
    step();
  }), [name, seconds]);
  console.log(`  ${`the slider of ${name} is dragged for ${seconds} s`.padEnd(58)} ${counted.labels.toFixed(1)} updates and ${counted.frames.toFixed(1)} frames a second`);
}

async function measure(browser, name, files, truths) {
  console.log(`${name.padEnd(60)} ${'median'.padStart(9)} ${'longest'.padStart(9)}`);
  const rules = readFileSync(path.join(root, 'rules/residential.yaml'), 'utf8');
  const studio = await Studio.open(oriel, {files: [], open: files, texts: {'pack.yaml': rules}, arguments: ['--rules', 'pack.yaml', '--truth', ...truths]});
  const page = await browser.newPage({viewport: {width: 1280, height: 800}, reducedMotion: 'reduce'});
  page.on('pageerror', error => console.log(`  the page has a fault: ${error.message}`));
  page.setDefaultTimeout(120_000);
  try {
    await measureOpening(page, studio, await segmented(studio));
    await page.click('#tab-editor');
    await page.click('.panel.editor .cm-content');
    await page.keyboard.press('Control+End');
    await page.keyboard.type('#');
    await page.waitForTimeout(1000);
    await measureKeys(page, 'a letter in a comment', Array(repeat).fill('a'));
    const at = rules.split('\n').findIndex(text => /^\s*widest_window:.*value: [\d.]+/.test(text));
    const column = /value: [\d.]+/.exec(rules.split('\n')[at]);
    await page.evaluate(number => window.oriel.openLine(number), at + 1);
    await page.keyboard.press('Home');
    await page.keyboard.press('Home');
    for (let i = 0; i < column.index + column[0].length; ++i) await page.keyboard.press('ArrowRight');
    if (!/\./.test(column[0])) await page.keyboard.type('.');
    await page.waitForTimeout(1000);
    await measureKeys(page, 'a digit of a param that decides windows', Array.from({length: repeat}, (_, i) => (i % 2 === 0 ? '9' : 'Backspace')));
    await measureSlider(page, 'widest_window', 4);
  } finally {
    await page.close();
    await studio.close();
  }
}

const browser = await chromium.launch({
  executablePath: execFileSync('which', ['chromium'], {encoding: 'utf8'}).trim(), headless: true,
  args: ['--no-sandbox', '--disable-gpu-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-first-run', '--disable-background-networking']
});
try {
  const data = path.join(process.env.ORIEL_SHARED ?? path.join(path.dirname(root), 'shared'), 'data/ingolstadt');
  const town = existsSync(data) ? readdirSync(data).filter(name => name.endsWith('.stripped.city.json')).sort().map(name => path.join(data, name)) : [];
  if (town.length > 0 && 'ingolstadt'.includes(given.only)) await measure(browser, 'ingolstadt', town, [data]);
  if ('houses'.includes(given.only)) {
    const folder = mkdtempSync(path.join(tmpdir(), 'oriel-bench-'));
    const city = path.join(folder, 'town.city.jsonl'), truth = path.join(folder, 'town.truth.jsonl');
    execFileSync(generate, ['--seed', '5', '--count', given.houses, '-o', city, '--truth', truth], {stdio: 'ignore'});
    await measure(browser, `${given.houses} houses`, [city], [truth]);
    if (existsSync(folder)) rmSync(folder, {recursive: true});
  }
} finally {
  await browser.close();
}
