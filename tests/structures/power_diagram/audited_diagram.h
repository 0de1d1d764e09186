#pragma once
// A power diagram in space that is run with audits and inspected with exact numbers.

#include <gmock/gmock.h>

#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "motions/base/input_error.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/triangulation/regular_triangulation.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/judges/cgal_triangulation.h"
#include "tests/support/judges/exact_checks.h"

namespace kds::test {

using PowerRig = Rig<PowerDiagram<3>, Space>;

/// Checks the final cells at u = 1 by the definition and against CGAL over rationals.
inline void expect_right_at_the_end(PowerRig& rig) {
  const StaticTriangulation<3> end = rig.structure.at_frame(false);
  const auto points = exact_points(rig.motion, Dyadic(1.0));
  const CgalCells cgal = cgal_regular_cells(points);
  ASSERT_TRUE(cgal.valid);
  EXPECT_EQ(points.size() - end.hidden.size(), cgal.visible);
  EXPECT_EQ(end.cells.empty(), cgal.cells.empty());
  EXPECT_EQ(not_regular(points, end.cells), std::nullopt);
}

/// Returns a witness that checks every `stride`-th audit between events of the first step by the definition.
/// (Later steps may start from a flat frame, which `at_frame` checks.) The positions are those of a slightly
/// later time, because cells may be flat at a single moment without an event.
inline Witness::Look definition(PowerRig& rig, int stride) {
  return [&rig, stride, count = 0](const Dyadic& time) mutable -> std::optional<std::string> {
    if (rig.simulator.step() != 0 || time == Dyadic(0.0) || time == Dyadic(1.0) || count++ % stride != 0)
      return std::nullopt;
    const Dyadic later((time.numerator() << 100U) + 1, time.exponent() + 100);
    return not_regular(exact_points(rig.motion, later), rig.structure.at_frame(false).cells);
  };
}

/// Runs with audits between all events. Returns true if the run was refused with an InputError, which is
/// allowed.
inline bool run_audited(const std::vector<Space>& steps, bool look = true, Kernel kernel = Kernel::filtered) {
  PowerRig rig(steps.front(), AuditMode::events, kernel);
  Witness witness(
      rig.simulator, look ? definition(rig, 1) : [](const Dyadic&) { return std::nullopt; });
  try {
    rig.run(steps);
  } catch (const InputError&) {
    return true;
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
    return false;
  }
  expect_right_at_the_end(rig);
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  return false;
}

inline std::string to_text(const std::vector<Points>& frames) { return testing::PrintToString(frames); }

}  // namespace kds::test
