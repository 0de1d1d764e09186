// The trace of each chain: a tube on a Catmull-Rom curve through its beads, in one draw call. The projection is parallel, so
// a band that faces the reader, shaded across, looks like a tube. Balls close its ends and cover its bends.
import { Instances } from "./instances.js";
import { distanceOf } from "./measure.js";
import { beadFragment, header } from "./shaders.js";

// Pieces of the curve between two beads. Many segments are small.
const piecesOf = (segments) => (segments < 1000 ? 10 : 4);

const vertex = `${header}
in vec3 corner;  // place along the curve and across, 0; or place on a ball, 1 at the first bead and 2 at the second
in uvec4 beads;
in vec4 tint;
in vec4 nextTint;
uniform float tube;
out vec2 at;
out vec4 colour;
out float depth;
out float radius;
vec3 place(uint bead) { return (viewMatrix * vec4(ball(bead).xyz, 1.0)).xyz; }
void main() {
  vec3 from = place(beads.y);
  vec3 to = place(beads.z);
  vec3 leave = 0.5 * (to - place(beads.x));
  vec3 arrive = 0.5 * (place(beads.w) - from);
  bool band = corner.z == 0.0;
  float t = band ? corner.x : corner.z - 1.0;
  vec3 bent = 2.0 * (from - to) + leave + arrive;
  vec3 bend = 3.0 * (to - from) - 2.0 * leave - arrive;
  vec3 centre = ((bent * t + bend) * t + leave) * t + from;
  vec3 way = (3.0 * bent * t + 2.0 * bend) * t + leave;
  at = band ? corner.y * vec2(-way.y, way.x) / max(1e-9, length(way.xy)) : corner.xy;
  colour = vec4(mix(tint.rgb, nextTint.rgb, smoothstep(0.3, 0.7, t)), 1.0);
  depth = centre.z;
  radius = band ? tube : 0.97 * tube;  // within the tube, so that only its gaps show them
  gl_Position = projectionMatrix * vec4(centre + vec3(at * radius, 0.0), 1.0);
}`;

function corners(pieces) {
  const numbers = [];
  for (let k = 0; k < pieces; ++k) {
    const [a, b] = [k / pieces, (k + 1) / pieces];
    numbers.push(a, -1, 0, b, -1, 0, b, 1, 0, a, -1, 0, b, 1, 0, a, 1, 0);
  }
  for (const end of [1, 2]) numbers.push(-1, -1, end, 1, -1, end, 1, 1, end, -1, -1, end, 1, 1, end, -1, 1, end);
  return new Float32Array(numbers);
}

// Returns the segments of traces, [before, from, to, after] for each.
export const segmentsOf = (traces) =>
  traces.flatMap((beads) =>
    beads.slice(1).map((to, k) => [beads[Math.max(0, k - 1)], beads[k], to, beads[Math.min(beads.length - 1, k + 2)]]),
  );

export class Trace {
  constructor(traces, uniforms) {
    this.segments = segmentsOf(traces);
    const count = this.segments.length;
    this.beads = new Set(traces.flat());
    this.tube = { value: 0 };
    this.instances = new Instances({
      vertex,
      fragment: beadFragment,
      uniforms: { ...uniforms, tube: this.tube },
      attributes: { beads: [Uint32Array, 4, false], tint: [Uint8Array, 4, true], nextTint: [Uint8Array, 4, true] },
      corners: corners(piecesOf(count)),
      order: 0,
    });
    this.mesh = this.instances.mesh;
    this.instances.reserve(count);
    this.instances.array("beads").set(this.segments.flat());
    this.instances.changed(count, "beads");
  }

  // Makes the tube an eighth as thick as its beads are apart.
  fit(positions) {
    const apart = this.segments.map(([, a, b]) => distanceOf(positions, a, b));
    this.tube.value = apart.sort((a, b) => a - b)[apart.length >> 1] / 8 || 0;
  }

  paint(colourOf) {
    const { instances, segments } = this;
    segments.forEach(([, from, to], k) => {
      instances.array("tint").set(colourOf(from), 4 * k);
      instances.array("nextTint").set(colourOf(to), 4 * k);
    });
    instances.changed(segments.length, "tint", "nextTint");
  }

  set visible(shown) {
    this.instances.visible = shown;
  }

  get visible() {
    return this.mesh.visible;
  }
}
