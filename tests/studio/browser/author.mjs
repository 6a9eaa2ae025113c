// What an author does in a page of the studio; steps/10_author_day.mjs puts it in order.
import assert from 'node:assert/strict';

const kWait_ms = 15_000;

/** Opens the page and waits until the pack is in its editor. */
export async function open(page, studio) {
  await page.goto(studio.address);
  await page.waitForSelector('html[data-ready]');
}

/** Waits until `test` holds, looking again and again: the page's Content-Security-Policy lets no test be sent into it. */
async function until(what, test) {
  const end = Date.now() + kWait_ms;
  while (!await test()) {
    assert.ok(Date.now() < end, `the page never came to: ${what}`);
    await new Promise(resolve => setTimeout(resolve, 30));
  }
}

/** Waits until an element says what `pattern` matches. */
export async function says(page, selector, pattern) {
  await until(`${selector} says ${pattern}`, async () =>
    pattern.test(await page.evaluate(where => [...document.querySelectorAll(where)].map(element => element.textContent).join('\n'), selector)));
}

/** What the page knows: the fields of its store that steps ask for. */
export const known = page => page.evaluate(() => {
  const {text, is_good, counts, score, found, selection, unknown} = window.oriel.store.value;
  return {text, is_good, counts, score, found, selection, unknown};
});

/** Waits until what the page knows passes a test. */
export async function knows(page, test) { await until(String(test), async () => test(await known(page))); }

export const front = (page, tab) => page.click(`#tab-${tab}`);

async function countOf(page, name) {
  return (await known(page)).counts.find(entry => entry.class === name)?.count ?? 0;
}

/** Goes to the condition on heights, line 13 of the pack, and chooses the attribute in it. */
async function chooseHeight(page) {
  await page.evaluate(() => window.oriel.openLine(13));
  for (let i = 0; i < '- '.length; ++i) await page.keyboard.press('ArrowRight');
  for (let i = 0; i < 'height'.length; ++i) await page.keyboard.press('Shift+ArrowRight');
}

/** From nothing to windows and doors: one of the beginnings that an empty editor offers. */
export async function beginPack(page, picture) {
  assert.equal((await known(page)).text, '');
  await page.click('.starters button >> nth=0');
  await knows(page, values => values.is_good && values.counts.length === 2 && values.score !== null);
  assert.ok(await countOf(page, 'window') > 0);
  assert.ok(await countOf(page, 'door') > 0);
  await picture('pack');
}

/** A mistake is underlined with its advice while the labels stay, and the fix mends it. */
export async function mendMistake(page, picture) {
  const counts = (await known(page)).counts;
  await chooseHeight(page);
  await page.keyboard.type('heigth');
  await page.keyboard.press('Escape');
  await page.waitForSelector('.cm-lintRange-error', {timeout: kWait_ms});
  await says(page, '.status', /last good version/);
  assert.deepEqual((await known(page)).counts, counts);
  if (!await page.isVisible('.findings-list')) await page.click('.findings summary');
  await picture('mistake');
  await page.click('.findings .fix >> nth=0');
  await knows(page, values => values.is_good);
  assert.match((await known(page)).text, /height >= 0\.4 m/);
  await page.waitForSelector('.cm-lintRange-error', {state: 'detached'});
}

/** Completion inside an expression knows attributes with unit and meaning, and hover says what a word is. */
export async function complete(page, picture) {
  await chooseHeight(page);
  await page.keyboard.press('End');
  await page.keyboard.type(' and base_h');
  await says(page, '.cm-tooltip-autocomplete', /base_height/);
  await page.waitForTimeout(100);  // an answer to an older text may be drawn still, and Enter waits as long
  await picture('completion');
  await page.keyboard.press('Enter');
  await page.keyboard.type(' >= 0 m');
  await knows(page, values => values.is_good && /base_height >= 0 m/.test(values.text));
}

/** What would change a label is told, and a click does it. */
export async function flip(page, picture, flipOf) {
  const {counts} = await known(page);
  const doors = await page.evaluate(() => {
    const {labels, classes} = window.oriel.store.value;
    const door = classes.findIndex(({name}) => name === 'door');
    return labels.get(0).flatMap((label, feature) => (label === door ? [feature] : []));
  });
  let part = -1;
  for (const door of doors) if (part < 0 && await flipOf(door)) part = door;
  assert.ok(part >= 0, 'no door of the house would be something else');
  await page.evaluate(feature => window.oriel.select({building: 0, feature}, true), part);
  await says(page, '#flip', /door_height at [\d.]+ m instead of [\d.]+ m .* window/);
  await picture('flip');
  await page.click('#panel-explain .part-tools .button >> nth=1');
  await knows(page, values => JSON.stringify(values.counts) !== JSON.stringify(counts));
  await says(page, '#chosen', /^window$/);
  await page.click('.pack-bar .tool >> nth=0');
  await knows(page, values => JSON.stringify(values.counts) === JSON.stringify(counts));
}

