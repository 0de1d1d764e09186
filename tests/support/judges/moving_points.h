#pragma once
// Runs structures over moving points. Each audit compares the structure with the exact positions, and runs
// with other kernels and replays must agree. The positions are computed with numbers that are not the
// library's.

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/second_numbers.h"

namespace kds::test {

/// The coordinates of each bead, all multiplied by one positive number, which makes them whole.
using ExactPoints = std::vector<std::vector<second::Integer>>;

/// Returns a power of two, as its exponent, of which all coordinates and 1/4 are multiples.
template <Motion M>
int unit_of_points(const M& motion) {
  std::vector<double> all{0.25};
  for (BeadId b = 0; b < motion.bead_count(); ++b)
    for (int k = 0; k <= degree_of(motion); ++k)
      for (int axis = 0; axis < M::dimension; ++axis) all.push_back(motion.coordinate(b, k, axis));
  return second::unit_of(all);
}

/// Computes the positions of the beads at u in [0,1] by the definition of Bezier curves.
template <Motion M>
ExactPoints points_at(const M& motion, const second::Rational& u) {
  const int unit = unit_of_points(motion);
  ExactPoints points(motion.bead_count());
  for (BeadId b = 0; b < points.size(); ++b)
    for (int axis = 0; axis < M::dimension; ++axis) {
      std::vector<double> x;
      for (int k = 0; k <= degree_of(motion); ++k) x.push_back(motion.coordinate(b, k, axis));
      points[b].push_back(second::whole_value(x, u, unit));
    }
  return points;
}

/// Returns a length of 1/4, multiplied by the same number as the coordinates of points_at.
template <Motion M>
second::Integer quarter_at(const M& motion, const second::Rational& u) {
  const std::vector<double> quarter(static_cast<std::size_t>(degree_of(motion)) + 1, 0.25);
  return second::whole_value(quarter, u, unit_of_points(motion));
}

/// Makes steps of random motions; each starts at the end of the step before it.
template <Motion M>
std::vector<M> random_steps(Random& random, std::size_t beads, MotionKind kind, std::size_t count) {
  std::vector<M> steps;
  for (std::size_t k = 0; k < count; ++k) {
    steps.push_back(random_motion<M>(random, beads, kind));
    for (BeadId b = 0; k > 0 && b < beads; ++b)
      for (int axis = 0; axis < M::dimension; ++axis)
        steps[k].set_coordinate(b, 0, axis, steps[k - 1].coordinate(b, M::degree, axis));
  }
  return steps;
}

/// Runs the steps with audits between all events. Calls `fault(structure, points)` at each audit and
/// `answer(structure)` at the end. A run with the exact kernel and a replay must have the same history.
/// Returns the history.
template <class Structure, Motion M, class Fault, class Answer>
History expect_right_at_all_times(const std::vector<M>& steps, Fault fault, Answer answer) {
  Rig<Structure, M> filtered(steps.front(), AuditMode::events);
  const Witness witness(filtered.simulator, [&](const Dyadic& time) -> std::optional<std::string> {
    return fault(filtered.structure, points_at(filtered.motion, second::of(time)));
  });
  EXPECT_NO_THROW(filtered.run(steps));
  EXPECT_TRUE(books_balance(filtered.structure.statistics));

  Rig<Structure, M> exact(steps.front(), AuditMode::none, Kernel::exact);
  exact.run(steps);
  EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
  EXPECT_EQ(answer(exact.structure), answer(filtered.structure));
  Rig<Structure, M> again(steps.front(), AuditMode::frames);
  EXPECT_NO_THROW(again.replay(steps, filtered.history));
  EXPECT_EQ(again.simulator.fingerprint(), filtered.simulator.fingerprint());
  EXPECT_EQ(answer(again.structure), answer(filtered.structure));
  return filtered.history;
}

}  // namespace kds::test
