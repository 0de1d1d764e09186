#include "motions/numbers/recorded_formula.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "motions/views/motion_view.h"

namespace kds::recorded_formula_test {
namespace {

using Kind = FormulaStep::Kind;
using View = RecordingView<2, false, Channels{.weights = true, .radii = true}>;

std::vector<Kind> kinds_of(const RecordedFormula& formula) {
  std::vector<Kind> kinds;
  for (const FormulaStep& step : formula.steps()) kinds.push_back(step.kind);
  return kinds;
}

TEST(RecordedFormula, WritesDownEachStepInItsOrder) {
  RecordedFormula formula;
  const View view(formula);
  const auto d = view.difference(1, 0);
  const auto x = d[0] * d[0];
  const auto y = d[1] * d[1];
  const auto sum = x + y;
  const auto weight = view.weight_difference(1, 0);
  const auto square = sum - elevate<2 * View::degree>(weight);
  formula.finish((-times(3, square)).step);
  EXPECT_EQ(kinds_of(formula), (std::vector{Kind::centre_difference, Kind::next_coordinate, Kind::product,
                                            Kind::product, Kind::sum, Kind::weight_difference, Kind::elevated,
                                            Kind::difference, Kind::multiple, Kind::negative}));
  EXPECT_EQ(formula.steps()[0].a, 1);
  EXPECT_EQ(formula.steps()[0].b, 0);
  EXPECT_EQ(formula.steps()[6].number, -2);
  EXPECT_EQ(formula.steps()[8].number, 3);
}

/// Tracks which step's value each slot holds: the operands of a step must still be in their slots.
TEST(RecordedFormula, NoValueIsOverwrittenThatIsStillNeeded) {
  RecordedFormula formula;
  const View view(formula);
  const auto a = view.difference(1, 0), b = view.difference(2, 0);
  const auto r = view.radius_sum(0, 1);
  static_cast<void>(view.radius_difference(0, 1));  // computed and not used
  auto x = a[0] * b[1];
  x += x;
  x -= a[1] * b[0];
  const auto y = r * r;
  auto z = -(x - y) * y;
  z += x * x;
  z += times(5, y) * x;
  const RecordedFormula written = formula;  // operands are steps here, not slots
  const std::uint16_t last = z.step;
  EXPECT_THROW(z += decltype(z){}, std::logic_error);
  formula.finish(last);

  EXPECT_LT(formula.slots(), formula.steps().size());
  std::vector<std::size_t> lies(formula.slots(), SIZE_MAX);
  for (std::size_t i = 0; i < formula.steps().size(); ++i) {
    const FormulaStep& step = formula.steps()[i];
    const FormulaStep& as_written = written.steps()[i];
    if (step.kind > Kind::lift_difference) {
      EXPECT_EQ(lies[step.a], as_written.a) << i;
      if (step.kind == Kind::sum || step.kind == Kind::difference || step.kind == Kind::product) {
        EXPECT_EQ(lies[step.b], as_written.b) << i;
        EXPECT_NE(step.slot, step.b) << i;
      }
      const bool in_place = step.kind != Kind::product && step.kind != Kind::elevated;
      EXPECT_TRUE(in_place || step.slot != step.a) << i;
    }
    lies[step.slot] = i;
  }
  EXPECT_EQ(lies[formula.result()], last);
}

TEST(RecordedFormula, HoldsSixtyFiveThousandSteps) {
  RecordedFormula formula;
  std::uint16_t step = formula.add(Kind::radius_sum, 0, 1);
  for (int i = 1; i < 65536; ++i) step = formula.add(Kind::negative, step);
  EXPECT_THROW(formula.add(Kind::negative, step), std::length_error);
  formula.finish(step);
  EXPECT_EQ(formula.slots(), 1U);
}

}  // namespace
}  // namespace kds::recorded_formula_test
