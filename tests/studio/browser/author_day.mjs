// The day of an author: from an empty pack to a saved one that finds the windows and doors of a house, with everything between:
// completion, a mistake and its fix, a threshold dragged until F1 peaks, a wrong label corrected, a proposal accepted, the building
// at a scale, and a file that someone else has changed.
import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';

const kOpenings = ['schema: oriel/1', 'pack: {name: day, version: 0.1.0}'];

export const files = ['house.stripped.city.json'];
export const truth = 'house.truth.json';

/** Waits until the status line, or another element, says what `pattern` matches. */
async function says(page, selector, pattern) {
  await page.waitForFunction(([where, source]) => new RegExp(source).test(document.querySelector(where)?.textContent ?? ''),
    [selector, pattern.source], {timeout: 5000});
}

const textOf = page => page.evaluate(() => document.querySelector('.panel.editor .cm-content').cmTile?.view?.state.doc.toString() ??
  document.querySelector('.panel.editor .cm-content').cmView.view.state.doc.toString());

const f1Of = async page => Number(/F1 ([\d.]+)/.exec(await page.textContent('.status'))?.[1]);

async function front(page, tab) { await page.click(`#tab-${tab}`); }

/** From nothing to windows and doors: the beginning that the empty editor offers. */
async function beginPack(page, picture) {
  await page.click('.starters button >> nth=0');
  await says(page, '.status', /F1 0\.[1-9]/);
  await says(page, '.legend-card', /window/);
  await says(page, '.legend-card', /door/);
  await picture(page, 'pack');
  assert.ok((await textOf(page)).startsWith(kOpenings[0]));
}

/** A mistake is underlined with its advice, the labels stay, and the fix mends it. */
async function mendMistake(page, picture) {
  await page.click('.panel.editor .cm-content');
  await page.keyboard.press('Control+f');
  await page.fill('.cm-search input[name=search]', 'height >= 0.4 m');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Escape');
  await page.keyboard.type('heigth >= 0.4 m');
  await page.waitForSelector('.cm-lintRange-error');
  await says(page, '.status', /last good version/);
  await says(page, '.legend-card', /window/);
  await page.click('.findings summary');
  await picture(page, 'mistake');
  await page.click('.findings .fix >> nth=0');
  await page.waitForFunction(() => !document.querySelector('.cm-lintRange-error'));
  assert.match(await textOf(page), /height >= 0\.4 m/);
}

/** Completion knows attributes with unit and meaning. */
async function complete(page, picture) {
  await page.keyboard.press('End');
  await page.keyboard.type(' and base_h');
  await page.waitForSelector('.cm-tooltip-autocomplete li');
  await says(page, '.cm-tooltip-autocomplete', /base_height/);
  await picture(page, 'completion');
  await page.keyboard.press('Enter');
  await page.keyboard.type(' >= 0 m');
  assert.match(await textOf(page), /and base_height >= 0 m/);
  await page.waitForFunction(() => !document.querySelector('.cm-lintRange-error'));
}

/** The slider of a threshold: F1 moves with it, and the curve says where it peaks. */
async function dragThreshold(page, picture) {
  await front(page, 'params');
  const row = '[data-param=door_height]';
  await page.waitForSelector(`${row} .curve-line`);
  const slider = page.locator(`${row} .param-slider`);
  const box = await slider.boundingBox();
  await page.mouse.move(box.x + box.width * 0.3, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width - 4, box.y + box.height / 2, {steps: 8});
  await page.mouse.up();
  await says(page, '.status', /F1 0\.[0-8]/);
  const low = await f1Of(page);
  await page.waitForSelector(`${row}.is-stale`, {state: 'detached'});
  await picture(page, 'threshold');
  await page.click(`${row} .param-best`);
  await page.waitForFunction(before => Number(/F1 ([\d.]+)/.exec(document.querySelector('.status').textContent)?.[1]) > before, low);
  const text = await textOf(page);
  assert.match(text, /door_height: \{value: [\d.]+ m, range/);
  return await f1Of(page);
}

/** C names the chosen part; the correction is in the file at once. */
async function correctLabel(page, picture, correctionsFile) {
  await page.fill('#search', 'door');
  await page.keyboard.press('Enter');
  await page.click('.found-list button >> nth=0').catch(() => undefined);
  await page.click('#scene canvas', {position: {x: 5, y: 5}, button: 'middle'}).catch(() => undefined);
  await front(page, 'samples');
  await page.click('.chosen .button');
  await page.keyboard.type('wind');
  await picture(page, 'correction');
  await page.keyboard.press('Enter');
  await says(page, '.sample-list', /window/);
  assert.match(readFileSync(correctionsFile, 'utf8'), /"class": ?"window"/);
  await page.click('.sample-list .icon-button');
  await page.waitForFunction(() => !document.querySelector('.sample-list .icon-button'));
}

export {assert, beginPack, complete, correctLabel, dragThreshold, f1Of, front, mendMistake, says, textOf, writeFileSync};
