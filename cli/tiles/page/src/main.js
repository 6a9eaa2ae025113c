// The page: streams tileset.json from beside it, says at which scale what is seen is drawn, and what lies under the pointer.
import {
  AmbientLight, Box3, Color, DirectionalLight, Matrix4, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {MeshoptDecoder} from 'three/addons/libs/meshopt_decoder.module.js';
import {TilesRenderer} from '3d-tiles-renderer/three';
import {GLTFExtensionsPlugin, GLTFMeshFeaturesExtension, GLTFStructuralMetadataExtension} from '3d-tiles-renderer/three/plugins';

const $ = id => document.getElementById(id);
const canvas = $('view');
const renderer = new WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
const scene = new Scene();
scene.background = new Color('#eef1f3');
scene.add(new AmbientLight('#ffffff', 1.6));
const sun = new DirectionalLight('#ffffff', 1.8);
sun.position.set(-0.5, 1, 0.8);
scene.add(sun);
const camera = new PerspectiveCamera(45, 1, 0.5, 1e6);
const controls = new OrbitControls(camera, canvas);
controls.maxPolarAngle = Math.PI / 2;
controls.zoomToCursor = true;

/** A tile is refined where what it leaves out is larger on the screen: ?pixels=8 asks for less. */
const kPixels = Number(new URLSearchParams(location.search).get('pixels')) || 4;

const tiles = new TilesRenderer(new URL('tileset.json', location.href).href);
tiles.registerPlugin(new GLTFExtensionsPlugin({
  metadata: false,
  rtc: false,
  meshoptDecoder: MeshoptDecoder,
  plugins: [() => new GLTFMeshFeaturesExtension(), () => new GLTFStructuralMetadataExtension()]
}));
// At the root of a server the renderer asks for //tiles/…, which not every server takes.
tiles.registerPlugin({name: 'ONE_SLASH', preprocessURL: url => String(url).replace(/([^:])\/\/+/g, '$1/')});
// Files of --gzip come as they are from a server that does not say what they are.
tiles.registerPlugin({name: 'GZIP', async fetchData(url, options) {
  const response = await fetch(url, options);
  if (!response.ok) return response;
  const content = await response.arrayBuffer(), bytes = new Uint8Array(content);
  const isGzip = bytes[0] === 0x1f && bytes[1] === 0x8b;
  return new Response(isGzip ? new Blob([content]).stream().pipeThrough(new DecompressionStream('gzip')) : content);
}});
tiles.errorTarget = kPixels;
tiles.setCamera(camera);
tiles.autoDisableRendererCulling = true;
scene.add(tiles.group);

// On the earth, the tiles are brought back to the frame they are made in, whose middle is the origin; y is up here.
const kUpright = new Matrix4().makeRotationX(-Math.PI / 2);
tiles.addEventListener('load-root-tileset', ({tileset}) => {
  const placed = new Matrix4();
  if (tileset.root.transform) placed.fromArray(tileset.root.transform);
  tiles.group.matrixAutoUpdate = false;
  tiles.group.matrix.copy(kUpright).multiply(placed.invert());
  tiles.group.matrix.decompose(tiles.group.position, tiles.group.quaternion, tiles.group.scale);
  tiles.group.updateMatrixWorld(true);
  const box = tileset.root.boundingVolume.box;
  const middle = new Vector3(box[0], box[2], -box[1]), half = new Vector3(box[3], box[11], box[7]);
  whole.set(middle.clone().sub(half), middle.clone().add(half));
  lookFrom(middle, 2.2 * Math.hypot(box[3], box[7], box[11]));
});
tiles.addEventListener('load-error', ({error, url}) => tell(`${url} cannot be loaded: ${error.message}`));
if (location.protocol === 'file:') tell('Browsers load tiles from servers only: start one in this folder, such as python3 -m http.server');

function tell(sentence) {
  $('fault').textContent = sentence;
  $('fault').hidden = false;
}

/** Round all buildings. */
const whole = new Box3();
function lookFrom(middle, distance) {
  controls.target.copy(middle);
  camera.position.copy(middle).addScaledVector(new Vector3(0.35, 0.6, 0.72).normalize(), distance);
  controls.update();
}

function resize() {
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setSize(innerWidth, innerHeight, false);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
  tiles.setResolutionFromRenderer(camera, renderer);
}
addEventListener('resize', resize);
resize();

/** What is seen: the scales at which all of it is drawn so, `from` to `to`; if there are none, those of its parts; how many buildings. */
function shown() {
  let from = 0, to = Infinity, finest = Infinity, buildings = 0;
  for (const tile of tiles.visibleTiles) {
    const known = tile.metadata?.properties;
    if (!known) continue;
    from = Math.max(from, known.scale);
    to = Math.min(to, known.coarsest);
    finest = Math.min(finest, known.scale);
    buildings += known.buildings;
  }
  return {from, to, finest, buildings};
}

const number = new Intl.NumberFormat('en');
function showScale() {
  const {from, to, finest, buildings} = shown();
  const scale = value => `1 : ${number.format(value)}`;
  $('scale').textContent = from === 0 ? '…' : from <= to ? scale(from) : `${scale(finest)} to ${scale(from)}`;
  $('count').textContent = buildings === 1 ? '1 building' : `${number.format(buildings)} buildings`;
}

// What lies under the pointer.
const raycaster = new Raycaster();
raycaster.firstHitOnly = true;
let pointer = null;
canvas.addEventListener('pointermove', event => { pointer = new Vector2(event.clientX / innerWidth * 2 - 1, 1 - event.clientY / innerHeight * 2); });
canvas.addEventListener('pointerleave', () => { pointer = null; showFeature(null); });

function featureAt(place) {
  raycaster.setFromCamera(place, camera);
  const hit = raycaster.intersectObject(tiles.group, true).find(({object}) => object.userData.meshFeatures);
  return hit ? featureOf(hit.object, hit.face.a) : null;
}

function featureOf(mesh, vertex) {
  const row = Math.round(mesh.geometry.getAttribute('_feature_id_0').getX(vertex));
  return mesh.userData.structuralMetadata.getPropertyTableData(0, row);
}

function showFeature(feature) {
  $('feature').hidden = !feature;
  if (!feature) return;
  $('label').textContent = feature.label;
  const rows = [['building', feature.building], ['id', feature.id], ['surface', feature.surface], ['rule', feature.rule],
    ['score', feature.score >= 0 ? feature.score.toFixed(2) : ''], ['height', `${feature.height.toFixed(2)} m`]];
  $('properties').replaceChildren(...rows.filter(([, value]) => value).flatMap(([name, value]) => {
    const term = document.createElement('dt'), meaning = document.createElement('dd');
    term.textContent = name;
    meaning.textContent = value;
    return [term, meaning];
  }));
}

canvas.addEventListener('keydown', event => {
  const turn = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]}[event.key];
  const zoom = {'+': 0.8, '=': 0.8, '-': 1.25}[event.key];
  if (!turn && !zoom) return;
  const way = camera.position.clone().sub(controls.target);
  if (zoom) way.multiplyScalar(zoom);
  if (turn) {
    const flat = Math.hypot(way.x, way.z), around = Math.atan2(way.x, way.z) + turn[0];
    const up = Math.min(1.5, Math.max(0.05, Math.atan2(way.y, flat) - turn[1])), length = way.length();
    way.set(Math.sin(around) * Math.cos(up), Math.sin(up), Math.cos(around) * Math.cos(up)).multiplyScalar(length);
  }
  camera.position.copy(controls.target).add(way);
  event.preventDefault();
});

