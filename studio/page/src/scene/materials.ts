// How faces and lines are drawn. A face looks up its polygon's entry in `state` (paint.ts): red is the number of its colour in
// `palette`, green are flags.
import {
  AlwaysStencilFunc, BackSide, DataTexture, DecrementWrapStencilOp, DoubleSide, FrontSide, GLSL3, GreaterDepth, IncrementWrapStencilOp, NearestFilter,
  NotEqualStencilFunc, RGBAFormat, ShaderMaterial, UnsignedByteType, Vector3, Vector4, ZeroStencilOp
} from 'three';
import type {Materials} from './chunk';

export const kStateWidth = 2048;
/** `open`: its building is no closed body; `through`: what lies behind shines through. */
export const kFlag = {hidden: 1, selected: 2, hover: 4, changed: 8, found: 16, faint: 32, open: 64, through: 128};

export interface Uniforms {
  [name: string]: {value: unknown};
  state: {value: DataTexture}; palette: {value: DataTexture}; cut: {value: Vector4}; period: {value: number}; brightness: {value: number};
  ground: {value: Vector3}; accent: {value: Vector3}; change: {value: Vector3}; edge: {value: Vector3};
}

export function stateTexture(rows: number): DataTexture {
  const texture = new DataTexture(new Uint8Array(4 * kStateWidth * rows), kStateWidth, rows, RGBAFormat, UnsignedByteType);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

export function paletteTexture(): DataTexture {
  const texture = new DataTexture(new Uint8Array(4 * 256), 256, 1, RGBAFormat, UnsignedByteType);
  texture.minFilter = texture.magFilter = NearestFilter;
  return texture;
}

export function makeUniforms(): Uniforms {
  return {
    state: {value: stateTexture(1)}, palette: {value: paletteTexture()}, cut: {value: new Vector4(0, 0, 0, 0)}, period: {value: 0.3}, brightness: {value: 1},
    ground: {value: new Vector3(1, 1, 1)}, accent: {value: new Vector3()}, change: {value: new Vector3()}, edge: {value: new Vector3()}
  };
}

const kLookUp = `
  uniform sampler2D state;
  ivec4 entryOf(float number) {
    int n = int(number + .5);
    return ivec4(texelFetch(state, ivec2(n % ${kStateWidth}, n / ${kStateWidth}), 0) * 255. + .5);
  }`;

const kFaceVertex = `
  in float number;
  out vec3 vNormal;
  out vec3 vWorld;
  out vec2 vPlane;
  flat out ivec4 vEntry;
  ${kLookUp}
  void main() {
    vEntry = entryOf(number);
    vNormal = normalize(normalMatrix * normal);
    vWorld = position;
    // Level and upwards in the polygon's plane, north in a level one: patterns lie in them.
    float level = length(normal.xy);
    vec3 u = level < 1e-3 ? vec3(1., 0., 0.) : vec3(-normal.y, normal.x, 0.) / level;
    vec3 v = level < 1e-3 ? vec3(0., 1., 0.) : vec3(-u.y * normal.z, u.x * normal.z, level);
    vPlane = vec2(dot(position, u), dot(position, v));
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.);
    if ((vEntry.g & ${kFlag.hidden}) != 0) gl_Position = vec4(2., 2., 2., 1.);
  }`;

const kFaceFragment = `
  uniform sampler2D palette;
  uniform vec4 cut;
  uniform float period;
  uniform vec3 ground, accent, change;
  uniform float brightness;
  in vec3 vNormal;
  in vec3 vWorld;
  in vec2 vPlane;
  flat in ivec4 vEntry;
  out vec4 colour;

  // The share of a line of half a width w around whole numbers of t, smoothed over a pixel.
  float line(float t, float w) {
    float d = abs(fract(t) - .5);
    float f = max(fwidth(t), 1e-4);
    return mix(smoothstep(w + f, w - f, .5 - d), 2. * w, smoothstep(.4, 1.2, f));
  }
  float dot_(vec2 p, float r) {
    float f = max(fwidth(p.x) + fwidth(p.y), 1e-4);
    return mix(smoothstep(r + f, r - f, length(fract(p) - .5)), 3.1 * r * r, smoothstep(.4, 1.2, f));
  }
  float patternOf(int kind, vec2 p) {
    if (kind == 1) return line((p.x + p.y) * .7, .14);
    if (kind == 2) return line((p.x - p.y) * .7, .14);
    if (kind == 3) return line(p.y, .14);
    if (kind == 4) return line(p.x, .14);
    if (kind == 5) return dot_(p, .22);
    if (kind == 6) return max(line((p.x + p.y) * .7, .1), line((p.x - p.y) * .7, .1));
    if (kind == 7) return max(line(p.x, .1), line(p.y, .1));
    return dot_(p, .36);
  }

  void main() {
    if (dot(cut.xyz, vWorld) > cut.w && dot(cut.xyz, cut.xyz) > .5) discard;
    if ((vEntry.g & ${kFlag.through}) != 0 && (int(gl_FragCoord.x) + int(gl_FragCoord.y)) % 2 == 0) discard;
    vec3 n = normalize(vNormal);
    if (!gl_FrontFacing) n = -n;
    vec4 entry = texelFetch(palette, ivec2(vEntry.r, 0), 0);
    vec3 base = entry.rgb;
    int kind = int(entry.a * 255. + .5);
    if (kind > 0) {
      float light = dot(base, vec3(.3, .59, .11));
      base = mix(base, light > .55 ? base * .35 : mix(base, vec3(1.), .8), patternOf(kind, vPlane / period));
    }
    float shade = .74 + .26 * max(dot(n, normalize(vec3(.3, .5, .8))), 0.) + .05 * n.x;
    vec3 c = base * shade;
    if ((vEntry.g & ${kFlag.faint}) != 0) c = mix(c, ground, .62);
    if ((vEntry.g & ${kFlag.changed}) != 0) c = mix(c, change, .5 * line((gl_FragCoord.x + gl_FragCoord.y) / 9., .22));
    if ((vEntry.g & ${kFlag.hover}) != 0) c = mix(c, vec3(1.), .22);
    c *= brightness;
    // The inside of what is cut open.
    if (!gl_FrontFacing && dot(cut.xyz, cut.xyz) > .5) c = mix(ground * .55, c, .25);
    colour = vec4(c, 1.);
  }`;

const kLineVertex = `
  in vec2 sides;
  out vec3 vWorld;
  flat out int vFlags;
  ${kLookUp}
  void main() {
    int a = entryOf(sides.x).g, b = entryOf(sides.y).g;
    vFlags = (a | b) & ${kFlag.selected | kFlag.found};
    if ((a & b & ${kFlag.faint | kFlag.hidden}) != 0) vFlags |= ${kFlag.faint};
    vWorld = position;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.);
  }`;

const lineFragment = (strength: string) => `
  uniform vec4 cut;
  uniform vec3 edge, accent;
  in vec3 vWorld;
  flat in int vFlags;
  out vec4 colour;
  void main() {
    if (dot(cut.xyz, vWorld) > cut.w && dot(cut.xyz, cut.xyz) > .5) discard;
    float strength = ${strength};
    if ((vFlags & ${kFlag.faint}) != 0) strength *= .3;
    bool isMarked = (vFlags & ${kFlag.selected | kFlag.found}) != 0;
    colour = vec4(isMarked ? accent : edge, isMarked ? 1. : strength);
  }`;

/** Counting needs all faces of closed bodies, hidden ones too. */
const kCountVertex = `
  in float number;
  out vec3 vWorld;
  ${kLookUp}
  void main() {
    vWorld = position;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.);
    if ((entryOf(number).g & ${kFlag.open}) != 0) gl_Position = vec4(2., 2., 2., 1.);
  }`;

const kCountFragment = `
  uniform vec4 cut;
  in vec3 vWorld;
  out vec4 colour;
  void main() {
    if (dot(cut.xyz, vWorld) > cut.w) discard;
    colour = vec4(0.);
  }`;

/** The plane of a cut, drawn where the counts are not even: hatched, as sections are. */
export function makeCapMaterial(uniforms: Uniforms): ShaderMaterial {
  return new ShaderMaterial({glslVersion: GLSL3, uniforms, side: DoubleSide, stencilWrite: true, stencilRef: 0, stencilFunc: NotEqualStencilFunc,
    stencilFail: ZeroStencilOp, stencilZFail: ZeroStencilOp, stencilZPass: ZeroStencilOp, polygonOffset: true, polygonOffsetFactor: 0.5, polygonOffsetUnits: 0.5,
    vertexShader: 'void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.); }',
    fragmentShader: `
      uniform vec3 ground, edge;
      uniform float brightness;
      out vec4 colour;
      void main() {
        vec3 fill = mix(vec3(.55, .53, .5), ground, .3) * brightness;
        float d = abs(fract((gl_FragCoord.x + gl_FragCoord.y) / 11.) - .5);
        colour = vec4(mix(fill, edge, .28 * smoothstep(.38, .46, d)), 1.);
      }`});
}

/** Boxes of buildings that have not come: a colour for each, and a shade for each side. */
export function makeBoxMaterial(): ShaderMaterial {
  return new ShaderMaterial({glslVersion: GLSL3,
    vertexShader: `
      in float shade;
      flat out vec3 vColour;
      void main() {
        vColour = instanceColor * shade;
        gl_Position = projectionMatrix * modelViewMatrix * instanceMatrix * vec4(position, 1.);
      }`,
    fragmentShader: 'flat in vec3 vColour; out vec4 colour; void main() { colour = vec4(vColour, 1.); }'});
}

/** Lines with colours of their own, seen through everything. */
export function makeExtraLineMaterial(): ShaderMaterial {
  return new ShaderMaterial({glslVersion: GLSL3, depthTest: false, transparent: true,
    vertexShader: `
      in vec3 tint;
      flat out vec3 vColour;
      void main() { vColour = tint; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.); }`,
    fragmentShader: 'flat in vec3 vColour; out vec4 colour; void main() { colour = vec4(vColour, 1.); }'});
}

export function makeMaterials(uniforms: Uniforms): Materials {
  const common = {glslVersion: GLSL3, uniforms};
  const counting = {...common, vertexShader: kCountVertex, fragmentShader: kCountFragment, colorWrite: false, depthWrite: false, depthTest: false,
    stencilWrite: true, stencilFunc: AlwaysStencilFunc} as const;
  return {
    faces: new ShaderMaterial({...common, vertexShader: kFaceVertex, fragmentShader: kFaceFragment, side: DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}),
    lines: new ShaderMaterial({...common, vertexShader: kLineVertex, fragmentShader: lineFragment('.62'), transparent: true}),
    hiddenLines: new ShaderMaterial({...common, vertexShader: kLineVertex, fragmentShader: lineFragment('.2'), transparent: true,
      depthFunc: GreaterDepth, depthWrite: false}),
    // A cut is closed where the sight enters a body more often than it leaves it: backs count up, fronts down.
    backs: new ShaderMaterial({...counting, side: BackSide, stencilFail: IncrementWrapStencilOp, stencilZFail: IncrementWrapStencilOp,
      stencilZPass: IncrementWrapStencilOp}),
    fronts: new ShaderMaterial({...counting, side: FrontSide, stencilFail: DecrementWrapStencilOp, stencilZFail: DecrementWrapStencilOp,
      stencilZPass: DecrementWrapStencilOp})
  };
}
