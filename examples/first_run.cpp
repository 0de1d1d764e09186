// The power diagram of five moving points changes once: one point enters the sphere of the other four.
#include <cstdio>

#include "kds/simulator.h"
#include "motions/curves/bezier_motion.h"
#include "structures/power_diagram/power_diagram.h"

int main() {
  using Motion = kds::BezierMotion<3, 1>;  // in space, linear in u
  const double start[5][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {5, 5, 5}};
  Motion motion(5);
  for (kds::BeadId bead = 0; bead < 5; ++bead)
    for (int axis = 0; axis < 3; ++axis)
      for (int end = 0; end < 2; ++end)  // the fifth moves to (2, 2, 2)
        motion.set_coordinate(bead, end, axis, bead == 4 && end == 1 ? 2.0 : start[bead][axis]);
  kds::Simulator simulator(kds::AuditMode::events);  // audits against CGAL between all events
  kds::PowerDiagram<3> diagram(simulator, motion);
  simulator.build();
  simulator.run_step();
  std::printf("flips: %d\n", int(diagram.statistics.events_per_step.front()));
}
