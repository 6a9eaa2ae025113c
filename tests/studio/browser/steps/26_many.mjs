import {cropped, holdGeometry} from './20_building.mjs';

const kCount = 5000;

/** Boxes of 8 m on a grid, in one file. */
function boxes() {
  const faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
  const corners = [[0, 0, 0], [8, 0, 0], [8, 8, 0], [0, 8, 0], [0, 0, 6], [8, 0, 6], [8, 8, 6], [0, 8, 6]];
  const vertices = [], objects = {};
  for (let i = 0; i < kCount; ++i) {
    const first = vertices.length;
    for (const [x, y, z] of corners) vertices.push([x + 14 * (i % 80), y + 14 * Math.floor(i / 80), z]);
    objects[`b${i}`] = {type: 'Building', geometry: [{type: 'Solid', lod: '2', boundaries: [faces.map(face => [face.map(v => v + first)])]}]};
  }
  return JSON.stringify({type: 'CityJSON', version: '2.0', transform: {scale: [1, 1, 1], translate: [0, 0, 0]}, CityObjects: objects, vertices});
}

export const title = 'five thousand buildings stand as blocks while they are loaded, and a pack that does not parse is said';
export const studio = {files: [], texts: {'many.city.json': boxes(), 'bad.yaml': 'schema: oriel/1\nrules: [\n'}, arguments: ['--rules', 'bad.yaml']};
export const context = {viewport: {width: 1440, height: 900}, reducedMotion: 'reduce'};

/** Opens the page and waits for its first picture of all buildings. */
async function standsAsBlocks({page, studio, check, picture}, width) {
  const begin = performance.now();
  await page.goto(studio.address, {waitUntil: 'commit'});
  await page.waitForFunction(count => window.oriel?.store.value.buildings.length === count && Number(document.querySelector('#scene').dataset.drawCalls) > 0, kCount);
  const took = (performance.now() - begin) / 1000;
  check(took < 3, `outlines are drawn ${took.toFixed(1)} s after the page was asked for, at ${width} pixels`);
  check(await page.evaluate(() => window.oriel.store.value.geometry.size) === 0 && await cropped(page) === 0, 'as blocks, all in the picture');
  await picture(`many_loading_${width}`);
}

export async function run(step) {
  const {page, check} = step;
  await holdGeometry(page);
  await standsAsBlocks(step, 1440);
  await page.waitForFunction(() => document.querySelector('.status .grave') !== null);
  check(/nothing is labelled yet/.test(await page.textContent('.status')), `a pack that does not parse is said: ${await page.textContent('.status')}`);
  check(await page.locator('.findings:not([hidden])').count() === 1, 'and its findings are listed');
  await page.setViewportSize({width: 390, height: 844});
  await standsAsBlocks(step, 390);
}
