// Called by bundle.sh: bundles src/main_studio.ts into dist/studio.js and studio.css, src/main_view.ts with view.html into dist/view.html
// (one file, to which only the data are missing), and writes dist/licences.txt from the packages that went into them.
import {build} from 'esbuild';
import {createHash} from 'node:crypto';
import {mkdirSync, readFileSync, readdirSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import {sourcesHash} from './sources_hash.mjs';

mkdirSync('dist', {recursive: true});
// The page's materials are its own (scene/materials.ts), so the shaders that three.js brings for lit, textured and animated things are
// left out: more than a quarter of its size. Its sources are bundled file by file for that.
const kNeeded = /(colorspace_pars_fragment|tonemapping_pars_fragment)/;  // every program begins with them
const withoutShaders = {
  name: 'without-shaders',
  setup(bundler) {
    bundler.onResolve({filter: /^three$/}, () => ({path: path.resolve('node_modules/three/src/Three.js')}));
    bundler.onLoad({filter: /shaders[\\/](ShaderChunk|ShaderLib)[\\/].*\.glsl\.js$/},
      ({path: file}) => (kNeeded.test(file) ? undefined : {contents: exportsOf(readFileSync(file, 'utf8'))}));
  }
};
function exportsOf(text) {
  const names = [...text.matchAll(/export const (\w+)/g)].map(([, name]) => name);
  return names.length ? names.map(name => `export const ${name} = '';`).join('\n') : "export default '';";
}

const common = {bundle: true, minify: true, target: 'es2022', format: 'iife', legalComments: 'none', metafile: true, charset: 'ascii', logLevel: 'warning', plugins: [withoutShaders]};

const packages = new Set();
async function bundle(name) {
  const texts = {};
  for (const kind of ['ts', 'css']) {
    const result = await build({...common, entryPoints: [`src/main_${name}.${kind}`], write: false});
    texts[kind] = result.outputFiles[0].text.trim();
    for (const input of Object.keys(result.metafile.inputs)) {
      const match = input.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//);
      if (match) packages.add(match[1]);
    }
  }
  return texts;
}

const studio = await bundle('studio');
writeFileSync('dist/studio.js', studio.ts + '\n');
writeFileSync('dist/studio.css', studio.css + '\n');

// Only this script and this style may run in the page of a file, whatever stands in its data.
const view = await bundle('view');
const licencesOf = names => names.map(name => `${name}\n${licenceOf(name)}`).join('\n').replaceAll('--', '- -');
const script = view.ts.replaceAll('</script', '<\\/script');
const hashOf = text => `sha256-${createHash('sha256').update(text).digest('base64')}`;
const parts = {'script-hash': hashOf(script), 'style-hash': hashOf(view.css), style: view.css, script, data: '{{data}}',
  licences: licencesOf(['three', 'three-mesh-bvh'])};
writeFileSync('dist/view.html', readFileSync('view.html', 'utf8').replace(/{{([a-z-]+)}}/g, (_, part) => parts[part]));

let licences = 'The packages that are part of studio.js and view.html, with their licences.\n';
for (const name of [...packages].sort()) {
  const {version, license} = JSON.parse(readFileSync(path.join('node_modules', name, 'package.json'), 'utf8'));
  licences += `\n${'-'.repeat(80)}\n${name} ${version} (${license})\n\n${licenceOf(name)}`;
}
writeFileSync('dist/licences.txt', licences);

// tests/studio/page/bundle_test.mjs asks whether these bundles are of these sources.
writeFileSync('dist/sources.sha256', sourcesHash('.') + '\n');

function licenceOf(name) {
  const folder = path.join('node_modules', name);
  const file = readdirSync(folder).find(entry => /^licen[cs]e/i.test(entry));
  return file ? readFileSync(path.join(folder, file), 'utf8').trim() + '\n' : 'Its package has no licence file.\n';
}
