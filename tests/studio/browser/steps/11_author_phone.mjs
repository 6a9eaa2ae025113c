import assert from 'node:assert/strict';

import {beginPack, front, knows, known, open, says} from '../author.mjs';

export const title = 'an author on a phone begins a pack, drags a threshold and looks at a scale';

export const studio = {
  files: ['house.stripped.city.json', 'house.truth.json'], open: ['house.stripped.city.json'], texts: {'day.yaml': ''},
  arguments: ['--rules', 'day.yaml', '--truth', 'house.truth.json']
};
export const context = {viewport: {width: 390, height: 844}, hasTouch: true, isMobile: true, deviceScaleFactor: 2, reducedMotion: 'reduce', colorScheme: 'light'};

export async function run({page, studio: opened, check, picture}) {
  const fits = async () => assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), context.viewport.width, 'nothing is wider than the screen');
  await open(page, opened);
  await front(page, 'editor');
  await beginPack(page, async () => undefined);
  await fits();
  check(true, 'a beginning is chosen by a finger');

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
  check(true, 'a threshold moves F1');

  await front(page, 'scale');
  await page.focus('.scale-slider');
  await page.keyboard.press('End');
  await says(page, '.scale-outcomes', /omit/);
  await fits();
  const canvas = await page.locator('#scene canvas').first().boundingBox();
  check(canvas.width >= 380 && canvas.height >= 250, 'the building has pixels');
}
