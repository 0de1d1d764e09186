// Shaders of the scene. All positions of beads stand in one texture, x, y, z and radius, and the instances of all layers
// name beads by their numbers. The projection is parallel, so the outline of a ball is a circle.

export const header = `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform mat4 viewMatrix;
uniform mat4 projectionMatrix;
uniform sampler2D balls;
uniform vec2 screen;   // pixels of the page
uniform float sharp;   // pixels of the picture to a pixel of the page
uniform float shrink;  // drawn radius of a bead divided by its radius
vec4 ball(uint bead) {
  int width = textureSize(balls, 0).x;
  return texelFetch(balls, ivec2(int(bead) % width, int(bead) / width), 0);
}
`;

const depthCue = `
uniform vec3 fog;
uniform vec3 reach;  // depths of the front and the back of the scene, strength of the fog
vec3 faded(vec3 colour, float depth) {
  float share = clamp((reach.x - depth) / (reach.x - reach.y), 0.0, 1.0);
  return mix(colour, fog, share * reach.z);
}
`;

// Beads: a square for each, on which the fragment shader draws a ball.
export const beadVertex = `${header}
in vec2 corner;
in uint bead;
in vec4 tint;  // alpha 0: the bead is hidden
out vec2 at;
out vec4 colour;
out float depth;
out float radius;
void main() {
  vec4 b = ball(bead);
  radius = b.w * shrink;
  vec4 centre = viewMatrix * vec4(b.xyz, 1.0);
  depth = centre.z;
  at = corner;
  colour = tint;
  gl_Position = projectionMatrix * (centre + vec4(corner * radius, 0.0, 0.0));
}`;

export const beadFragment = `${header}${depthCue}
in vec2 at;
in vec4 colour;
in float depth;
in float radius;
out vec4 pixel;
void main() {
  float square = dot(at, at);
  if (square > 1.0) discard;
  float height = sqrt(1.0 - square);
  bool hidden = colour.a < 0.5;
  if (hidden && square < 0.5 && mod((gl_FragCoord.x + gl_FragCoord.y) / sharp, 6.0) < 4.0) discard;
  vec3 normal = vec3(at, height);
  float light = 0.45 + 0.5 * max(0.0, dot(normal, normalize(vec3(-0.4, 0.6, 0.7))));
  float shine = pow(max(0.0, dot(normal, normalize(vec3(-0.25, 0.4, 0.9)))), 40.0) * 0.18;
  vec3 shaded = hidden ? mix(colour.rgb, fog, 0.4) : colour.rgb * light * 1.08 + shine;
  pixel = vec4(faded(shaded, depth), 1.0);
  float z = depth + height * radius;
  gl_FragDepth = 0.5 * (projectionMatrix[2][2] * z + projectionMatrix[3][2]) + 0.5;
}`;

// Segments, some pixels wide.
const segment = `${header}
in vec2 corner;  // x from 0 to 1 along the segment, y from -1 to 1 across
in vec4 tint;
uniform float thickness;
out vec4 colour;
out float along;
out float across;
out float depth;
flat out float dashed;
void draw(vec3 start, vec3 end, float dash) {
  vec4 a = viewMatrix * vec4(start, 1.0);
  vec4 b = viewMatrix * vec4(end, 1.0);
  vec4 from = projectionMatrix * a;
  vec4 to = projectionMatrix * b;
  vec2 way = (to.xy - from.xy) * screen * 0.5;
  float length = max(1e-3, sqrt(dot(way, way)));
  vec2 side = vec2(-way.y, way.x) / length;
  vec4 place = mix(from, to, corner.x);
  place.xy += side * corner.y * (thickness * 0.5 + 0.5) * 2.0 / screen;
  gl_Position = place;
  depth = mix(a.z, b.z, corner.x);
  colour = tint;
  along = corner.x * length;
  across = corner.y * (thickness * 0.5 + 0.5);
  dashed = dash;
}`;

// Segments between two beads.
export const segmentVertex = `${segment}
in uvec2 ends;
in float dash;
void main() {
  draw(ball(ends.x).xyz, ball(ends.y).xyz, dash);
}`;

