import {existsSync, readFileSync, writeFileSync} from 'node:fs';

import * as author from '../author.mjs';

export const title = 'an author goes from an empty pack to a saved one that finds the windows and doors of three houses';

const houses = ['house', 'row', 'l-house'];

export const studio = {
  files: houses.flatMap(name => [`${name}.stripped.city.json`, `${name}.truth.json`]),
  open: houses.map(name => `${name}.stripped.city.json`),
  texts: {'day.yaml': ''},
  arguments: ['--rules', 'day.yaml', '--truth', ...houses.map(name => `${name}.truth.json`)]
};
export const context = {viewport: {width: 1440, height: 900}, reducedMotion: 'reduce', colorScheme: 'light'};
// A save over a file that has changed is answered with 409, which Chromium reports.
export const expected = ['409 (Conflict)'];

export async function run({page, studio: opened, check, picture}) {
  const read = name => (existsSync(opened.path(name)) ? readFileSync(opened.path(name), 'utf8') : '');
  const packOnDisk = () => read('day.yaml');
  await author.open(page, opened);
  let before = 0;
  const steps = [
    ['an empty editor offers a beginning that labels windows and doors', () => author.beginPack(page, picture)],
    ['a mistake is underlined while the labels stay, and its fix mends it', () => author.mendMistake(page, picture)],
    ['completion inside an expression knows attributes', () => author.complete(page, picture)],
    ['the smallest change that flips a label is told, and a click makes it',
      () => author.flip(page, picture, async feature => (await opened.ask('explain', {building: 0, feature})).flip !== null)],
    ['a threshold is dragged, F1 falls, and the labels that changed are listed', async () => { before = await author.dragThreshold(page, picture); }],
    ['a proposal changes the pack when it is accepted', () => author.learn(page, picture)],
    ['the curve leads back to the peak, and undo takes one step', () => author.findPeak(page, before)],
    ['a number of the confusion table leads to its parts', () => author.seeTruth(page, picture)],
    ['a label is corrected and the correction withdrawn', () => author.correctLabel(page, picture, () => read('corrections.jsonl'))],
    ['the slider of scales draws the generalised building', () => author.generalise(page, picture)],
    ['the pack is saved, after a look at what differs', () => author.save(page, picture, packOnDisk)],
    ['a file that someone else has changed is not overwritten silently',
      () => author.resolveConflict(page, picture, packOnDisk, text => writeFileSync(opened.path('day.yaml'), text))]
  ];
  for (const [what, step] of steps) {
    await step();
    check(true, what);
  }
}
