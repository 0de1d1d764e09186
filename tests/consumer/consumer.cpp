// Three beads on a line, each of which passes the other two.
#include <cstdio>

#include "kds/simulator.h"
#include "motions/curves/bezier_motion.h"
#include "motions/numbers/lanes.h"
#include "structures/sorted/sorted_list.h"

int main() {
  kds::BezierMotion<1, 1> motion(3);
  for (kds::BeadId bead = 0; bead < 3; ++bead) {
    motion.set_coordinate(bead, 0, 0, bead);
    motion.set_coordinate(bead, 1, 0, -2.0 * bead);
  }
  kds::Simulator simulator;
  kds::SortedList<1> list(simulator, motion);
  simulator.build();
  simulator.run_step();
  std::printf("events: %d\n", static_cast<int>(list.statistics.events_per_step.front()));
}