/** A threshold is dragged away and F1 falls; what that changed is listed, label before and after. */
export async function dragThreshold(page, picture) {
  await front(page, 'params');
  const row = '[data-param=door_height]';
  await page.waitForSelector(`${row} .curve-line`, {timeout: kWait_ms});
  const slider = page.locator(`${row} .param-slider`);
  await slider.scrollIntoViewIfNeeded();
  const before = (await known(page)).score.macro_f1;
  const box = await slider.boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + box.width * 0.3, y);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width - 4, y, {steps: 6});
  await page.mouse.up();
  await knows(page, values => values.score.macro_f1 < before);
  await front(page, 'changes');
  await says(page, '.change-group', /door→/);
  await page.click('.change-group summary');
  await page.waitForSelector(`${row} .param-best:not([hidden])`, {timeout: kWait_ms});
  await picture('threshold');
  await page.click('.change-items .tree-row >> nth=0');
  await knows(page, values => values.selection?.feature !== undefined);
  return before;
}

/** The curve leads back to the peak of F1, and one step of undo takes that back. */
export async function findPeak(page, before) {
  const row = '[data-param=door_height]';
  const low = (await known(page)).score.macro_f1;
  await page.click(`${row} .param-best`);
  await knows(page, values => values.score.macro_f1 >= before);
  const {text} = await known(page);
  assert.match(text, /door_height: \{value: [\d.]+ m, range: 1\.5 m/);
  await page.focus(`${row} .param-slider`);
  await page.keyboard.press('Control+z');
  await knows(page, values => values.score.macro_f1 === low);
  await page.keyboard.press('Control+y');
  await knows(page, values => values.text === text && values.score.macro_f1 >= before);
}

/** The confusion table leads to the parts behind a number. */
export async function seeTruth(page, picture) {
  await front(page, 'truth');
  await page.waitForSelector('.confusion');
  await page.click('.confusion .is-right button >> nth=0');
  await knows(page, values => values.found.length > 0);
  await front(page, 'truth');
  await picture('truth');
}

/** A label is corrected by keyboard, and the correction is withdrawn. */
export async function correctLabel(page, picture, correctionsOnDisk) {
  const part = (await known(page)).found[0];
  await page.evaluate(([building, feature]) => window.oriel.select({building, feature}, true), part);
  await page.click('#panel-explain .part-tools .button');
  await page.waitForSelector('.correct-menu input:focus');
  await page.keyboard.type('door');
  await page.waitForTimeout(50);
  await picture('correction');
  await page.keyboard.press('Enter');
  await front(page, 'samples');
  await says(page, '.sample-list', /door/);
  assert.match(correctionsOnDisk(), /"class": ?"door"/);
  await page.click('.sample-list .icon-button');
  await page.waitForSelector('.sample-list .icon-button', {state: 'detached'});
  assert.doesNotMatch(correctionsOnDisk(), /"class": ?"door"/);
}

/** Learning proposes, and the pack changes only when the proposal is accepted; undo takes it back at once. */
export async function learn(page, picture) {
  const {text, score: {macro_f1: before}} = await known(page);
  await front(page, 'samples');
  await page.click('.learn .button-main');
  await page.waitForSelector('.proposal .cm-editor', {timeout: kWait_ms});
  assert.equal((await known(page)).text, text);
  await page.locator('.proposal .button-main').scrollIntoViewIfNeeded();
  await picture('proposal');
  await page.click('.proposal .button-main');
  await knows(page, values => values.text !== text && values.is_good && values.score.macro_f1 > before);
  await page.keyboard.press('Control+z');
  await knows(page, values => values.text === text && values.score.macro_f1 === before);
}

/** The slider of scales draws the generalised building beside the original. */
export async function generalise(page, picture) {
  await page.evaluate(() => window.oriel.select({building: 1}));
  await front(page, 'scale');
  await page.locator('.scale-slider').focus();
  await page.keyboard.press('End');
  await page.waitForSelector('.divider', {timeout: kWait_ms});
  await says(page, '.scale-outcomes', /omit/);
  if (process.env.ORIEL_PICTURES) await page.waitForTimeout(1500);  // a second picture has its first frame, and the flight to the building ends
  await picture('scale');
  await page.keyboard.press('Home');
  await page.waitForSelector('.divider', {state: 'hidden'});
}

/** The diff against the saved pack, and saving; the file has the pack in its canonical form. */
export async function save(page, picture, packOnDisk) {
  await front(page, 'editor');
  await page.click('.pack-bar .tool[aria-pressed]');
  await page.waitForSelector('.cm-changedLine');
  await picture('diff');
  await page.click('.pack-bar .tool[aria-pressed]');
  await page.click('#save-pack');
  await says(page, '.pack-state', /^saved$/);
  assert.equal(packOnDisk(), (await known(page)).text);
}

/** Someone else writes the file: both texts are shown, and nothing is overwritten before the author has said so. */
export async function resolveConflict(page, picture, packOnDisk, writePack) {
  writePack(`# written by another\n${packOnDisk()}`);
  await page.click('.panel.editor .cm-content');
  await page.keyboard.press('Control+End');
  await page.keyboard.type('# mine\n');
  await page.keyboard.press('Control+s');
  await page.waitForSelector('.dialog-conflict', {timeout: kWait_ms});
  await says(page, '.dialog-conflict', /written by another/);
  assert.match(packOnDisk(), /^# written by another/);
  await picture('conflict');
  await page.click('.dialog-conflict .button-main');
  await says(page, '.pack-state', /^saved$/);
  assert.doesNotMatch(packOnDisk(), /written by another/);
  assert.match(packOnDisk(), /# mine/);
}
