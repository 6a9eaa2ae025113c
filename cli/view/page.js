// The page that `oriel view` writes. docs/formats.md says what the data are; THREE is three.min.js.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);
const $ = id => document.getElementById(id);
const colours = {
  window: 0x3f8fd2, door: 0x8a5a2b, chimney: 0xb5442e, vent: 0x7d6a9a, dormer: 0xe08a2c, balcony: 0x3f9a6b,
  canopy: 0x9abf3c, loggia: 0x2fa6a0, bay: 0xc76aa8, stairs: 0x8c8c55,
  WallSurface: 0xe6e0d4, RoofSurface: 0xcfa79a, GroundSurface: 0xb9b5ab, OuterCeilingSurface: 0xd8d3c2,
  OuterFloorSurface: 0xc4cdb8, ClosureSurface: 0xdadada, selected: 0xffd400
};
const further = [0x5b7fb0, 0xb07f5b, 0x5bb07f, 0xa05bb0, 0xb0a25b, 0x5bb0b0];
data.labels.filter(label => !(label in colours))
  .forEach((label, i) => { colours[label] = further[i % further.length]; });

// Elements: el('td', {className: 'holds'}, 'text', child…).
function el(name, members, ...children) {
  const element = Object.assign(document.createElement(name), members);
  element.append(...children);
  return element;
}

// ---- what there is ----

// A polygon shows the smallest feature with a label that it lies in, else the smallest one.
function shownFeature(building, polygon) {
  const owners = polygon.owners;
  return owners.find(f => building.features[f].label) ?? owners[0];
}

function colourOf(building, polygon) {
  const feature = building.features[shownFeature(building, polygon)];
  return feature?.label ? colours[feature.label] : colours[polygon.surface] ?? colours.WallSurface;
}

const point = (building, v) => new THREE.Vector3(...building.vertices_mm.slice(3 * v, 3 * v + 3).map(mm => mm / 1000));

// Newell's normal of a ring, as long as twice its area.
function normalOf(points) {
  const sum = new THREE.Vector3();
  points.forEach((p, i) => {
    const q = points[(i + 1) % points.length];
    sum.add(new THREE.Vector3((p.y - q.y) * (p.z + q.z), (p.z - q.z) * (p.x + q.x), (p.x - q.x) * (p.y + q.y)));
  });
  return sum;
}

// The triangles of a polygon as points: seen along the axis nearest to its normal.
function triangles(rings) {
  const n = normalOf(rings[0]).toArray().map(Math.abs);
  const [u, v] = n[2] >= n[0] && n[2] >= n[1] ? ['x', 'y'] : n[0] >= n[1] ? ['y', 'z'] : ['x', 'z'];
  const flat = rings.map(ring => ring.map(p => new THREE.Vector2(p[u], p[v])));
  const points = rings.flat();
  return THREE.ShapeUtils.triangulateShape(flat[0], flat.slice(1)).flat().map(i => points[i]);
}

// The edges between polygons that are tilted against each other, or that are shown as different things.
function edgesOf(parts) {
  const kCoplanar = Math.cos(5 * Math.PI / 180);
  const edges = new Map();
  for (const part of parts)
    for (const ring of part.polygon.rings)
      ring.forEach((v, i) => {
        const ends = [v, ring[(i + 1) % ring.length]].sort((a, b) => a - b);
        const key = `${part.building.number} ${ends}`;
        if (!edges.has(key)) edges.set(key, {building: part.building, ends, sides: []});
        edges.get(key).sides.push(part);
      });
  const isSeen = ([p, q, more]) => !q || more || p.normal.dot(q.normal) < kCoplanar * p.normal.length() * q.normal.length() ||
    shownFeature(p.building, p.polygon) !== shownFeature(q.building, q.polygon) || p.polygon.surface !== q.polygon.surface;
  return [...edges.values()].filter(({sides}) => isSeen(sides))
    .flatMap(({building, ends}) => ends.flatMap(v => point(building, v).toArray()));
}

function geometryOf(numbers) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(numbers), 3));
  return geometry;
}

// One mesh of all buildings; `corners` says where the corners of each polygon begin and end.
function meshOf(model) {
  const positions = [], parts = [];
  model.buildings.forEach((building, number) => { building.number = number; });
  for (const building of model.buildings)
    for (const polygon of building.polygons) {
      const begin = positions.length / 3;
      const rings = polygon.rings.map(ring => ring.map(v => point(building, v)));
      for (const p of triangles(rings)) positions.push(p.x, p.y, p.z);
      parts.push({building, polygon, begin, end: positions.length / 3, normal: normalOf(rings[0])});
    }
  const geometry = geometryOf(positions);
  geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(positions.length), 3));
  const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({
    vertexColors: true, flatShading: true, side: THREE.DoubleSide,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1
  }));
  mesh.add(new THREE.LineSegments(geometryOf(edgesOf(parts)), new THREE.LineBasicMaterial({color: 0x4a5560})));
  return {mesh, parts};
}

