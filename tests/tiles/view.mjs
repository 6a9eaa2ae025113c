// view.mjs PACKAGES CHROMIUM TILESET BUILDINGS: the page of --viewer, from far to near. With ORIEL_PICTURES pictures go to that folder;
// ORIEL_PIXELS is how large on the screen an error may be: the larger, the nearer the views.
import {createReadStream, existsSync, mkdirSync, readFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {createRequire} from 'node:module';
import path from 'node:path';

const [packages, executablePath, folder, count] = process.argv.slice(2);
const {chromium} = createRequire(path.join(packages, 'package.json'))('playwright-core');
const [width, height] = (process.env.ORIEL_SIZE ?? '800x600').split('x').map(Number);
const kTypes = {'.html': 'text/html', '.json': 'application/json', '.glb': 'model/gltf-binary'};
let faults = 0;
function check(isTrue, what) {
  console.log(isTrue ? '  ok  ' : '  FAIL', what);
  if (!isTrue) ++faults;
}

const server = createServer((request, response) => {
  const file = path.join(folder, decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
  if (!file.startsWith(folder) || !existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, {'content-type': kTypes[path.extname(file)] ?? 'application/octet-stream'});
  createReadStream(file).pipe(response);
});
await new Promise(resolve => server.listen(0, '127.0.0.1', resolve));
const origin = `http://127.0.0.1:${server.address().port}`;

// The chain of the first leaf: its scales and errors say what is expected.
const levels = new Map();
(function walk(tile) {
  const scale = tile.metadata?.properties.scale;
  if (scale) levels.set(scale, Math.max(levels.get(scale) ?? 0, tile.geometricError));
  for (const child of tile.children ?? []) walk(child);
})(JSON.parse(readFileSync(path.join(folder, 'tileset.json'), 'utf8')).root);
const scales = [...levels.keys()].sort((a, b) => b - a);

const browser = await chromium.launch({executablePath, headless: true,
  args: ['--no-sandbox', '--disable-gpu-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-first-run', '--disable-background-networking']});
const complaints = [], strangers = [];
try {
  const page = await browser.newPage({viewport: {width, height}});
  page.on('console', message => {
    if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver|swiftshader|versions at 1.1 or higher/.test(message.text())) complaints.push(message.text());
  });
  page.on('pageerror', error => complaints.push(error.message));
  page.on('request', request => { if (!/^(blob|data):/.test(request.url()) && !request.url().startsWith(origin)) strangers.push(request.url()); });
  await page.goto(`${origin}/index.html?pixels=${process.env.ORIEL_PIXELS ?? 1}`);
  await page.waitForFunction(() => window.oriel?.isIdle(), null, {timeout: 20_000});
  for (const [step, scale] of scales.entries()) {
    // Between the error of this scale, which is not to be seen, and that of the coarser one, which is.
    const coarser = step === 0 ? 2 * levels.get(scale) : levels.get(scales[step - 1]);
    const error = levels.get(scale) > 0 ? Math.sqrt(levels.get(scale) * coarser) : coarser / 2;
    const distance = await page.evaluate(error => window.oriel.lookAtError(error), error);
    await page.waitForFunction(() => window.oriel.isIdle(), null, {timeout: 20_000});
    const {shown, buildings} = await page.evaluate(() => ({shown: window.oriel.shown(), buildings: window.oriel.buildings()}));
    check(shown.from <= scale && scale <= shown.to, `from ${distance.toFixed(0)} m: 1:${shown.from} to 1:${shown.to}, expected 1:${scale}`);
    check(Object.keys(buildings).length === Number(count) && Object.values(buildings).every(n => n === 1), `every one of ${count} buildings once`);
    check((await page.textContent('#scale')).replaceAll(/[ ,]/g, '') === `1:${shown.from}`, 'the read-out says so');
    if (process.env.ORIEL_PICTURES) {
      mkdirSync(process.env.ORIEL_PICTURES, {recursive: true});
      await page.screenshot({path: path.join(process.env.ORIEL_PICTURES, `tiles-${step + 1}.png`)});
    }
  }
  const label = await page.evaluate(() => window.oriel.anyFeature()?.label);
  check(Boolean(label), `a feature is known by its label: ${label}`);
  check(strangers.length === 0, `no request to another host${strangers.map(text => `\n       ${text}`).join('')}`);
} catch (error) {
  check(false, error.message);
} finally {
  await browser.close();
  server.close();
}
check(complaints.length === 0, `no error on the console${complaints.map(text => `\n       ${text}`).join('')}`);
process.exit(faults === 0 ? 0 : 1);
