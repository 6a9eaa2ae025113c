import {readFileSync} from 'node:fs';
import {ready} from './20_building.mjs';

const kCount = 120;

const sample = name => JSON.parse(readFileSync(new URL(`../../../../examples/samples/${name}.stripped.city.json`, import.meta.url), 'utf8'));

/** Copies of three houses on a grid, in one file. */
function city() {
  const bases = ['hip', 'l-house', 'house'].map(sample);
  const {scale} = bases[0].transform;
  const moved = (list, by) => list.map(entry => (Array.isArray(entry) ? moved(entry, by) : entry + by));
  const all = {...bases[0], CityObjects: {}, vertices: []};
  for (let i = 0; i < kCount; ++i) {
    const one = bases[(i * 7 + Math.floor(i / 5)) % bases.length];
    const at = [Math.round((i % 12) * 26 / scale[0]), Math.round(Math.floor(i / 12) * 26 / scale[1]), 0];
    const house = Object.values(one.CityObjects)[0];
    const geometry = house.geometry.map(g => ({...g, boundaries: moved(g.boundaries, all.vertices.length)}));
    all.CityObjects[`house-${i}`] = {...house, geometry};
    for (const vertex of one.vertices) all.vertices.push(vertex.map((x, k) => Math.round(x * one.transform.scale[k] / scale[k]) + at[k]));
  }
  return JSON.stringify(all);
}

const kHostile = [`<img src=x onerror="document.title='taken'">`, '__proto__'];

/** A house whose name means something to a browser. */
function named(name) {
  const model = sample('house');
  const house = model.CityObjects.house;
  model.CityObjects = {};
  Object.defineProperty(model.CityObjects, name, {value: house, enumerable: true});
  return JSON.stringify(model);
}

export const title = 'a city is drawn in few calls, and names that mean something to a browser are text';
export const studio = {files: [], texts: {'city.city.json': city(), 'image.city.json': named(kHostile[0]), 'proto.city.json': named(kHostile[1])}};
export const context = {reducedMotion: 'reduce'};

export async function run({page, studio, check, picture}) {
  await page.goto(studio.address);
  await ready(page);
  await page.waitForFunction(count => document.querySelector('.status').textContent.includes('features') &&
    !document.querySelector('.status').textContent.includes(`of ${count}`), kCount + 2, {timeout: 20_000});
  const calls = Number(await page.getAttribute('#scene', 'data-draw-calls'));
  check(calls > 0 && calls <= 200, `${kCount} houses take ${calls} draw calls`);
  await page.click('#tool-palette');
  await page.check('input[value=heat]');
  await picture('city');
  await page.click('#tab-list');
  check(await page.locator('.list-row').count() < kCount, 'the list has only the rows in sight');
  await page.click('.list-button >> nth=3');
  await page.click('#tab-explain');
  await page.waitForSelector('#chosen');
  check(/-3$/.test(await page.textContent('#chosen')), 'a building of it is explained when it is chosen');
  await namesAreText({page, check});
  await keepsLittle({page, check});
}

async function namesAreText({page, check}) {
  for (const name of kHostile) {
    await page.fill('#search', name);
    await page.press('#search', 'Enter');
    await page.waitForFunction(text => document.querySelector('#chosen')?.textContent === text, name);
    check(await page.evaluate(() => window.oriel.store.value.labels.get(window.oriel.store.value.selection.building).length) > 0, `${name} is a name, and labelled`);
    await page.click('#tab-list');
    await page.selectOption('.list select', 'name');
    check((await page.locator('.list-name').allTextContents()).includes(name), 'in the list, too');
    await page.click('#tab-explain');
  }
  await page.mouse.move(640, 400);
  check(await page.locator('img').count() === 0 && await page.title() !== 'taken', 'no markup came of it');
}

/** With room for a few houses only, those that are chosen come and the others stand as boxes. */
async function keepsLittle({page, check}) {
  const kMost = 20_000;
  const kept = () => page.evaluate(() => {
    const {geometry, selection} = window.oriel.store.value;
    return {corners: [...geometry.values()].reduce((sum, {corners}) => sum + corners.length, 0), count: geometry.size, hasChosen: geometry.has(selection.building)};
  });
  const comes = async (test, what) => {
    let now = await kept();
    for (const end = Date.now() + 10_000; !test(now) && Date.now() < end; now = await kept()) await new Promise(resolve => setTimeout(resolve, 50));
    check(test(now), `${what}: ${now.count} houses of ${now.corners} corners`);
  };
  check((await kept()).count === kCount + kHostile.length, 'where there is room, all houses are as they are');
  await page.evaluate(most => {
    window.oriel.shapes.mostCorners = most;
    window.oriel.select({building: 100}, true);
  }, kMost);
  await comes(({corners, hasChosen}) => hasChosen && corners <= kMost, 'where there is little, the chosen house and some are');
  await page.evaluate(() => window.oriel.select({building: 2}, true));
  await comes(({corners, hasChosen}) => hasChosen && corners <= kMost, 'and those of another place come instead');
  check(Number(await page.getAttribute('#scene', 'data-draw-calls')) <= 200, 'in few calls');
}