function paint(shown, selection) {
  const colour = shown.mesh.geometry.getAttribute('color');
  for (const part of shown.parts) {
    const c = new THREE.Color(isSelected(part, selection) ? colours.selected : colourOf(part.building, part.polygon));
    for (let i = part.begin; i < part.end; ++i) colour.setXYZ(i, c.r, c.g, c.b);
  }
  colour.needsUpdate = true;
}

function isSelected(part, selection) {
  if (!selection || part.building !== selection.building) return false;
  if (selection.feature !== undefined) return part.polygon.owners.includes(selection.feature);
  return !selection.polygon || part.polygon === selection.polygon;
}

// ---- the scene ----

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 1e5);
camera.up.set(0, 0, 1);
const sun = new THREE.DirectionalLight(0xffffff, 1.9);
scene.add(new THREE.AmbientLight(0xffffff, 1.5), camera);
camera.add(sun);
sun.position.set(0.5, 0.8, 1);
let renderer, controls;

function render() {
  renderer?.render(scene, camera);
}

function resize() {
  const {clientWidth: width, clientHeight: height} = $('scene');
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  renderer.setSize(width, height);
  render();
}

// Looks at a box from a direction.
function look(box, direction) {
  const centre = box.getCenter(new THREE.Vector3());
  const distance = Math.max(7, 1.3 * box.getSize(new THREE.Vector3()).length());
  camera.position.copy(centre).addScaledVector(direction.normalize(), distance);
  camera.near = distance / 100;
  camera.far = distance * 1000;
  camera.updateProjectionMatrix();
  camera.lookAt(centre);
  if (controls) controls.target.copy(centre);
  controls?.update();
  render();
}

function boxOf(parts) {
  const box = new THREE.Box3();
  for (const part of parts)
    for (const ring of part.polygon.rings) for (const v of ring) box.expandByPoint(point(part.building, v));
  return box;
}

// To the selection from outside and a little above; to all if nothing is selected.
function fly(selection) {
  const parts = selection ? shown.parts.filter(part => isSelected(part, selection)) : shown.parts;
  if (parts.length === 0) return;
  const direction = new THREE.Vector3(0.5, -0.8, 0.55);
  if (selection && (selection.polygon || selection.feature !== undefined)) {
    const outside = new THREE.Vector3();
    for (const part of parts) outside.add(part.normal);
    if (outside.length() > 0) direction.multiplyScalar(0.6).add(outside.normalize());
  }
  look(boxOf(parts), direction);
}

// ---- the panel ----

const text = i => data.strings[i];

function rowOf(i) {
  const [indent, mark, found, bound, place] = data.rows[i];
  return {indent, mark: text(mark), found: text(found), bound: text(bound), place: text(place)};
}

// Why a rule does not decide, in short: the first condition that fails or vetoes.
function obstacle(conditions) {
  const c = conditions.find(({mark}) => ['fails', 'vetoes', 'unknown'].includes(mark));
  return c ? `: ${c.found} ${c.bound}` : '';
}

function ruleElement(rows, isOpen) {
  const [rule, ...conditions] = rows;
  const word = rule.found.split(',')[0];
  const summary = el('summary', {}, el('code', {}, rule.mark), ` → ${rule.bound} `,
    el('span', {className: word}, rule.found), el('span', {className: 'quiet'}, word === 'holds' ? '' : obstacle(conditions)));
  const table = el('table', {}, ...conditions.map(c => el('tr', {title: c.place},
    el('td', {className: c.mark, style: `padding-left:${(c.indent - 4) / 2 + 1}em`}, c.mark),
    el('td', {}, c.found), el('td', {className: 'quiet'}, c.bound))));
  return el('details', {open: isOpen}, summary, table, el('span', {className: 'quiet'}, rule.place));
}

// Rules of predicates hold without a score; of those for labels one has decided.
function showFeature(building, feature) {
  const rules = feature.rules.map(rows => rows.map(rowOf));
  const isDeciding = ([rule]) => rule.mark === feature.rule;
  const isReason = rows => isDeciding(rows) || rows[0].found === 'holds';
  const list = (id, some) => el('div', {id}, ...some.map(rows => ruleElement(rows, isDeciding(rows))));
  return [
    el('h2', {id: 'chosen'}, feature.label || 'unknown'),
    el('div', {id: 'name'}, feature.name),
    el('div', {}, 'feature ', el('code', {}, feature.id), ' of ', el('code', {}, building.id)),
    el('p', {id: 'head'}, feature.head),
    ...feature.rounds.map((round, i) => el('div', {}, `round ${i + 1}: ${text(round)}`)),
    el('h3', {}, 'Why'), list('why', rules.filter(isReason)),
    el('h3', {}, 'Why not'), list('whynot', rules.filter(rows => !isReason(rows)))
  ];
}

function showSurface(building, polygon) {
  return [
    el('h2', {id: 'chosen'}, polygon.surface || 'no surface'),
    el('div', {}, `polygon ${polygon.source} of `, el('code', {}, building.id)),
    el('pre', {id: 'why'}, polygon.why.map(text).join('\n'))
  ];
}

