import {existsSync} from 'node:fs';
import {cropped, ready} from './20_building.mjs';

export const title = 'a studio without buildings offers sample houses, packs and an experiment, and a new pack is no error';
export const studio = {files: [], arguments: ['--rules', 'new.yaml']};
export const context = {viewport: {width: 1440, height: 900}, reducedMotion: 'reduce'};

export async function run({page, studio, check, picture}) {
  await page.goto(studio.address);
  await page.waitForSelector('.welcome');
  await page.waitForSelector('html[data-ready]');
  check(await page.locator('.welcome .button').count() === 3 && /oriel experiment run/.test(await page.textContent('.welcome')), 'houses, two packs and an experiment are offered');
  check(await page.locator('.status .grave').count() === 0 && await page.locator('.findings:not([hidden])').count() === 0, 'a new pack is no error');
  await picture('nothing_1440');
  await page.setViewportSize({width: 390, height: 844});
  const fits = await page.waitForFunction(() => [...document.querySelectorAll('.welcome .button')].every(button => {
    const {left, right, top, bottom} = button.getBoundingClientRect();
    return left >= 0 && right <= innerWidth && button.contains(document.elementFromPoint((left + right) / 2, (top + bottom) / 2));
  }) && document.documentElement.scrollWidth <= innerWidth, null, {timeout: 3000}).then(() => true, () => false);
  check(fits, 'on a phone, too');
  await picture('nothing_390');
  await page.setViewportSize({width: 1440, height: 900});
  await page.click('.welcome .button >> nth=1');
  await page.click('#open-samples');
  await page.waitForFunction(() => window.oriel.store.value.geometry.size === 3 && window.oriel.store.value.counts.length === 2);
  check(await page.locator('.welcome').count() === 0 && await cropped(page) === 0, 'the houses stand in the picture, labelled by the pack');
  check(existsSync(studio.path('oriel-samples/experiment.yaml')) && await page.evaluate(() => window.oriel.store.value.score !== null), 'with their truth, and files of their own');
  await picture('nothing_opened');
}