// The twelve edges of a box. Edges of no length, and second copies of others where the box is flat, are left out.
export const wireVertex = `${segment}
in vec3 low;
in vec3 high;
void main() {
  int edge = gl_VertexID / 6;
  int axis = edge % 3;
  ivec3 at = ivec3(0);
  at[(axis + 1) % 3] = (edge / 3) % 2;
  at[(axis + 2) % 3] = edge / 6;
  vec3 start = mix(low, high, vec3(at));
  vec3 end = start;
  end[axis] = high[axis];
  draw(start, end, 0.0);
  at[axis] = 1;
  bool flat_axis = any(bvec3(at.x == 1 && low.x == high.x, at.y == 1 && low.y == high.y, at.z == 1 && low.z == high.z));
  if (flat_axis) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

export const segmentFragment = `${header}${depthCue}
in vec4 colour;
in float along;
in float across;
in float depth;
flat in float dashed;
uniform float thickness;
out vec4 pixel;
void main() {
  if (dashed > 0.5 && mod(along, 10.0) > 6.0) discard;
  float edge = clamp((thickness * 0.5 - abs(across)) * sharp + 0.5, 0.0, 1.0);
  pixel = vec4(faded(colour.rgb, depth), colour.a * edge);
}`;

// Lines between two beads, one pixel wide, all of one colour.
export const lineVertex = `${header}
in uint end;
out float depth;
void main() {
  vec4 place = viewMatrix * vec4(ball(end).xyz, 1.0);
  depth = place.z;
  gl_Position = projectionMatrix * place;
}`;

export const lineFragment = `${header}${depthCue}
uniform vec3 tint;
uniform float alpha;
in float depth;
out vec4 pixel;
void main() {
  pixel = vec4(faded(tint, depth), alpha);
}`;

// Faces: triangles between three beads, alike on both sides.
export const faceVertex = `${header}
in vec3 corner;  // the share of each bead
in uvec3 beads;
in vec4 tint;
flat out vec4 colour;
out float depth;
void main() {
  mat3 ends = mat3(ball(beads.x).xyz, ball(beads.y).xyz, ball(beads.z).xyz);
  vec4 place = viewMatrix * vec4(ends * corner, 1.0);
  vec3 normal = normalize(mat3(viewMatrix) * cross(ends[1] - ends[0], ends[2] - ends[0]));
  float light = 0.6 + 0.5 * abs(dot(normal, normalize(vec3(-0.4, 0.6, 0.7))));
  depth = place.z;
  colour = vec4(tint.rgb * light, tint.a);
  gl_Position = projectionMatrix * place;
}`;

export const faceFragment = `${header}${depthCue}
flat in vec4 colour;
in float depth;
out vec4 pixel;
void main() {
  pixel = vec4(faded(colour.rgb, depth), colour.a);
}`;

// Cages: spheres that are clear in the middle.
export const cageVertex = `${header}
in vec2 corner;
in vec4 sphere;
in vec4 tint;
out vec2 at;
out vec4 colour;
out float depth;
out float size;
void main() {
  vec4 centre = viewMatrix * vec4(sphere.xyz, 1.0);
  depth = centre.z;
  at = corner;
  colour = tint;
  size = sphere.w * projectionMatrix[1][1] * screen.y * 0.5;
  gl_Position = projectionMatrix * (centre + vec4(corner * sphere.w, 0.0, 0.0));
}`;

export const cageFragment = `${header}${depthCue}
in vec2 at;
in vec4 colour;
in float depth;
in float size;
out vec4 pixel;
void main() {
  float square = dot(at, at);
  if (square > 1.0) discard;
  float rim = (1.0 - sqrt(square)) * size;
  float line = 1.0 - smoothstep(1.2, 2.4, rim);
  float glow = pow(square, 4.0);
  pixel = vec4(faded(colour.rgb, depth), colour.a * max(line, 0.05 + 0.28 * glow));
}`;

// Halos around beads, in front of everything: rings (shape 0), diamonds (1) and rings with a cross (2).
export const haloVertex = `${header}
in vec2 corner;
in uint bead;
in vec4 tint;
in float shape;
flat out float form;
out vec2 at;
out vec4 colour;
flat out float inner;
flat out float outer;
void main() {
  vec4 b = ball(bead);
  vec4 centre = projectionMatrix * viewMatrix * vec4(b.xyz, 1.0);
  inner = max(3.0, b.w * shrink * projectionMatrix[1][1] * screen.y * 0.5);
  outer = inner + (shape > 0.5 ? 14.0 : 9.0);
  form = shape;
  at = corner * outer;
  colour = tint;
  gl_Position = centre + vec4(at * 2.0 / screen, 0.0, 0.0);
}`;

export const haloFragment = `${header}
in vec2 at;
in vec4 colour;
flat in float inner;
flat in float outer;
flat in float form;
out vec4 pixel;
void main() {
  float away = length(at);
  if (form > 0.5) {
    // Distances from the outline of the diamond, or from the ring and the two strokes of the cross.
    vec2 turned = abs(vec2(at.x + at.y, at.x - at.y)) * 0.70711;
    float line = form < 1.5 ? abs(max(turned.x, turned.y) - (inner + 3.0) )
        : min(abs(away - inner - 2.0), away < inner + 12.0 ? min(turned.x, turned.y) : outer);
    float alpha = 1.0 - smoothstep(1.4, 2.4, line);
    if (alpha <= 0.0) discard;
    pixel = vec4(colour.rgb, colour.a * alpha);
    return;
  }
  if (away > outer) discard;
  float ring = smoothstep(inner - 1.5, inner, away) * (1.0 - smoothstep(inner + 2.5, inner + 3.5, away));
  float glow = away < inner ? 0.22 : 0.55 * (1.0 - (away - inner) / (outer - inner));
  pixel = vec4(colour.rgb, colour.a * max(ring, glow));
}`;
