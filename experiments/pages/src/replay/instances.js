// One draw call of many instances: squares that the shaders make into beads, segments, cages or halos.
import {
  GLSL3,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  BufferAttribute,
  DoubleSide,
  DynamicDrawUsage,
  Mesh,
  RawShaderMaterial,
} from "three";

const square = new Float32Array([-1, -1, 1, -1, 1, 1, -1, -1, 1, 1, -1, 1]);
const strip = new Float32Array([0, -1, 1, -1, 1, 1, 0, -1, 1, 1, 0, 1]);

export class Instances {
  // `attributes`: {name: [array type, numbers per instance, normalized]}. An instance is made of `repeat` squares or strips, or of
  // the triangles of `corners`, three numbers for each corner.
  constructor({
    vertex, fragment, uniforms, attributes, segments = false, repeat = 1, corners, transparent = false, depthTest = true, order,
  }) {
    this.attributes = attributes;
    this.capacity = 0;
    this.geometry = new InstancedBufferGeometry();
    const squares = () => Float32Array.from(Array(repeat).fill([...(segments ? strip : square)]).flat());
    const places = corners ? new BufferAttribute(corners, 3) : new BufferAttribute(squares(), 2);
    this.geometry.setAttribute("corner", places);
    this.geometry.setDrawRange(0, places.count);  // three.js finds the number of corners in "position" only
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: vertex,
      fragmentShader: fragment,
      uniforms,
      side: DoubleSide,
      transparent,
      depthTest,
      depthWrite: !transparent,
    });
    this.mesh = new Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = order;
    this.count = 0;
    this.reserve(16);
  }

  reserve(count) {
    if (count <= this.capacity) return;
    this.capacity = Math.max(count, 2 * this.capacity);
    this.geometry.dispose();
    for (const [name, [Type, size, normalized]] of Object.entries(this.attributes)) {
      const array = new Type(this.capacity * size);
      const old = this.geometry.getAttribute(name);
      if (old) array.set(old.array);
      const attribute = new InstancedBufferAttribute(array, size, normalized);
      attribute.setUsage(DynamicDrawUsage);
      this.geometry.setAttribute(name, attribute);
    }
  }

  array(name) {
    return this.geometry.getAttribute(name).array;
  }

  // Tells the graphics card that the first `count` instances of some attributes have changed.
  changed(count, ...names) {
    this.count = count;
    this.geometry.instanceCount = count;
    for (const name of names) {
      const attribute = this.geometry.getAttribute(name);
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, count * attribute.itemSize);
      attribute.needsUpdate = true;
    }
  }

  // Shows the pairs of `words`, the first two of each `arity`, in one colour.
  setPairs(words, arity, [r, g, b], alpha) {
    const count = words.length / arity;
    this.reserve(count);
    const ends = this.array("ends");
    const tint = this.array("tint");
    for (let k = 0; k < count; ++k) {
      ends[2 * k] = words[k * arity];
      ends[2 * k + 1] = words[k * arity + 1];
      tint[4 * k] = r;
      tint[4 * k + 1] = g;
      tint[4 * k + 2] = b;
      tint[4 * k + 3] = alpha;
    }
    this.changed(count, "ends", "tint");
  }

  set visible(shown) {
    this.mesh.visible = shown && this.count > 0;
  }
}
