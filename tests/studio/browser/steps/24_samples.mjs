import {readdirSync} from 'node:fs';
import {cropped, ready} from './20_building.mjs';

const kFiles = readdirSync(new URL('../../../../examples/samples/', import.meta.url)).filter(name => name.endsWith('.city.json')).sort();

export const title = 'houses on one spot stand side by side with their names, and what is far away is said';
export const studio = {files: kFiles};
export const context = {viewport: {width: 1440, height: 900}, reducedMotion: 'reduce'};

/** What is hit at points all over the picture, by whether it is the chosen building: how much its colours differ from the ground, and how
    often it has the colour of its class, whatever the shade. */
const seen = page => page.evaluate(() => new Promise(done => {
  const {scene, store} = window.oriel;
  const look = () => {
    scene.onRender.splice(scene.onRender.indexOf(look), 1);
    const source = scene.element.querySelector('canvas');
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [source.width, source.height];
    const drawn = copy.getContext('2d', {willReadFrequently: true});
    drawn.drawImage(source, 0, 0);
    const {left, top, width, height} = source.getBoundingClientRect();
    const found = {own: {hits: 0, contrast: 0, coloured: 0}, others: {hits: 0, contrast: 0, coloured: 0}};
    const {looks, unknown} = scene.paint;
    const isShadeOf = (colour, base) => {
      const shade = (colour[0] + colour[1] + colour[2]) / (base[0] + base[1] + base[2]);
      return shade > 0.65 && shade < 1.1 && base.every((value, k) => Math.abs(colour[k] - shade * value) < 8);
    };
    for (let i = 1; i < 20; ++i)
      for (let j = 1; j < 20; ++j) {
        const x = width * i / 20, y = height * j / 20;
        const hit = scene.hitAt(left + x, top + y);
        if (!hit) continue;
        const of = hit.selection.building === store.value.selection?.building ? found.own : found.others;
        const colour = drawn.getImageData(x * copy.width / width, y * copy.height / height, 1, 1).data;
        ++of.hits;
        const label = store.value.labels.get(hit.selection.building)?.[hit.selection.feature] ?? -1;
        const look = (label < 0 ? unknown : looks[label]).colour;
        if (isShadeOf(colour, [1, 3, 5].map(at => parseInt(look.slice(at, at + 2), 16)))) ++of.coloured;
        of.contrast += Math.hypot(colour[0] - 0xf6, colour[1] - 0xf5, colour[2] - 0xf2);
      }
    done({own: found.own.hits, others: found.others.hits, ownColoured: found.own.coloured / found.own.hits, ownContrast: found.own.contrast / found.own.hits, otherContrast: found.others.contrast / found.others.hits});
  };
  scene.onRender.push(look);
  scene.requestRender();
}));

async function seesChosen({page, check}, width) {
  const chosen = await seen(page);
  check(chosen.own > 40 && chosen.ownColoured > 0.6, `a chosen building is what one sees, in its colours, at ${width} pixels: ${JSON.stringify(chosen)}`);
  check(chosen.otherContrast < 0.75 * chosen.ownContrast, 'and its neighbours are faded');
}

async function choosesOne({page, check, picture}) {
  await page.evaluate(() => document.activeElement.blur());
  await page.fill('#search', 'l-house.labelled');
  await page.press('#search', 'Enter');
  await page.waitForFunction(() => window.oriel.store.value.selection !== null);
  await seesChosen({page, check}, 1440);
  await picture('samples_chosen');
  await page.click('#tool-only');
  const alone = await seen(page);
  check(alone.others === 0 && alone.own > 40, 'only this building is drawn when that is asked for');
  await picture('samples_only');
  await page.click('#tool-only');
  check((await seen(page)).others > 0, 'and all others again');
  await page.keyboard.press('Escape');
}

export async function run({page, studio, check, picture}) {
  await page.goto(studio.address);
  await ready(page);
  await page.waitForFunction(count => window.oriel.store.value.geometry.size === count, kFiles.length);
  const lying = await page.evaluate(() => {
    const {buildings} = window.oriel.store.value;
    const meet = (a, b) => [0, 1].every(k => a.at_m[k] < b.at_m[k] + b.size_m[k] && b.at_m[k] < a.at_m[k] + a.size_m[k]);
    return buildings.filter((a, i) => buildings.some((b, j) => i < j && meet(a, b) && !a.away_m && !b.away_m)).length;
  });
  check(lying === 0, 'no house lies upon another');
  check(await cropped(page) === 0, 'all that are near are in the picture');
  const size = await page.evaluate(() => {
    const {scene} = window.oriel;
    const xs = scene.corners().map(corner => scene.project(corner).x);
    return (Math.max(...xs) - Math.min(...xs)) / scene.element.clientWidth;
  });
  check(size > 0.4, `they take ${Math.round(100 * size)} % of its width`);
  await page.click('#tab-list');
  const names = await page.locator('.list-name').allTextContents();
  check((await page.locator('.label-name').count()) > 8, 'names stand in the picture');
  check(names.includes('house.stripped') && names.includes('house.labelled'), `twins have the names of their files: ${names.join(', ')}`);
  check(/2 buildings lie too far away.*house-utm\.\w+ \(5,4\d\d km\)/.test(await page.textContent('.scene-note')), `what is far is said: ${await page.textContent('.scene-note')}`);
  await picture('samples_1440');
  await page.click('.scene-note .link >> nth=0');
  await page.waitForFunction(() => window.oriel.store.value.selection !== null);
  await picture('samples_far');
  await page.keyboard.press('Escape');
  await choosesOne({page, check, picture});
  await page.setViewportSize({width: 390, height: 844});
  await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
  await page.evaluate(() => window.oriel.scene.fly(null));
  check(await cropped(page) === 0, 'on a phone, too');
  await picture('samples_390');
  await page.evaluate(() => {
    const {store} = window.oriel;
    window.oriel.select({building: store.value.buildings.findIndex(({file}) => file.includes('l-house.labelled'))}, true);
  });
  await page.waitForFunction(() => window.oriel.store.value.selection !== null);
  await seesChosen({page, check}, 390);
  await picture('samples_chosen_390');
}