/** Frames since something was loaded or another view was asked for. */
let quiet = 0;
function draw() {
  controls.update();
  camera.updateMatrixWorld();
  tiles.update();
  renderer.render(scene, camera);
  quiet = tiles.root && tiles.loadProgress === 1 ? quiet + 1 : 0;
  showScale();
  if (pointer) showFeature(featureAt(pointer));
}
renderer.setAnimationLoop(draw);

// What tests ask.
window.oriel = {
  shown,
  /** Looks from where an error of so many metres is as large as may be seen; returns how far that is. */
  lookAtError(error) {
    const distance = error * canvas.clientHeight / (2 * kPixels * Math.tan(camera.fov * Math.PI / 360));
    let near = 0, far = distance + whole.getSize(new Vector3()).length();
    for (let step = 0; step < 40; ++step) {  // renderers measure from the nearest point of the box
      lookFrom(whole.getCenter(new Vector3()), (near + far) / 2);
      if (whole.distanceToPoint(camera.position) < distance) near = (near + far) / 2; else far = (near + far) / 2;
    }
    quiet = 0;
    return distance;
  },
  isIdle: () => quiet >= 4 && tiles.visibleTiles.size > 0,
  anyFeature() {
    for (let y = -0.9; y < 1; y += 0.1)
      for (let x = -0.9; x < 1; x += 0.1) {
        const feature = featureAt(new Vector2(x, y));
        if (feature) return feature;
      }
    return null;
  },
  /** How often each building is seen. */
  buildings() {
    const counts = {};
    for (const tile of tiles.visibleTiles) {
      const ids = new Set();
      tile.engineData.scene.traverse(mesh => {
        if (!mesh.userData.meshFeatures) return;
        const named = new Set(mesh.geometry.getAttribute('_feature_id_0').array);
        for (const row of named) ids.add(mesh.userData.structuralMetadata.getPropertyTableData(0, Math.round(row)).building);
      });
      for (const id of ids) counts[id] = (counts[id] ?? 0) + 1;
    }
    return counts;
  }
};
