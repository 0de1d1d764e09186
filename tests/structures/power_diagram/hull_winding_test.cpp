// Beads pass through the hull together, at moments at which cells of the hull touch flatness without changing
// sign. Afterwards each certificate holds although the hull winds around twice, so the winding number must be
// checked.

#include <gmock/gmock.h>

#include "structures/power_diagram/power_diagram.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/text_of.h"

namespace kds::hull_winding_test {
namespace {

using namespace test;
using testing::ElementsAre;

template <int Dimension, int Degree>
using Bezier = BezierMotion<Dimension, Degree>;

/// The beads' final cells, after audits between all events.
template <class M>
std::vector<CellBeads<M::dimension>> cells_at_the_end(const M& motion, Kernel kernel) {
  Rig<PowerDiagram<M::dimension>, M> rig(motion, AuditMode::events, kernel);
  rig.run();
  return rig.structure.at_frame(false).cells;
}

/// Makes a motion from the centres in two frames and one weight per bead.
template <int Dimension>
Bezier<Dimension, 1> between(const Points& from, const Points& to, const std::vector<double>& weights) {
  Bezier<Dimension, 1> motion(from.size());
  for (BeadId b = 0; b < from.size(); ++b) {
    for (int axis = 0; axis < Dimension; ++axis) {
      motion.set_coordinate(b, 0, axis, from[b][static_cast<std::size_t>(axis)]);
      motion.set_coordinate(b, 1, axis, to[b][static_cast<std::size_t>(axis)]);
    }
    for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, weights[b]);
  }
  return motion;
}

class HullWinding : public testing::TestWithParam<Kernel> {};

// Five of six beads lie in one plane on the hull at u = 1/2; radii are equal.
TEST_P(HullWinding, FiveBeadsInAPlaneOfTheHull) {
  const auto motion = between<3>({{1, 0, 0}, {1, 1, 1}, {2, 0, 1}, {1, 2, 2}, {2, 1, 0}, {2, 0, 2}},
                                 {{1, 1, 0}, {0, 0, 2}, {0, 1, 1}, {1, 2, 2}, {1, 0, 2}, {0, 1, 2}},
                                 std::vector<double>(6, 1.0));
  EXPECT_THAT(cells_at_the_end(motion, GetParam()),
              ElementsAre(CellBeads<3>{0, 1, 2, 4}, CellBeads<3>{0, 2, 3, 4}, CellBeads<3>{1, 2, 4, 5},
                          CellBeads<3>{2, 3, 4, 5}));
}

// Two beads meet exactly on an edge of the hull at u = 0.8 and cross it together; radii are unequal.
TEST_P(HullWinding, TwoBeadsCrossAnEdgeTogether) {
  const auto motion =
      between<2>({{2, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {0, 1, 0}},
                 {{2, 0, 0}, {1, 0, 0}, {1.25, 1.25, 0}, {1.625, 0.375, 0}, {1, 2, 0}, {1.25, 1, 0}},
                 {0, 0, 0, 0, 0, 0.0625});
  EXPECT_THAT(
      cells_at_the_end(motion, GetParam()),
      ElementsAre(CellBeads<2>{0, 1, 3}, CellBeads<2>{0, 2, 3}, CellBeads<2>{0, 2, 4}, CellBeads<2>{1, 3, 5},
                  CellBeads<2>{1, 4, 5}, CellBeads<2>{2, 3, 5}, CellBeads<2>{2, 4, 5}));
}

// A bead is up to 10^150 times farther away than the others: cells that fill a hole may fold the hull flat.
TEST_P(HullWinding, SurvivesABeadFromFarAway) {
  for (const double far : {1e30, 1e80, 1e150}) {
    const auto motion = between<3>({{1, 1, -1}, {-1, -1, -1}, {1, -1, -1}, {far, -far, 0}, {-1, 1, -1}},
                                   {{0, 0, -1}, {0, 0, 1}, {1, -1, -1}, {0, 0, -far}, {1, -1, -1}},
                                   std::vector<double>(5, 0.0));
    // All beads end in one plane.
    EXPECT_TRUE(cells_at_the_end(motion, GetParam()).empty()) << far;
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, HullWinding, testing::ValuesIn({Kernel::filtered, Kernel::exact}),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace kds::hull_winding_test
