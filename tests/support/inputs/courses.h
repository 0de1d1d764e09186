#pragma once
// Courses of beads that tests set, bend and continue while time runs, and a check that an edit was refused.

#include <gmock/gmock.h>

#include <array>
#include <stdexcept>

#include "tests/support/inputs/random_motion.h"

namespace kds::test {

enum class Positions {
  generic,  ///< in [-2, 2], with few enough bits that sums are exact
  grid      ///< whole numbers from a small range: many ties
};

inline double draw_coordinate(Random& random, Positions positions) {
  return positions == Positions::grid ? pick(random, -2, 2) : 0x1p-16 * pick(random, -(1 << 17), 1 << 17);
}

/// Bends the bead's linear course at u: the position at u stays, the end of the course changes.
template <class M>
void bend(M& motion, BeadId b, double u, Random& random) {
  for (int axis = 0; axis < M::dimension; ++axis) {
    const double d = 0x1p-8 * pick(random, -128, 128);
    motion.set_coordinate(b, 0, axis, motion.coordinate(b, 0, axis) + u * d);
    motion.set_coordinate(b, 1, axis, motion.coordinate(b, 1, axis) - (1 - u) * d);
  }
}

template <class Call>
void expect_edit_refused(Call call, const char* why) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(why));
    return;
  }
  ADD_FAILURE() << "not refused: " << why;
}

}  // namespace kds::test
