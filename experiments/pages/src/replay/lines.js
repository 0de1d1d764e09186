// One draw call of very many pairs of beads, as lines one pixel wide. Software graphics take far longer for as many instances.
import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, GLSL3, LineSegments, RawShaderMaterial } from "three";
import { lineFragment, lineVertex } from "./shaders.js";

export class Lines {
  constructor({ uniforms, order }) {
    this.tint = { value: new Color() };
    this.alpha = { value: 1 };
    this.geometry = new BufferGeometry();
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: lineVertex,
      fragmentShader: lineFragment,
      uniforms: { ...uniforms, tint: this.tint, alpha: this.alpha },
      transparent: true,
      depthWrite: false,
    });
    this.mesh = new LineSegments(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = order;
    this.capacity = this.count = 0;
  }

  setPairs(words, arity, [r, g, b], alpha) {
    this.count = words.length / arity;
    if (this.count > this.capacity) {
      this.geometry.dispose();
      this.capacity = Math.ceil(1.5 * this.count);
      const ends = new BufferAttribute(new Uint32Array(2 * this.capacity), 1);
      this.geometry.setAttribute("end", ends.setUsage(DynamicDrawUsage));
    }
    const ends = this.geometry.getAttribute("end");
    for (let k = 0; k < this.count; ++k) {
      ends.array[2 * k] = words[k * arity];
      ends.array[2 * k + 1] = words[k * arity + 1];
    }
    ends.clearUpdateRanges();
    ends.addUpdateRange(0, 2 * this.count);
    ends.needsUpdate = true;
    this.geometry.setDrawRange(0, 2 * this.count);
    this.tint.value.setRGB(r / 255, g / 255, b / 255);
    this.alpha.value = alpha / 255;
  }

  set visible(shown) {
    this.mesh.visible = shown && this.count > 0;
  }
}
