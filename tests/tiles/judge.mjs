// judge.mjs PACKAGES TILESET...: gltf-validator and 3d-tiles-tools find no fault in these folders.
import {readFileSync, readdirSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';

const [packages, ...folders] = process.argv.slice(2);
const require = createRequire(path.join(packages, 'package.json'));
const validator = require('gltf-validator');
const tools = require('3d-tiles-tools');
let faults = 0;
function check(isTrue, what) {
  if (isTrue) return;
  console.log('  FAIL', what);
  ++faults;
}

// What 3d-tiles-tools warns of is a fault.
for (const logger of Object.values(tools.Loggers.allLoggers))
  for (const level of ['warn', 'error', 'fatal']) logger[level] = (...words) => check(false, `3d-tiles-tools: ${words.join(' ')}`);

async function judgeGlb(folder, file) {
  const bytes = new Uint8Array(readFileSync(path.join(folder, file)));
  const report = await validator.validateBytes(bytes, {uri: file, maxIssues: 20});
  const {numErrors, numWarnings, messages} = report.issues;
  check(numErrors === 0 && numWarnings === 0, `gltf-validator: ${file}: ${JSON.stringify(messages.filter(m => m.severity < 2).slice(0, 3))}`);
}

/** The buildings of a GLB, as 3d-tiles-tools reads its property table. */
async function buildingsOf(folder, uri) {
  const glb = readFileSync(path.join(folder, uri)), size = glb.readUInt32LE(12);
  const head = JSON.parse(glb.subarray(20, 20 + size)), binary = glb.subarray(28 + size);
  const document = await (await tools.GltfTransform.getIO()).readBinary(new Uint8Array(glb));
  check(tools.StructuralMetadataUtils.createStructuralMetadataInfoString(document).includes('building'), `${uri}: no metadata`);
  const {schema, propertyTables: [propertyTable]} = head.extensions.EXT_structural_metadata;
  const enumValueTypes = {}, enumValueNameValues = {}, enumValueValueNames = {};
  for (const [name, {valueType, values}] of Object.entries(schema.enums)) {
    enumValueTypes[name] = valueType;
    enumValueNameValues[name] = Object.fromEntries(values.map(one => [one.name, one.value]));
    enumValueValueNames[name] = Object.fromEntries(values.map(one => [one.value, one.name]));
  }
  const model = new tools.BinaryPropertyTableModel({propertyTable, binaryMetadata: {
    metadataClass: schema.classes.feature,
    binaryEnumInfo: {enumValueTypes, enumValueNameValues, enumValueValueNames},
    binaryBufferStructure: {buffers: head.buffers, bufferViews: head.bufferViews},
    binaryBufferData: {buffersData: [binary], bufferViewsData: head.bufferViews.map(view => binary.subarray(view.byteOffset, view.byteOffset + view.byteLength))}
  }});
  const ids = new Set();
  for (let row = 0; row < propertyTable.count; ++row) {
    const entity = model.getMetadataEntityModel(row);
    ids.add(entity.getPropertyValue('building'));
    for (const name of ['id', 'rule', 'label', 'surface']) check(typeof entity.getPropertyValue(name) === 'string', `${uri}: ${name} of row ${row}`);
    check(entity.getPropertyValue('height') >= 0, `${uri}: height of row ${row}`);
  }
  return ids;
}

function holds(outer, inner) {
  const kSlack = 1e-6;
  return [0, 1, 2].every(i => {
    const half = 3 + 4 * i;
    return outer[i] - outer[half] <= inner[i] - inner[half] + kSlack && outer[i] + outer[half] >= inner[i] + inner[half] - kSlack;
  });
}

async function judge(folder) {
  const files = readdirSync(folder, {recursive: true}).filter(name => name.endsWith('.glb')).sort();
  for (const file of files) await judgeGlb(folder, file);
  const named = new Set(), seen = new Map();
  await new tools.TilesetTraverser(folder, tools.ResourceResolvers.createFileResourceResolver(folder), {depthFirst: true, traverseExternalTilesets: false})
    .traverse(JSON.parse(readFileSync(path.join(folder, 'tileset.json'), 'utf8')), async traversed => {
      const tile = traversed.asFinalTile(), parent = traversed.getParent()?.asFinalTile();
      if (parent) {
        check(parent.geometricError >= tile.geometricError, `${traversed}: an error greater than its parent's`);
        check(holds(parent.boundingVolume.box, tile.boundingVolume.box), `${traversed}: a box out of its parent's`);
      }
      for (const {uri} of traversed.getFinalContents()) {
        named.add(uri);
        const scale = tile.metadata.properties.scale, ids = await buildingsOf(folder, uri);
        check(ids.size === tile.metadata.properties.buildings, `${uri}: ${ids.size} buildings instead of ${tile.metadata.properties.buildings}`);
        for (const id of ids) {
          check(!seen.get(scale)?.has(id), `${id} twice at 1:${scale}`);
          seen.set(scale, (seen.get(scale) ?? new Set()).add(id));
        }
      }
      return true;
    });
  check(named.size === files.length && files.every(file => named.has(file)), `files that no tile names in ${folder}`);
  const packed = `${folder}.3tz`;
  await tools.TilesetConverter.convert(folder, 'tileset.json', packed, true).catch(fault => check(false, `3d-tiles-tools convert: ${fault.message}`));
  rmSync(packed, {force: true});
  console.log(`${path.basename(folder)}: ${files.length} tiles at ${seen.size} scales, ${Math.max(...[...seen.values()].map(ids => ids.size))} buildings`);
}

for (const folder of folders) await judge(folder);
console.log(faults === 0 ? 'gltf-validator and 3d-tiles-tools: no error, no warning' : `${faults} faults`);
process.exit(faults === 0 ? 0 : 1);
