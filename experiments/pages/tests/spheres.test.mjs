import assert from "node:assert/strict";
import test from "node:test";
import { sphereOfBasis } from "../src/replay/spheres.js";
import { random } from "./sample_run.mjs";
import { smallestBall } from "./slow_twin.mjs";

function sphere(points, radii) {
  const positions = points.flatMap((p) => [p[0], p[1], p[2] ?? 0]);
  const out = [0, 0, 0, 0];
  return sphereOfBasis(points.map((_, k) => k), positions, (b) => radii[b], out, 0) ? out : null;
}

const away = (p, [x, y, z]) => Math.hypot(p[0] - x, p[1] - y, (p[2] ?? 0) - z);

test("the sphere touches every ball of the basis from outside", () => {
  const next = random(1);
  let spheres = 0;
  for (let round = 0; round < 2000; ++round) {
    const size = 1 + (round % 4);
    const dimension = size < 4 && round % 3 === 0 ? 2 : 3;
    const points = Array.from({ length: size }, () => Array.from({ length: dimension }, () => 10 * next()));
    const radii = points.map(() => (round % 5 === 0 ? 0.7 : 0.2 + 0.5 * next()));
    const found = sphere(points, radii);
    if (!found) continue;
    ++spheres;
    points.forEach((p, k) => assert.ok(Math.abs(away(p, found) + radii[k] - found[3]) < 1e-7 * (1 + found[3])));
  }
  assert.ok(spheres > 1500, `${spheres} spheres`);
});

test("the sphere of a basis is the smallest ball around its balls", () => {
  const next = random(2);
  let bases = 0;
  for (let round = 0; round < 40; ++round) {
    const size = 2 + (round % 3);
    const points = Array.from({ length: size }, () => [10 * next(), 10 * next(), size === 3 && round % 2 ? 0 : 10 * next()]);
    const radii = points.map(() => 0.3 + next());
    const ball = smallestBall(points, radii);
    // All balls touch the smallest one only if none of them is superfluous.
    const touches = points.every((p, k) => away(p, ball.centre) + radii[k] > ball.radius - 2e-4);
    if (!touches) continue;
    ++bases;
    const found = sphere(points, radii);
    assert.ok(found && Math.abs(found[3] - ball.radius) < 1e-3, `${found} and ${ball.radius}`);
  }
  assert.ok(bases >= 10, `${bases} bases`);
});

test("four balls whose centres lie on one circle have the sphere of three", () => {
  const points = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]];
  const [x, y, z, radius] = sphere(points, [0.5, 0.5, 0.5, 0.5]);
  for (const value of [x, y, z, radius - 1.5]) assert.ok(Math.abs(value) < 1e-9);
});

test("a lone ball is its own sphere", () => {
  assert.deepEqual(sphere([[1, 2, 3]], [4]), [1, 2, 3, 4]);
});
