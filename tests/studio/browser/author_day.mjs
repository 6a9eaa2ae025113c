// The day of an author on a desktop: from an empty pack to a saved one that finds the windows and doors of two houses, with a
// mistake and its fix, completion, a threshold dragged until F1 peaks, a wrong label corrected, a proposal accepted, the building
// at a scale, and a file that someone else has changed.
import {existsSync, readFileSync, writeFileSync} from 'node:fs';
import path from 'node:path';

import * as steps from './author_steps.mjs';
import {openPage, sizes, startStudio} from './studio.mjs';

const houses = ['house', 'row'];
const samples = houses.flatMap(name => [`${name}.stripped.city.json`, `${name}.truth.json`]);
const options = [...houses.map(name => `${name}.stripped.city.json`), '--rules', 'day.yaml', '--truth', ...houses.map(name => `${name}.truth.json`)];

const studio = await startStudio(samples, options, {'day.yaml': ''});
const packFile = path.join(studio.folder, 'day.yaml');
const {page, close, picture} = await openPage(studio.address, sizes.desktop);
const packOnDisk = () => readFileSync(packFile, 'utf8');
const correctionsFile = path.join(studio.folder, 'corrections.jsonl');
const correctionsOnDisk = () => (existsSync(correctionsFile) ? readFileSync(correctionsFile, 'utf8') : '');
const order = process.env.ONLY?.split(',');
const take = async (name, ...more) => {
  if (order && !order.includes(name)) return;
  const began = performance.now();
  try {
    await steps[name](page, picture, ...more);
  } catch (error) {
    error.message = `${name}: ${error.message}\n${studio.log().slice(-2000)}`;
    throw error;
  }
  console.log(`${name} ${Math.round(performance.now() - began)} ms`);
};

try {
  await take('beginPack');
  await take('mendMistake');
  await take('complete');
  await take('dragThreshold');
  await take('seeChanges');
  await take('seeTruth');
  await take('correctLabel', correctionsOnDisk);
  await take('learn');
  await take('generalise');
  await take('save', packOnDisk);
  await take('resolveConflict', packOnDisk, text => writeFileSync(packFile, text));
  await close();
} finally {
  await studio.stop();
}
