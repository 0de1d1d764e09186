// window.kds: functions for notebooks and tests.
import { errors } from "../shared/problems.js";

const layers = [
  "edges", "balls", "links", "triangles", "tetrahedra", "voids", "contacts", "cages", "supports", "ends", "hull", "closest", "order",
];

export function interfaceOf(app, ready) {
  return {
    ready,
    errors,
    seek: (step, u) => app.goTo(step, u),
    seekEvent: (s, e) => app.goTo(0, 0, [s, e]),
    pick: (x, y) => app.scene?.pick(x, y) ?? -1,
    project: (bead) => app.scene.project(app.placeOf(bead)),
    statistics: () => ({ ...app.cost }),
    state: () => ({
      step: app.state.step,
      u: app.state.u,
      ...Object.fromEntries(layers.map((name) => [name, app.state.elements(name)])),
      hidden: app.state.elements("hidden").flat(),
      spheres: app.frames.chords.flatMap(({ s, nodes, spheres }) =>
        [...nodes].map((node, k) => ({ structure: s, node, sphere: [...spheres.subarray(4 * k, 4 * k + 4)] }))),
      positions: app.positions.slice(),
    }),
  };
}
