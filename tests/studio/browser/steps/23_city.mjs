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

export const title = 'a city is drawn in few calls';
export const studio = {files: [], texts: {'city.city.json': city()}};
export const context = {reducedMotion: 'reduce'};

export async function run({page, studio, check, picture}) {
  await page.goto(studio.address);
  await ready(page);
  await page.waitForFunction(count => document.querySelector('.status').textContent.includes('features') &&
    !document.querySelector('.status').textContent.includes(`of ${count}`), kCount, {timeout: 20_000});
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
}
