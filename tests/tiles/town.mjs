// town.mjs CITY.city.jsonl: the same stream with its buildings in a square, 25 m apart, instead of in one long row.
import {readFileSync, writeFileSync} from 'node:fs';

const kApart_m = 25;
const file = process.argv[2];
const [header, ...lines] = readFileSync(file, 'utf8').trim().split('\n');
const {scale, translate} = JSON.parse(header).transform, across = Math.ceil(Math.sqrt(lines.length));
const placed = lines.map((line, number) => {
  const feature = JSON.parse(line);
  const shift = [number % across, Math.floor(number / across), null].map((cell, axis) =>
    cell === null ? 0 : Math.round((kApart_m * cell - translate[axis]) / scale[axis]) - Math.min(...feature.vertices.map(vertex => vertex[axis])));
  feature.vertices = feature.vertices.map(vertex => vertex.map((value, axis) => value + shift[axis]));
  return JSON.stringify(feature);
});
writeFileSync(file, [header, ...placed].join('\n') + '\n');
