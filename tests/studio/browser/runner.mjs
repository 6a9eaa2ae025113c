// runner.mjs ORIEL CHROMIUM PACKAGES [STEP...]: runs the steps (see README.md), each with a studio and a page of its own.
import {mkdirSync, readdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import {Studio} from './studio.mjs';
import {Watch} from './watch.mjs';

const [oriel, executablePath, packages, ...wanted] = process.argv.slice(2);
const {chromium} = createRequire(path.join(packages, 'package.json'))('playwright-core');
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const pictures = process.env.ORIEL_PICTURES;

/** Runs a step with a studio and a page of its own and returns what did not hold. */
async function runStep(browser, file) {
  const step = await import(pathToFileURL(file));
  const failures = [];
  const check = (isTrue, what) => {
    console.log(isTrue ? '  ok  ' : '  FAIL', what);
    if (!isTrue) failures.push(what);
  };
  const begin = performance.now();
  console.log(step.title);
  const studio = await Studio.open(oriel, step.studio ?? {});
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, serviceWorkers: 'block', ...step.context});
  const page = await context.newPage();
  page.setDefaultTimeout(15_000);
  const watch = new Watch(page, studio.origin, step.expected ?? []);
  const picture = async name => {
    if (!pictures) return;
    mkdirSync(pictures, {recursive: true});
    await page.screenshot({path: path.join(pictures, `${name}.png`)});
  };
  try {
    await step.run({page, context, studio, watch, check, picture});
    check(watch.complaints.length === 0, `no error on the console${watch.complaints.map(text => `\n       ${text}`).join('')}`);
    check(watch.strangers.length === 0, `no request to another host${watch.strangers.map(text => `\n       ${text}`).join('')}`);
  } catch (error) {
    check(false, `${step.title}: ${error.message}`);
    const file = path.join(packages, 'failure.png');
    await page.screenshot({path: file}).then(() => console.log(`       picture: ${file}`), () => {});
    for (const text of watch.complaints) console.log(`       console: ${text}`);
  } finally {
    await context.close();
    const log = await studio.close();
    if (failures.length > 0 && log) console.log(log.replace(/^/gm, '       stderr: '));
  }
  console.log(`  ${((performance.now() - begin) / 1000).toFixed(1)} s`);
  return failures;
}

const browser = await chromium.launch({
  executablePath, headless: true,
  args: ['--no-sandbox', '--disable-gpu-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-first-run', '--disable-background-networking']
});
const failures = [];
try {
  const steps = readdirSync(path.join(here, 'steps')).filter(name => name.endsWith('.mjs')).sort();
  for (const name of steps) {
    if (wanted.length > 0 && !wanted.some(word => name.includes(word))) continue;
    const file = path.join(here, 'steps', name);
    // A browser that draws in software on a loaded machine misses a deadline now and then: what fails twice is a fault.
    if ((await runStep(browser, file)).length > 0) failures.push(...await runStep(browser, file));
  }
} finally {
  await browser.close();
}
if (failures.length > 0) console.log(`${failures.length} failed`);
process.exit(failures.length > 0 ? 1 : 0);
