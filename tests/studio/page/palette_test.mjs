// The colours of labels can be told apart by everybody: any two of them, and any of them and a wall or a roof, differ by a CIEDE2000 of
// at least 10, as most people see them and with deuteranopia, protanopia and tritanopia (Machado, Oliveira and Fernandes, 2009). And
// the committed bundles have these colours.
//   node tests/studio/page/palette_test.mjs
import {readFileSync} from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

const page = path.join(path.dirname(fileURLToPath(import.meta.url)), '../../../studio/page');
const palette = JSON.parse(readFileSync(path.join(page, '../../io/mesh/palette.json'), 'utf8'));
const kLeast = 10;
const kVisions = {
  'usual eyes': [1, 0, 0, 0, 1, 0, 0, 0, 1],
  deuteranopia: [0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881],
  protanopia: [0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998],
  tritanopia: [1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900]
};

const linear = c => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
const bounded = c => Math.max(0, Math.min(1, c));

function labOf(colour, vision) {
  const seen = [1, 3, 5].map(i => linear(parseInt(colour.slice(i, i + 2), 16) / 255));
  const [r, g, b] = [0, 3, 6].map(i => bounded(vision[i] * seen[0] + vision[i + 1] * seen[1] + vision[i + 2] * seen[2]));
  const x = (0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047;
  const y = 0.2126729 * r + 0.7151522 * g + 0.0721750 * b;
  const z = (0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883;
  const f = t => (t > 216 / 24389 ? Math.cbrt(t) : (24389 / 27 * t + 16) / 116);
  return [116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))];
}

/** CIEDE2000 (Sharma, Wu and Dalal, 2005). */
function difference([l1, a1, b1], [l2, a2, b2]) {
  const degrees = Math.PI / 180;
  const mean = (Math.hypot(a1, b1) + Math.hypot(a2, b2)) / 2;
  const g = 0.5 * (1 - Math.sqrt(mean ** 7 / (mean ** 7 + 25 ** 7)));
  const [p, q] = [(1 + g) * a1, (1 + g) * a2];
  const [c1, c2] = [Math.hypot(p, b1), Math.hypot(q, b2)];
  const hue = (b, a) => (a === 0 && b === 0 ? 0 : (Math.atan2(b, a) / degrees + 360) % 360);
  const [h1, h2] = [hue(b1, p), hue(b2, q)];
  const isGrey = c1 * c2 === 0;
  const turn = isGrey ? 0 : ((h2 - h1 + 540) % 360) - 180;
  const [dl, dc, dh] = [l2 - l1, c2 - c1, 2 * Math.sqrt(c1 * c2) * Math.sin(turn / 2 * degrees)];
  const [l, c] = [(l1 + l2) / 2, (c1 + c2) / 2];
  const h = isGrey ? h1 + h2 : Math.abs(h1 - h2) <= 180 ? (h1 + h2) / 2 : (h1 + h2 + (h1 + h2 < 360 ? 360 : -360)) / 2;
  const t = 1 - 0.17 * Math.cos((h - 30) * degrees) + 0.24 * Math.cos(2 * h * degrees) + 0.32 * Math.cos((3 * h + 6) * degrees) -
    0.2 * Math.cos((4 * h - 63) * degrees);
  const sl = 1 + 0.015 * (l - 50) ** 2 / Math.sqrt(20 + (l - 50) ** 2);
  const [sc, sh] = [1 + 0.045 * c, 1 + 0.015 * c * t];
  const rt = -2 * Math.sqrt(c ** 7 / (c ** 7 + 25 ** 7)) * Math.sin(60 * Math.exp(-(((h - 275) / 25) ** 2)) * degrees);
  return Math.sqrt((dl / sl) ** 2 + (dc / sc) ** 2 + (dh / sh) ** 2 + rt * dc / sc * dh / sh);
}

const failures = [];
const check = (isTrue, what) => { if (!isTrue) failures.push(what); };

// Two pairs of the paper's table, so that the difference is the right one.
check(Math.abs(difference([50, 2.6772, -79.7751], [50, 0, -82.7485]) - 2.0425) < 1e-4, 'CIEDE2000 of the first pair of the paper');
check(Math.abs(difference([50, 2.5, 0], [73, 25, -18]) - 27.1492) < 1e-4, 'CIEDE2000 of the seventeenth pair of the paper');

const surfaces = Object.values(palette.surfaces);
const least = {};
for (const [name, vision] of Object.entries(kVisions)) {
  const labels = palette.labels.map(colour => [colour, labOf(colour, vision)]);
  least[name] = Infinity;
  labels.forEach(([colour, lab], i) => {
    for (const [other, otherLab] of [...labels.slice(0, i), ...surfaces.map(surface => [surface, labOf(surface, vision)])]) {
      const found = difference(lab, otherLab);
      least[name] = Math.min(least[name], found);
      check(found >= kLeast, `${colour} and ${other} differ by ${found.toFixed(1)} with ${name}`);
    }
  });
}
check(palette.labels.length >= 16, 'there are sixteen colours');
check(Object.values(palette.usual).every(slot => slot < palette.labels.length), 'usual labels have colours that there are');
for (const file of ['studio.js', 'view.html']) {
  const bundle = readFileSync(path.join(page, 'dist', file), 'utf8');
  for (const colour of [...palette.labels, ...surfaces]) check(bundle.includes(colour), `${file} has ${colour}: run studio/page/bundle.sh`);
}

for (const failure of failures) console.log(`FAIL ${failure}`);
console.log(Object.entries(least).map(([name, found]) => `${name}: at least ${found.toFixed(1)}`).join(', '));
process.exit(failures.length > 0 ? 1 : 0);
