export {
  AmbientLight, Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide,
  LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, PerspectiveCamera, Raycaster, Scene, ShapeUtils,
  Vector2, Vector3, WebGLRenderer
} from 'three';
export {OrbitControls} from 'three/addons/controls/OrbitControls.js';
