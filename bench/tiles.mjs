// tiles.mjs PACKAGES TILESET: bytes sent to view a whole city at each scale of a tileset, beside the leaves alone and beside an edge collapse
// (meshoptimizer's) of the leaves to the error that the tiles of that scale have. tiles.sh runs it.
import {readFileSync, statSync} from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';

const [packages, folder] = process.argv.slice(2);
const {MeshoptSimplifier} = createRequire(path.join(packages, 'package.json'))('meshoptimizer');
await MeshoptSimplifier.ready;

const scales = new Map(), leaves = [];
(function walk(tile) {
  if (tile.content) {
    const {scale, coarsest} = tile.metadata.properties, file = path.join(folder, tile.content.uri);
    const one = {scale, coarsest, error: tile.geometricError, file, bytes: statSync(file).size};
    scales.set(scale, [...(scales.get(scale) ?? []), one]);
    if (!tile.children) leaves.push(one);
  }
  for (const child of tile.children ?? []) walk(child);
})(JSON.parse(readFileSync(path.join(folder, 'tileset.json'), 'utf8')).root);

/** The welded meshes of the buildings of a tile. */
function buildings({file}) {
  const glb = readFileSync(file), size = glb.readUInt32LE(12), head = JSON.parse(glb.subarray(20, 20 + size)), binary = glb.subarray(28 + size);
  const view = number => {
    const {byteOffset, byteLength} = head.bufferViews[number];
    return Uint8Array.from(binary.subarray(byteOffset, byteOffset + byteLength)).buffer;
  };
  const {attributes, indices} = head.meshes[0].primitives[0], accessor = number => head.accessors[number];
  const points = new Float32Array(view(accessor(attributes.POSITION).bufferView)), rows = new Float32Array(view(accessor(attributes._FEATURE_ID_0).bufferView));
  const corners = new (accessor(indices).componentType === 5125 ? Uint32Array : Uint16Array)(view(accessor(indices).bufferView));
  const {building} = head.extensions.EXT_structural_metadata.propertyTables[0].properties;
  const offsets = new Uint32Array(view(building.stringOffsets)), letters = Buffer.from(view(building.values));
  const meshes = new Map();
  for (const corner of corners) {
    const id = letters.toString('utf8', offsets[rows[corner]], offsets[rows[corner] + 1]);
    if (!meshes.has(id)) meshes.set(id, {numbers: new Map(), points: [], corners: []});
    const mesh = meshes.get(id), place = points.slice(3 * corner, 3 * corner + 3), key = place.join();
    if (!mesh.numbers.has(key)) {
      mesh.numbers.set(key, mesh.numbers.size);
      mesh.points.push(...place);
    }
    mesh.corners.push(mesh.numbers.get(key));
  }
  return [...meshes.values()];
}

/** How many triangles an edge collapse leaves of a mesh if its error may be so large. */
function collapsed({points, corners}, error) {
  const positions = new Float32Array(points), relative = error / MeshoptSimplifier.getScale(positions, 3);
  return MeshoptSimplifier.simplify(new Uint32Array(corners), positions, 3, 0, relative)[0].length / 3;
}

const meshes = leaves.flatMap(buildings), sum = values => values.reduce((a, b) => a + b, 0);
const triangles = sum(meshes.map(mesh => mesh.corners.length / 3)), whole = sum(leaves.map(leaf => leaf.bytes));
const percent = part => `${(100 * part / whole).toFixed(1)} %`;
console.log('| scale | largest error | tiles of `oriel` | leaves only | edge collapse to that error |\n|---|---|---|---|---|');
for (const scale of [...scales.keys()].sort((a, b) => a - b)) {
  const seen = [...scales.values()].flat().filter(tile => tile.scale <= scale && scale <= tile.coarsest);
  const error = Math.max(...seen.map(tile => tile.error)), bytes = sum(seen.map(tile => tile.bytes));
  const left = sum(meshes.map(mesh => collapsed(mesh, error)));
  console.log(`| 1:${scale} | ${error.toFixed(2)} m | ${Math.round(bytes / 1000)} kB, ${percent(bytes)} | ${Math.round(whole / 1000)} kB, 100 % | ${
    Math.round(whole * left / triangles / 1000)} kB, ${percent(whole * left / triangles)} |`);
}
