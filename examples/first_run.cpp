// Five points in space, one of them passing through the others' sphere: their power diagram changes once.
#include <cstdio>

#include "kds/simulator.h"
#include "motions/bezier_motion.h"
#include "structures/power_diagram.h"

int main() {
  using Motion = kds::BezierMotion<3, 1>;  // in space, linear in u
  const double start[5][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {5, 5, 5}};
  Motion motion(5);
  for (kds::BeadId bead = 0; bead < 5; ++bead)
    for (int axis = 0; axis < 3; ++axis) {
      motion.set_coordinate(bead, 0, axis, start[bead][axis]);
      motion.set_coordinate(bead, 1, axis, bead == 4 ? 2.0 : start[bead][axis]);
    }
  kds::Simulator simulator(kds::AuditMode::events);  // checks against CGAL between all events
  kds::PowerDiagram<Motion, kds::Filtered> diagram(simulator, motion);
  simulator.build();
  simulator.run_step(true);
  for (std::size_t kind = 0; kind < 2; ++kind)
    std::printf("%s flips: %d\n", diagram.kinds()[kind].name.data(),
                int(diagram.statistics.events_by_kind[kind]));
}
