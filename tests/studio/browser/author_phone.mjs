// An author on a phone: the same studio in one hand. The picture stays above, everything else comes up from the tabs.
import assert from 'node:assert/strict';

import {front, knows, known, says} from './author_steps.mjs';
import {openPage, sizes, startStudio} from './studio.mjs';

const samples = ['house.stripped.city.json', 'house.truth.json'];
const studio = await startStudio(samples, [samples[0], '--rules', 'day.yaml', '--truth', samples[1]], {'day.yaml': ''});
const {page, close, picture} = await openPage(studio.address, sizes.phone);

/** Whatever is on the screen is as wide as the screen and no wider. */
async function fits() {
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), sizes.phone.width);
}

try {
  await front(page, 'editor');
  await page.tap('.starters button >> nth=0');
  await knows(page, values => values.is_good && values.counts.length === 2);
  await fits();

  await front(page, 'params');
  await page.waitForSelector('[data-param=door_height] .curve-line');
  const before = (await known(page)).score.macro_f1;
  await page.focus('[data-param=door_height] .param-slider');
  await page.keyboard.press('End');
  await knows(page, values => values.score.macro_f1 < before);
  await fits();
  await picture('phone');
  await page.tap('[data-param=door_height] .param-best');
  await knows(page, values => values.score.macro_f1 >= before);

  await front(page, 'scale');
  await page.focus('.scale-slider');
  await page.keyboard.press('End');
  await says(page, '.scale-outcomes', /omit/);
  await fits();

  const canvas = await page.locator('#scene canvas').first().boundingBox();
  assert.ok(canvas.width >= 380 && canvas.height >= 250, 'the building has pixels');
  await close();
} finally {
  await studio.stop();
}
