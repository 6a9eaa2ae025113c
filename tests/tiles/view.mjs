// view.mjs PACKAGES CHROMIUM TILESET BUILDINGS: the page of --viewer, from far to near. With ORIEL_PICTURES pictures go to that folder,
// and nothing is expected of what they show; ORIEL_PIXELS is how large on the screen an error may be: the larger, the nearer the views.
import {existsSync, mkdirSync, readFileSync} from 'node:fs';
import {createServer} from 'node:http';
import {createRequire} from 'node:module';
import path from 'node:path';
import {gunzipSync} from 'node:zlib';

const [packages, executablePath, folder, count] = process.argv.slice(2);
const {chromium} = createRequire(path.join(packages, 'package.json'))('playwright-core');
const [width, height] = (process.env.ORIEL_SIZE ?? '800x600').split('x').map(Number);
const kTypes = {'.html': 'text/html', '.json': 'application/json', '.glb': 'model/gltf-binary'};
let faults = 0, archives = 0;
function check(isTrue, what) {
  console.log(isTrue ? '  ok  ' : '  FAIL', what);
  if (!isTrue) ++faults;
}

const server = createServer((request, response) => {
  const file = path.join(folder, decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
  if (!file.startsWith(folder) || !existsSync(file)) return response.writeHead(404).end();
  // Some servers say that a file is a gzip archive, others do not know.
  const bytes = readFileSync(file), isArchive = bytes[0] === 0x1f && bytes[1] === 0x8b, isTold = isArchive && ++archives % 2 === 0;
  response.writeHead(200, {'content-type': kTypes[path.extname(file)] ?? 'application/octet-stream', ...(isTold && {'content-encoding': 'gzip'})});
  response.end(bytes);
});
await new Promise(resolve => server.listen(0, '127.0.0.1', resolve));
const origin = `http://127.0.0.1:${server.address().port}`;

// Of each scale the largest error of a tile that has it, which is not to be seen, and the smallest of a tile that one of them takes the
// place of, which is.
const levels = new Map(), text = readFileSync(path.join(folder, 'tileset.json'));
const {root} = JSON.parse(text[0] === 0x1f ? gunzipSync(text) : text);
function walk(tile, visit, above = Infinity) {
  if (tile.metadata) visit(tile.metadata.properties, tile.geometricError, above);
  for (const child of tile.children ?? []) walk(child, visit, tile.geometricError);
}
walk(root, ({scale}) => levels.set(scale, {own: 0, over: Infinity}));
walk(root, ({scale, coarsest}, own, above) => {
  for (const [at, level] of levels)
    if (scale <= at && at <= coarsest) levels.set(at, {own: Math.max(level.own, own), over: Math.min(level.over, above)});
});
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
  await page.waitForFunction(() => window.oriel?.isIdle(), null, {timeout: 60_000});
  for (const [step, scale] of scales.entries()) {
    const {own, over} = levels.get(scale);
    const error = over === Infinity ? 2 * own : own > 0 ? Math.sqrt(own * over) : over / 2;
    const distance = await page.evaluate(error => window.oriel.lookAtError(error), error);
    await page.waitForFunction(() => window.oriel.isIdle(), null, {timeout: 60_000});
    if (process.env.ORIEL_PICTURES) {
      mkdirSync(process.env.ORIEL_PICTURES, {recursive: true});
      await page.screenshot({path: path.join(process.env.ORIEL_PICTURES, `tiles-${step + 1}.jpg`), quality: 80});
      console.log(`  1:${scale} from ${distance.toFixed(0)} m`);
      continue;
    }
    const {shown, buildings} = await page.evaluate(() => ({shown: window.oriel.shown(), buildings: window.oriel.buildings()}));
    check(shown.from <= scale && scale <= shown.to, `from ${distance.toFixed(0)} m: 1:${shown.from} to 1:${shown.to}, expected 1:${scale}`);
    check(Object.keys(buildings).length === Number(count) && Object.values(buildings).every(n => n === 1), `every one of ${count} buildings once`);
    check((await page.textContent('#scale')).replaceAll(/[ ,]/g, '') === `1:${shown.from}`, 'the read-out says so');
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
