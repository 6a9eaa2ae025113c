import {readFileSync} from 'node:fs';
import {ready} from './20_building.mjs';

const kName = `<img src=x onerror="document.title='taken'">`;
const house = readFileSync(new URL('../../../../examples/samples/house.stripped.city.json', import.meta.url), 'utf8');
const named = (name) => {
  const model = JSON.parse(house);
  model.CityObjects = {};
  Object.defineProperty(model.CityObjects, name, {value: JSON.parse(house).CityObjects.house, enumerable: true});
  return JSON.stringify(model);
};

export const title = 'names that mean something to a browser are text';
export const studio = {files: [], texts: {'image.city.json': named(kName), 'proto.city.json': named('__proto__')}};

export async function run({page, studio, check}) {
  await page.goto(studio.address);
  await ready(page);
  await page.click('#tab-list');
  await page.waitForFunction(() => document.querySelectorAll('.list-row').length === 2);
  const names = await page.locator('.list-name').allTextContents();
  check(names.includes(kName) && names.includes('__proto__'), 'both buildings are in the list');
  for (const name of [kName, '__proto__']) {
    await page.click(`.list-button:has(.list-name:text-is(${JSON.stringify(name)}))`);
    await page.click('#tab-explain');
    await page.waitForFunction(text => document.querySelector('#chosen')?.textContent === text, name);
    check(true, `${name} is a name`);
    await page.click('#tab-list');
  }
  await page.mouse.move(640, 400);
  check(await page.locator('img').count() === 0 && await page.title() !== 'taken', 'no markup came of it');
  check(/16/.test(await page.textContent('.legend-row[data-label=window]')) || /32/.test(await page.textContent('.legend-row[data-label=window]')), 'and both are labelled');
}
