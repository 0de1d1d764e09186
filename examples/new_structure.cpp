// Runs a structure defined outside the framework: the pairs of beads within a cutoff that changes in time.
// The first run is audited exactly between all events; a second run uses integers alone. Both histories are
// equal.
#include "examples/new_structure.h"

#include <cmath>
#include <cstdio>

#include "certificates/search/define_certificate_search.h"
#include "motions/curves/bezier_motion.h"

namespace {

constexpr kds::BeadId beads = 24;
constexpr int steps = 4;
using Motion = kds::BezierMotion<2, 1>;  // in the plane, linear between two frames

/// Places beads on two circles that rotate in opposite directions.
void set_position(Motion& motion, int end, int frame) {
  for (kds::BeadId bead = 0; bead < beads; ++bead) {
    const double radius = bead % 2 == 0 ? 5 : 4, turn = (bead % 2 == 0 ? 0.2 : -0.3) * frame + 0.5 * bead;
    motion.set_coordinate(bead, end, 0, radius * std::cos(turn));
    motion.set_coordinate(bead, end, 1, radius * std::sin(turn));
  }
}

double cutoff_at(int frame) { return frame % 2 == 0 ? 1.25 : 2.5; }

std::uint64_t run(kds::Kernel kernel, bool tell) {
  Motion motion(beads);
  kds::Simulator simulator(kds::AuditMode::events, kernel);
  NeighborPairs<2> neighbors(simulator, motion);
  for (int step = 0; step < steps; ++step) {
    set_position(motion, 0, step);
    set_position(motion, 1, step + 1);
    neighbors.set_cutoff({cutoff_at(step), cutoff_at(step + 1)});
    if (step == 0) simulator.build();
    simulator.run_step();
  }
  simulator.finish();
  const auto& events = neighbors.statistics.events_by_kind;
  if (tell)
    std::printf("%d pairs meet, %d part, %d are left; %d certificates\n", static_cast<int>(events[1]),
                static_cast<int>(events[0]), static_cast<int>(neighbors.pairs().size()),
                static_cast<int>(neighbors.statistics.certificates.created));
  return simulator.fingerprint();
}

}  // namespace

int main() {
  const std::uint64_t history = run(kds::Kernel::filtered, true);
  std::printf("on integers: %s\n",
              run(kds::Kernel::exact, false) == history ? "the same" : "another history");
}
