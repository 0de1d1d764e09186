#pragma once
// Runs structures over moving points. Each audit compares the structure with the exact positions, and runs
// with other kernels and replays must agree. This file uses nothing of the library except its numbers.

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "motions/numbers/exact_number.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::test {

using ExactPoints = std::vector<std::vector<Rational>>;  ///< the coordinates of each bead

/// Computes the positions of the beads by de Casteljau's algorithm.
template <Motion M>
ExactPoints points_at(const M& motion, const Rational& u) {
  const int degree = degree_of(motion);
  ExactPoints points(motion.bead_count());
  for (BeadId b = 0; b < points.size(); ++b) {
    for (int axis = 0; axis < M::dimension; ++axis) {
      std::vector<Rational> x;
      for (int k = 0; k <= degree; ++k) x.emplace_back(motion.coordinate(b, k, axis));
      for (int left = degree; left > 0; --left)
        for (int k = 0; k < left; ++k) {
          const auto at = static_cast<std::size_t>(k);
          x[at] = (1 - u) * x[at] + u * x[at + 1];
        }
      points[b].push_back(x.front());
    }
  }
  return points;
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
/// `answer(structure)` at the end. Runs with the other kernels and a replay must have the same history.
/// Returns the history.
template <class Structure, Motion M, class Fault, class Answer>
History expect_right_at_all_times(const std::vector<M>& steps, Fault fault, Answer answer) {
  Rig<Structure, M> filtered(steps.front(), AuditMode::events);
  const Witness witness(filtered.simulator, [&](const Dyadic& time) -> std::optional<std::string> {
    return fault(filtered.structure, points_at(filtered.motion, time.rational()));
  });
  EXPECT_NO_THROW(filtered.run(steps));
  EXPECT_TRUE(books_balance(filtered.structure.statistics));

  Rig<Structure, M> exact(steps.front(), AuditMode::none, Kernel::exact);
  exact.run(steps);
  EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
  EXPECT_EQ(answer(exact.structure), answer(filtered.structure));
  Rig<Structure, M> fast(steps.front(), AuditMode::none, Kernel::fast);
  EXPECT_NO_THROW(fast.run(steps));
  Rig<Structure, M> again(steps.front(), AuditMode::frames);
  EXPECT_NO_THROW(again.replay(steps, filtered.history));
  EXPECT_EQ(again.simulator.fingerprint(), filtered.simulator.fingerprint());
  EXPECT_EQ(answer(again.structure), answer(filtered.structure));
  return filtered.history;
}

}  // namespace kds::test
