#pragma once
// Plays a recorded formula in one kind of number, step by step: what the formula computes over a view of that
// kind, operation by operation. For the few files of this folder that do so. Values lie in room that a thread
// uses again and again: who plays a formula takes what it needs of its value, before anything else is asked.

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "motions/base/bead.h"
#include "motions/numbers/recorded_formula.h"
#include "motions/views/motion_view.h"

namespace kds {

/// What a formula asks of beads. Of a number type each formula is played by the same code, whatever the view.
template <class Number>
class BeadSource {
 public:
  /// Puts the step's value, and those of the steps after it that are its other coordinates, in their places.
  virtual void read(const FormulaStep* step, std::span<Coefficients<Number>> values) const = 0;

 protected:
  ~BeadSource() = default;
};

template <class View>
class ViewedBeads final : public BeadSource<typename View::Number> {
  using Number = typename View::Number;
  using Kind = FormulaStep::Kind;

 public:
  /// `beads`: those that the formula names by their places; none, where the view tells no beads apart.
  explicit ViewedBeads(const View& view, std::span<const BeadId> beads = {}) : view_(view), beads_(beads) {}

  void read(const FormulaStep* step, std::span<Coefficients<Number>> values) const override {
    const BeadId i = beads_.empty() ? step->a : beads_[step->a];
    const BeadId j = beads_.empty() ? step->b : beads_[step->b];
    Coefficients<Number>& value = values[step->place];
    switch (step->kind) {
      case Kind::weight_difference:
        return set(value, view_.weight_difference(i, j));
      case Kind::radius_difference:
        return set(value, view_.radius_difference(i, j));
      case Kind::radius_sum:
        return set(value, view_.radius_sum(i, j));
      case Kind::lift_difference:
        if constexpr (LiftedView<View>) {
          return set(value, view_.lift_difference(i, j));
        } else {
          throw std::logic_error("a formula asks for lifts of a motion that has none");
        }
      default:
        for (auto& coordinate : view_.difference(i, j)) set(values[step++->place], std::move(coordinate));
    }
  }

 private:
  template <int Degree>
  static void set(Coefficients<Number>& value, Bernstein<Number, Degree>&& p) {
    if constexpr (Degree < 0) {
      value = std::move(p.scaled);
    } else {
      value.resize(p.scaled.size());
      std::move(p.scaled.begin(), p.scaled.end(), value.begin());
    }
  }

  const View& view_;
  std::span<const BeadId> beads_;
};

/// The scaled coefficients of the formula's value, there until the thread plays the next in this kind of
/// number.
template <class Number>
[[gnu::noinline]] Coefficients<Number>& play(const RecordedFormula& formula,
                                             const BeadSource<Number>& beads) {
  using Kind = FormulaStep::Kind;
  thread_local std::vector<Coefficients<Number>> room;
  if (room.size() < formula.places()) room.resize(formula.places());
  const std::span<Coefficients<Number>> values = room;
  for (const FormulaStep& step : formula.steps()) {
    Coefficients<Number>& value = values[step.place];
    const auto start_from_a = [&] {
      if (step.place != step.a) value = values[step.a];
    };
    switch (step.kind) {
      case Kind::centre_difference:
      case Kind::weight_difference:
      case Kind::radius_difference:
      case Kind::radius_sum:
      case Kind::lift_difference:
        beads.read(&step, values);
        break;
      case Kind::next_coordinate:
        break;  // read with the first
      case Kind::sum:
        start_from_a();
        detail::add_to<Number>(value, values[step.b]);
        break;
      case Kind::difference:
        start_from_a();
        detail::subtract_from<Number>(value, values[step.b]);
        break;
      case Kind::negative:
        start_from_a();
        detail::negate<Number>(value);
        break;
      case Kind::product:
        detail::multiply<Number>(values[step.a], values[step.b], value);
        break;
      case Kind::elevated: {
        const std::size_t own = values[step.a].size() - 1;
        const bool is_multiple = step.number < 0 || own == 0;  // at a moment all degrees are 0
        const auto number = static_cast<std::size_t>(std::abs(step.number));
        detail::elevate_to<Number>(is_multiple ? own * number : number, values[step.a], value);
        break;
      }
      case Kind::multiple:
        start_from_a();
        for (Number& c : value) detail::multiply_by(c, step.number);
        break;
    }
  }
  return values[formula.result()];
}

}  // namespace kds

// What formulas are played over.
#define KDS_FOR_EACH_PLAYED_MOTION(compile) \
  compile(Curves<1>) compile(Curves<2>) compile(Curves<3>) compile(LiftedCurves<2>) compile(LiftedCurves<3>)
