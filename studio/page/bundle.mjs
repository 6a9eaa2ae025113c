// Called by bundle.sh: bundles src/main_studio.ts and src/main_view.ts into dist/ and writes dist/licences.txt from the packages
// that went into them.
import {build} from 'esbuild';
import {existsSync, readFileSync, readdirSync, writeFileSync, mkdirSync} from 'node:fs';
import path from 'node:path';

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
for (const name of ['studio', 'view']) {
  for (const kind of ['ts', 'css']) {
    const entry = `src/main_${name}.${kind}`;
    if (!existsSync(entry)) continue;
    const result = await build({...common, entryPoints: [entry], outfile: `dist/${name}.${kind === 'ts' ? 'js' : 'css'}`});
    for (const input of Object.keys(result.metafile.inputs)) {
      const match = input.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//);
      if (match) packages.add(match[1]);
    }
  }
}

let licences = 'The packages that are part of studio.js and view.js, with their licences.\n';
for (const name of [...packages].sort()) {
  const folder = path.join('node_modules', name);
  const {version, license} = JSON.parse(readFileSync(path.join(folder, 'package.json'), 'utf8'));
  const file = readdirSync(folder).find(entry => /^licen[cs]e/i.test(entry));
  licences += `\n${'-'.repeat(80)}\n${name} ${version} (${license})\n\n`;
  licences += file ? readFileSync(path.join(folder, file), 'utf8').trim() + '\n' : 'Its package has no licence file.\n';
}
writeFileSync('dist/licences.txt', licences);
