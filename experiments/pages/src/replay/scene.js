// The three-dimensional picture: camera, beads and the layers over them, thirteen draw calls at most.
import {
  Color,
  DataTexture,
  FloatType,
  NearestFilter,
  OrthographicCamera,
  RGBAFormat,
  Scene as ThreeScene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { rgb } from "../shared/palette.js";
import { theme } from "./colours.js";
import { Instances } from "./instances.js";
import { Lines } from "./lines.js";
import { beadAt } from "./picking.js";
import * as shaders from "./shaders.js";
import { sphereOfBasis } from "./spheres.js";
import { Trace } from "./trace.js";

export const hasWebGL2 = () => document.createElement("canvas").getContext("webgl2") !== null;

const linked = { ends: [Uint32Array, 2, false], tint: [Uint8Array, 4, true], dash: [Uint8Array, 1, false] };
const ringed = { bead: [Uint32Array, 1, false], tint: [Uint8Array, 4, true] };
const shapes = { ring: 0, diamond: 1, cross: 2 };

const manyPairs = 20000;  // above, the pairs of a layer are thin lines

const textHeight = 56;  // pixels above the scene that the text takes

export class Scene {
  // `traces` are the beads of the trace of each chain.
  constructor(canvas, meta, radii, traces, onCamera) {
    this.meta = meta;
    this.radii = radii;
    this.positions = new Float32Array(3 * meta.beads);
    this.shrink = 1;
    // Many beads are small, and smooth outlines double the time of a picture.
    this.renderer = new WebGLRenderer({ canvas, antialias: meta.beads < 3000, alpha: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.three = new ThreeScene();
    this.camera = new OrthographicCamera();
    this.axes = this.viewAxes();
    this.camera.up.set(...this.axes.up);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.enableRotate = meta.dimension === 3;
    if (meta.dimension < 3) {
      this.controls.mouseButtons.LEFT = 2;  // pan
      this.controls.touches.ONE = 1;        // pan
    }
    // Points have no radius and are drawn as small balls.
    this.drawnRadius = (bead) => radii(bead) || 0.012 * this.radius;
    this.makeTexture();
    this.makeLayers(traces);
    this.resetCamera();
    this.onCamera = () => {
      this.placeClipping();
      onCamera();
    };
    this.controls.addEventListener("change", this.onCamera);
  }

  makeTexture() {
    const width = Math.max(1, Math.ceil(Math.sqrt(this.meta.beads)));
    this.balls = new Float32Array(4 * width * Math.ceil(this.meta.beads / width));
    for (let b = 0; b < this.meta.beads; ++b) this.balls[4 * b + 3] = this.drawnRadius(b);
    this.texture = new DataTexture(this.balls, width, this.balls.length / 4 / width, RGBAFormat, FloatType);
    this.texture.minFilter = this.texture.magFilter = NearestFilter;
  }

  // Makes a layer of lines between beads.
  segments(order, thickness, depthTest = true) {
    return new Instances({
      vertex: shaders.segmentVertex,
      fragment: shaders.segmentFragment,
      uniforms: { ...this.uniforms, thickness: { value: thickness } },
      attributes: linked,
      segments: true,
      transparent: true,
      depthTest,
      order,
    });
  }

  // Makes a layer of faces between three beads.
  triangles(order, depthTest = true) {
    return new Instances({
      vertex: shaders.faceVertex,
      fragment: shaders.faceFragment,
      uniforms: this.uniforms,
      attributes: { beads: [Uint32Array, 3, false], tint: [Uint8Array, 4, true] },
      corners: Float32Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1),
      transparent: true,
      depthTest,
      order,
    });
  }

  makeLayers(traces) {
    this.uniforms = {
      balls: { value: this.texture },
      screen: { value: new Vector2(1, 1) },
      sharp: { value: 1 },
      shrink: { value: 1 },
      fog: { value: new Color() },
      reach: { value: new Vector3(1, -1, 0.5) },
    };
    const segments = (...options) => this.segments(...options);
    this.beads = new Instances({
      vertex: shaders.beadVertex,
      fragment: shaders.beadFragment,
      uniforms: this.uniforms,
      attributes: ringed,
      order: 0,
    });
    this.trace = new Trace(traces, this.uniforms);
    this.chain = segments(1, 3);
    const pairs = (name, order, thickness, depthTest) => {
      const layers = this.meta.structures.flatMap(({ layers }) => layers).filter((layer) => layer.name === name);
      const count = layers.reduce((sum, { initial }) => sum + initial, 0);
      return count > manyPairs ? new Lines({ uniforms: this.uniforms, order }) : segments(order, thickness, depthTest);
    };
    this.edges = pairs("edges", 2, 1.2, true);
    this.links = pairs("links", 2, 1.2, true);
    this.contacts = pairs("contacts", 3, 3, false);
    this.cages = new Instances({
      vertex: shaders.cageVertex,
      fragment: shaders.cageFragment,
      uniforms: this.uniforms,
      attributes: { sphere: [Float32Array, 4, false], tint: [Uint8Array, 4, true] },
      transparent: true,
      order: 4,
    });
    this.faces = this.triangles(1.5);
    this.markedFaces = this.triangles(5.5, false);
    this.marks = segments(6, 4.5, false);
    this.halos = new Instances({
      vertex: shaders.haloVertex,
      fragment: shaders.haloFragment,
      uniforms: this.uniforms,
      attributes: { ...ringed, shape: [Uint8Array, 1, false] },
      transparent: true,
      depthTest: false,
      order: 5,
    });
    for (const layer of [this.beads, this.trace, this.chain, this.faces, this.edges, this.links, this.contacts, this.cages,
        this.markedFaces, this.marks, this.halos]) this.three.add(layer.mesh);
    this.fillBeads();
    this.fillChain();
  }

  fillBeads() {
    const { beads } = this.meta;
    this.beads.reserve(beads);
    const numbers = this.beads.array("bead");
    for (let b = 0; b < beads; ++b) numbers[b] = b;
    this.beads.changed(beads, "bead");
  }

  fillChain() {
    const pairs = [];
    let first = 0;
    for (const count of this.meta.necklaces) {
      for (let b = first; b + 1 < first + count; ++b) pairs.push(b, b + 1);
      first += count;
    }
    this.chainPairs = Uint32Array.from(pairs);
  }

  // `dark` is the page's theme.
  setTheme(dark) {
    this.dark = dark;
    this.colours = theme(dark ? "dark" : "light");
    this.renderer.setClearColor(this.colours.page, 1);
    const [r, g, b] = rgb(this.colours.fog).map((value) => value / 255);
    this.uniforms.fog.value.setRGB(r, g, b);
    this.chain.setPairs(this.chainPairs, 2, rgb(this.colours.chain), 255);
  }

  // Colours traces, and takes over the colours of beads.
  setColours(colourOf) {
    this.tints = Array.from({ length: this.meta.beads }, (_, bead) => colourOf(bead));
    this.trace.paint((bead) => this.tints[bead]);
  }

  // Colours beads. `hidden` beads are drawn hatched.
  paintBeads(hidden) {
    const tint = this.beads.array("tint");
    for (let b = 0; b < this.meta.beads; ++b) {
      tint.set(this.tints[b], 4 * b);
      tint[4 * b + 3] = hidden.has(b) ? 0 : 255;
    }
    this.beads.changed(this.meta.beads, "tint");
  }

  // Shows lines between beads, {pair, colour, dashed, alpha}, in a layer of segments.
  setLines(layer, lines) {
    layer.reserve(lines.length);
    lines.forEach(({ pair, colour, dashed, alpha }, k) => {
      layer.array("ends").set(pair, 2 * k);
      layer.array("tint").set([...rgb(colour), 255 * alpha], 4 * k);
      layer.array("dash")[k] = dashed ? 1 : 0;
    });
    layer.changed(lines.length, "ends", "tint", "dash");
    layer.visible = true;
  }

  // Shows groups of faces, {words, colour, alphas}: three beads and an alpha for each face.
  setFaces(layer, groups) {
    const count = groups.reduce((sum, { alphas }) => sum + alphas.length, 0);
    layer.reserve(count);
    let k = 0;
    for (const { words, colour, alphas } of groups) {
      layer.array("beads").set(words, 3 * k);
      const own = rgb(colour);
      for (const alpha of alphas) layer.array("tint").set([...own, 255 * alpha], 4 * k++);
    }
    layer.changed(count, "beads", "tint");
    layer.visible = true;
  }

  // Shows marked pairs as `setLines` has them, and signs around beads, {bead, colour, alpha, shape}.
  setMarks(marks, rings) {
    this.setLines(this.marks, marks);
    this.halos.reserve(rings.length);
    rings.forEach(({ bead, colour, alpha, shape = "ring" }, k) => {
      this.halos.array("bead")[k] = bead;
      this.halos.array("tint").set([...rgb(colour), 255 * alpha], 4 * k);
      this.halos.array("shape")[k] = shapes[shape];
    });
    this.halos.changed(rings.length, "bead", "tint", "shape");
    this.halos.visible = true;
  }

  // Shows cages, {basis or sphere, colour, alpha}, at the present positions.
  setCages(cages) {
    this.cages.reserve(cages.length);
    const sphere = this.cages.array("sphere");
    const tint = this.cages.array("tint");
    let count = 0;
    for (const { basis, sphere: own, colour, alpha } of cages) {
      if (own) sphere.set(own, 4 * count);
      else if (!sphereOfBasis(basis, this.positions, this.radii, sphere, 4 * count)) continue;
      tint[4 * count] = colour[0];
      tint[4 * count + 1] = colour[1];
      tint[4 * count + 2] = colour[2];
      tint[4 * count + 3] = 255 * alpha;
      ++count;
    }
    this.cages.changed(count, "sphere", "tint");
    this.cages.visible = true;
  }

  // Takes over `positions` once they have changed.
  movedBeads() {
    const { positions, balls } = this;
    for (let b = 0; b < this.meta.beads; ++b) {
      balls[4 * b] = positions[3 * b];
      balls[4 * b + 1] = positions[3 * b + 1];
      balls[4 * b + 2] = positions[3 * b + 2];
    }
    this.texture.needsUpdate = true;
  }

  // Returns the first view: the longest side of the scene lies across, the shortest points to the reader.
  viewAxes() {
    const { low, high } = this.meta.box;
    const sides = [0, 1, 2].map((axis) => (high[axis] ?? 0) - (low[axis] ?? 0));
    const order = this.meta.dimension < 3 ? [0, 1, 2] : [0, 1, 2].sort((a, b) => sides[b] - sides[a]);
    const unit = (axis) => new Vector3(...[0, 1, 2].map((k) => (k === axis ? 1 : 0)));
    const [right, up] = [unit(order[0]), unit(order[1])];
    const back = right.clone().cross(up);
    if (this.meta.dimension === 3) back.addScaledVector(right, 0.25).addScaledVector(up, 0.2).normalize();
    const across = up.clone().cross(back).normalize();
    const half = (way) => sides.reduce((sum, side, axis) => sum + (side * Math.abs(way.getComponent(axis))) / 2, 0);
    let largest = 0;
    for (let b = 0; b < this.meta.beads; ++b) largest = Math.max(largest, this.radii(b));
    this.radius = Math.hypot(...sides) / 2 + largest || 1;  // 1 for points that all stand in one place
    const margin = this.meta.structures.some(({ nodes }) => nodes) ? 1.25 : 1.12;  // cages reach beyond the beads
    const reach = (way) => Math.max(0.3 * this.radius, half(way) + largest) * margin;
    return { up, back, halfWidth: reach(across), halfHeight: reach(back.clone().cross(across)) };
  }

  get centre() {
    const { low, high } = this.meta.box;
    return new Vector3(...[0, 1, 2].map((axis) => ((low[axis] ?? 0) + (high[axis] ?? 0)) / 2));
  }

  resetCamera() {
    this.controls.target.copy(this.centre);
    this.camera.position.copy(this.axes.back).multiplyScalar(4 * this.radius).add(this.controls.target);
    this.camera.zoom = 1;
    this.resize();
    this.controls.update();
    this.placeClipping();
  }

  // Lets the camera see the whole scene at zoom 1.
  resize() {
    const canvas = this.renderer.domElement;
    const [width, height] = [Math.max(1, canvas.clientWidth), Math.max(1, canvas.clientHeight)];
    this.renderer.setSize(width, height, false);
    const { halfWidth, halfHeight } = this.axes;
    const perPixel = Math.max(halfHeight / Math.max(50, height - textHeight), halfWidth / width);
    const [x, y] = [perPixel * width, perPixel * height];
    Object.assign(this.camera, { left: -x, right: x, top: y, bottom: -y });
    this.camera.setViewOffset(width, height, 0, -textHeight / 2, width, height);
    this.uniforms.screen.value.set(width, height);
    this.uniforms.sharp.value = this.renderer.getPixelRatio();
  }

  // Puts the clipping planes and the fog around the scene.
  placeClipping() {
    this.camera.updateMatrixWorld();
    const depth = this.centre.applyMatrix4(this.camera.matrixWorldInverse).z;
    this.camera.near = -depth - 3 * this.radius;
    this.camera.far = -depth + 3 * this.radius;
    this.camera.updateProjectionMatrix();
    const strength = this.meta.dimension < 3 ? 0 : 0.5;
    this.uniforms.reach.value.set(depth + 0.7 * this.radius, depth - this.radius, strength);
  }

  // Moves the camera along with a point.
  follow(by) {
    const shift = new Vector3(...by);
    this.camera.position.add(shift);
    this.controls.target.add(shift);
    this.camera.updateMatrixWorld();
    this.placeClipping();
  }

  // Turns the camera around its target, by angles.
  turn(aside, upward) {
    if (this.meta.dimension < 3) return;
    const way = this.camera.position.clone().sub(this.controls.target);
    const right = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
    way.applyAxisAngle(this.camera.up, aside).applyAxisAngle(right, upward);
    this.camera.position.copy(this.controls.target).add(way);
    this.controls.update();
  }

  zoom(factor) {
    this.camera.zoom *= factor;
    this.camera.updateProjectionMatrix();
    this.onCamera();
  }

  get view() {
    const { position, zoom } = this.camera;
    return [...position, ...this.controls.target, zoom];
  }

  set view(numbers) {
    this.camera.position.set(...numbers.slice(0, 3));
    this.controls.target.set(...numbers.slice(3, 6));
    this.camera.zoom = numbers[6];
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.placeClipping();
  }

  // Returns the bead under a point of the page, or -1.
  pick(clientX, clientY) {
    const place = this.renderer.domElement.getBoundingClientRect();
    if (clientX < place.left || clientX > place.right || clientY < place.top || clientY > place.bottom) return -1;
    const matrix = this.camera.matrixWorld.elements;
    const axis = (k) => [matrix[4 * k], matrix[4 * k + 1], matrix[4 * k + 2]];
    const { left, right, top, bottom, zoom } = this.camera;
    const x = (((clientX - place.left) / place.width - 0.5) * (right - left)) / zoom;
    const y = ((0.5 - (clientY - textHeight / 2 - place.top) / place.height) * (top - bottom)) / zoom;
    const camera = { eye: axis(3), right: axis(0), up: axis(1), back: axis(2) };
    return beadAt(this.positions, this.meta.beads, camera, x, y, (b) => this.pickedRadius(b));
  }

  // The radius within which the pointer meets a bead: that of its ball, or of the trace through it.
  pickedRadius(bead) {
    const ball = this.beads.mesh.visible || !this.trace.visible ? this.drawnRadius(bead) * this.shrink : 0;
    return this.trace.visible && this.trace.beads.has(bead) ? Math.max(ball, 1.5 * this.trace.tube.value) : ball;
  }

  // Returns the place of a point in the scene's canvas, in pixels of the page.
  project(point) {
    const { x, y } = new Vector3(...point).project(this.camera);
    const { x: width, y: height } = this.uniforms.screen.value;
    return [((x + 1) / 2) * width, ((1 - y) / 2) * height];
  }

  // Pixels of the page to a unit of length.
  get scale() {
    return (this.uniforms.screen.value.x * this.camera.zoom) / (this.camera.right - this.camera.left);
  }

  // Moves a point to the middle of the picture, and zooms in to `zoom` at least.
  lookAt(point, zoom = 0) {
    this.follow(point.map((value, axis) => value - this.controls.target.getComponent(axis)));
    this.camera.zoom = Math.max(zoom, this.camera.zoom);
    this.camera.updateProjectionMatrix();
    this.onCamera();
  }

  setShrink(shrink) {
    this.shrink = shrink;
    this.uniforms.shrink.value = shrink;
  }

  render() {
    this.renderer.render(this.three, this.camera);
    return this.renderer.info.render.calls;
  }

  // Draws the picture `scale` times as large, or as large as the graphics allow, and gives it to `take`, which must copy it at
  // once.
  drawLarge(scale, transparent, take) {
    const { renderer, uniforms } = this;
    const most = renderer.capabilities.maxTextureSize / Math.max(...uniforms.screen.value.toArray());
    const ratio = renderer.getPixelRatio();
    const draw = (pixels, alpha) => {
      uniforms.sharp.value = pixels;
      renderer.setPixelRatio(pixels);
      renderer.setClearAlpha(alpha);
      this.render();
    };
    draw(Math.min(scale, most), transparent ? 0 : 1);
    take(renderer.domElement);
    draw(ratio, 1);
  }
}
