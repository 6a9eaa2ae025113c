// Called by bundle.sh: bundles src/main.js and src/page.css with page.html into dist/index.html, one file, and writes dist/licences.txt
// from the packages that went into it.
import {build} from 'esbuild';
import {createHash} from 'node:crypto';
import {mkdirSync, readFileSync, readdirSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import {sourcesHash} from './sources_hash.mjs';

mkdirSync('dist', {recursive: true});
// What 3d-tiles-renderer can do with maps of vectors is not asked for, and so neither are the packages for them.
const common = {bundle: true, minify: true, target: 'es2022', format: 'iife', legalComments: 'none', metafile: true, charset: 'ascii',
  logLevel: 'warning', write: false};
const packages = new Set(), foreign = new Set();
async function bundled(file) {
  const result = await build({...common, entryPoints: [file]});
  for (const [input, {bytesInOutput}] of Object.entries(Object.values(result.metafile.outputs)[0].inputs)) {
    const match = input.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//);
    if (match && bytesInOutput > 0) packages.add(match[1]);
    if (/three\/examples\/jsm\/libs\//.test(input) && bytesInOutput > 0) foreign.add(input);
  }
  return result.outputFiles[0].text.trim();
}
const script = (await bundled('src/main.js')).replaceAll('</script', '<\\/script');
const style = await bundled('src/page.css');

// Only this script and this style may run in the page, whatever stands in the tiles.
const hashOf = text => `sha256-${createHash('sha256').update(text).digest('base64')}`;
let licences = 'The packages that are part of index.html, with their licences.\n';
for (const name of [...packages].sort()) {
  const folder = path.join('node_modules', name);
  const {version, license} = JSON.parse(readFileSync(path.join(folder, 'package.json'), 'utf8'));
  const file = readdirSync(folder).find(entry => /^licen[cs]e/i.test(entry));
  licences += `\n${'-'.repeat(80)}\n${name} ${version} (${license})\n\n`;
  licences += file ? readFileSync(path.join(folder, file), 'utf8').trim() + '\n' : 'Its package has no licence file.\n';
}
// three.js has files of others, whose first lines say whose they are.
for (const file of [...foreign].sort()) {
  const head = readFileSync(file, 'utf8').match(/^(?:\/\/.*\n)+/)?.[0] ?? '';
  licences += `\n${'-'.repeat(80)}\n${path.basename(file)}, with three\n\n${head.replaceAll(/^\/\/ ?/gm, '')}`;
}
const parts = {'script-hash': hashOf(script), 'style-hash': hashOf(style), style, script, licences: licences.replaceAll('--', '- -')};
writeFileSync('dist/index.html', readFileSync('page.html', 'utf8').replace(/{{([a-z-]+)}}/g, (_, part) => parts[part]));
writeFileSync('dist/licences.txt', licences);

// tests/tiles/bundle_test.mjs asks whether the bundle is of these sources.
writeFileSync('dist/sources.sha256', sourcesHash('.') + '\n');
