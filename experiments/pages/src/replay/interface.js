// window.kds: functions for notebooks and tests.
import { errors } from "../shared/problems.js";

export function interfaceOf(app, ready) {
  return {
    ready,
    errors,
    seek: (step, u) => app.goTo(step, u),
    seekEvent: (s, e) => app.goTo(0, 0, [s, e]),
    pick: (x, y) => app.scene?.pick(x, y) ?? -1,
    statistics: () => ({ ...app.cost }),
    state: () => ({
      step: app.state.step,
      u: app.state.u,
      edges: app.state.elements("edges"),
      contacts: app.state.elements("contacts"),
      hidden: app.state.elements("hidden").flat(),
      cages: app.state.elements("cages"),
      positions: app.positions.slice(),
    }),
  };
}