// What else the polygon lies in, from the inside to the outside, each to be chosen.
function showOwners({building, polygon, feature}) {
  if (!polygon || polygon.owners.length === 0) return [];
  const choice = (name, chosen) => el('button', {type: 'button', onclick: () => select(chosen),
    ariaPressed: String(chosen.feature === feature)}, name);
  return [el('p', {id: 'owners'}, ...polygon.owners.map(f => choice(building.features[f].label || building.features[f].id,
    {building, polygon, feature: f})), choice(polygon.surface, {building, polygon}))];
}

function showPanel(selection) {
  if (!selection) return [el('p', {className: 'quiet'}, 'Click on the building: what it is called there, why, and why not something else.')];
  const {building, polygon, feature} = selection;
  if (feature !== undefined) return [...showOwners(selection), ...showFeature(building, building.features[feature])];
  if (polygon) return [...showOwners(selection), ...showSurface(building, polygon)];
  return [el('h2', {id: 'chosen'}, building.id), el('p', {}, `${building.features.length} features`), ...building.issues.map(i => el('p', {}, text(i)))];
}

// ---- what the reader does ----

let shown;
let selection;

function select(chosen) {
  selection = chosen;
  $('panel').replaceChildren(...showPanel(chosen));
  paint(shown, chosen);
  render();
}

function pick(event) {
  const area = renderer.domElement.getBoundingClientRect();
  const at = new THREE.Vector2(2 * (event.clientX - area.left) / area.width - 1, 1 - 2 * (event.clientY - area.top) / area.height);
  const ray = new THREE.Raycaster();
  ray.setFromCamera(at, camera);
  const hit = ray.intersectObject(shown.mesh, false)[0];
  if (!hit) return select();
  const corner = 3 * hit.faceIndex;
  const {building, polygon} = shown.parts.find(part => corner < part.end);
  select({building, polygon, feature: shownFeature(building, polygon)});
}

// As `oriel explain` reads names: case, commas and the number of spaces do not count.
const plain = text => text.toLowerCase().split(/[,\s]+/).filter(Boolean).join(' ');

// The first feature or building with that id or name, else the first of which it is the beginning, of names by whole words if there is one.
function find(text) {
  const meant = plain(text ?? '');
  if (!meant) return undefined;
  for (const isMatch of [other => other === text, other => plain(other) === meant, other => plain(other).startsWith(meant + ' '),
    other => other.startsWith(text), other => plain(other).startsWith(meant)])
    for (const building of shown.model.buildings) {
      const feature = building.features.findIndex(f => isMatch(f.id) || isMatch(f.name));
      if (feature >= 0) return {building, feature};
      if (isMatch(building.id)) return {building};
    }
  return undefined;
}

function search(id) {
  const found = find(id);
  select(found);
  if (found) fly(found);
  else $('panel').replaceChildren(el('p', {id: 'chosen'}, `no id and no name begins with '${id}'`));
}

function showLegend(model) {
  const counts = new Map();
  for (const building of model.buildings)
    for (const feature of building.features) if (feature.label) counts.set(feature.label, (counts.get(feature.label) ?? 0) + 1);
  $('legend').replaceChildren(...data.labels.filter(label => counts.has(label)).map(label => el('li', {},
    el('span', {className: 'patch', style: `background:#${colours[label].toString(16).padStart(6, '0')}`}),
    `${label} ${counts.get(label)}`)));
}

const models = data.models.map(model => ({model, ...meshOf(model)}));

function showModel(index) {
  const before = selection;
  if (shown) scene.remove(shown.mesh);
  shown = models[index];
  scene.add(shown.mesh);
  [...$('models').children].forEach((button, i) => { button.ariaPressed = String(i === index); });
  showLegend(shown.model);
  // What has the same id in the other model stays chosen.
  select(before && before.feature !== undefined ? find(before.building.features[before.feature].id) : undefined);
}

// A click, and not the end of turning the scene.
function listenForClicks(canvas) {
  let down;
  canvas.addEventListener('pointerdown', event => { down = event; });
  canvas.addEventListener('pointerup', event => {
    if (down && Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) < 4) pick(event);
  });
}

function start() {
  if (models.length > 1)
    $('models').replaceChildren(...models.map((m, i) => el('button', {type: 'button', title: m.model.name,
      onclick: () => showModel(i)}, i === 0 ? 'before' : 'after')));
  $('search').addEventListener('submit', event => {
    event.preventDefault();
    search(event.target.elements.id.value.trim());
  });
  addEventListener('keydown', event => { if (event.key === 'Escape') select(); });
  try {
    renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
    renderer.setPixelRatio(devicePixelRatio);
    renderer.setClearColor(0xeef2f6);
    $('scene').append(renderer.domElement);
    controls = new THREE.OrbitControls(camera, renderer.domElement);
    controls.addEventListener('change', render);
    listenForClicks(renderer.domElement);
    addEventListener('resize', resize);
  } catch (error) {
    $('scene').append(el('p', {}, `This browser draws no WebGL (${error.message}); search by id works.`));
  }
  showModel(0);
  if (renderer) resize();
  fly();
  if (location.hash) search(decodeURIComponent(location.hash.slice(1)));
  document.documentElement.dataset.ready = 'yes';
}

start();
