import {framesWhileLoading} from './20_building.mjs';

export const title = 'on a phone the building has most of the screen';
export const context = {viewport: {width: 390, height: 844}, hasTouch: true, isMobile: true, reducedMotion: 'reduce', deviceScaleFactor: 2};

const shareOf = page => page.evaluate(() => {
  const {width, height} = document.querySelector('#scene canvas').getBoundingClientRect();
  return width * height / (innerWidth * innerHeight);
});

export async function run(step) {
  const {page, check, picture} = step;
  await framesWhileLoading(step, 390);
  await page.evaluate(() => window.oriel.scene.fly(null));
  const whole = await shareOf(page);
  check(whole > 0.8, `at first ${Math.round(100 * whole)} % of it`);
  const {x, y, width, height} = await page.locator('#scene canvas').boundingBox();
  await page.touchscreen.tap(x + width / 2, y + height / 2);
  await page.waitForSelector('#chosen');
  const beside = await shareOf(page);
  check(beside > 0.45, `${Math.round(100 * beside)} % beside an explanation`);
  await picture('phone_part');
  check(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing is wider than the screen');
  await page.click('#tab-legend');
  check(await page.locator('.legend-row').first().isVisible(), 'the legend is a tab');
  const tall = await page.evaluate(() => Math.min(...[...document.querySelectorAll('.tab, .legend-row')].map(e => e.getBoundingClientRect().height)));
  check(tall >= 40, `what is tapped is ${tall} pixels high`);
  await page.click('#tab-legend');
  await page.waitForFunction(() => document.querySelector('#scene canvas').getBoundingClientRect().height > 0.8 * innerHeight);
  check(true, 'a second tap closes the sheet');
}
