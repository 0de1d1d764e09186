#pragma once
// Plays a recorded formula in one number type: performs the operations that the formula performs over a
// view of that type, step by step. Only the few files of this folder that play formulas include this header.
// Values are stored in buffers that a thread reuses, so the caller must copy the result before it plays
// another formula.

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

/// Provides the beads' values to a formula. Each formula is played by the same code for a number type,
/// whatever the view.
template <class Number>
class BeadSource {
 public:
  /// Stores the value of a step, and of the following steps that are its other coordinates, at their slots.
  virtual void read(const FormulaStep* step, std::span<Coefficients<Number>> values) const = 0;

 protected:
  ~BeadSource() = default;
};

template <class View>
class ViewedBeads final : public BeadSource<typename View::Number> {
  using Number = typename View::Number;
  using Kind = FormulaStep::Kind;

 public:
  /// `beads`: the beads that the formula names by their indices; empty if the view does not distinguish
  /// beads.
  explicit ViewedBeads(const View& view, std::span<const BeadId> beads = {}) : view_(view), beads_(beads) {}

  void read(const FormulaStep* step, std::span<Coefficients<Number>> values) const override {
    const BeadId i = beads_.empty() ? step->a : beads_[step->a];
    const BeadId j = beads_.empty() ? step->b : beads_[step->b];
    Coefficients<Number>& value = values[step->slot];
    switch (step->kind) {
      case Kind::weight:
        return set(value, view_.weight(i));
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
        for (auto& coordinate : view_.difference(i, j)) set(values[step++->slot], std::move(coordinate));
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

/// Returns the scaled coefficients of the formula's value. The coefficients are valid until the thread plays
/// another formula in this number type.
template <class Number>
[[gnu::noinline]] Coefficients<Number>& play(const RecordedFormula& formula,
                                             const BeadSource<Number>& beads) {
  using Kind = FormulaStep::Kind;
  thread_local std::vector<Coefficients<Number>> room;
  if (room.size() < formula.slots()) room.resize(formula.slots());
  const std::span<Coefficients<Number>> values = room;
  for (const FormulaStep& step : formula.steps()) {
    Coefficients<Number>& value = values[step.slot];
    const auto start_from_a = [&] {
      if (step.slot != step.a) value = values[step.a];
    };
    switch (step.kind) {
      case Kind::centre_difference:
      case Kind::weight:
      case Kind::weight_difference:
      case Kind::radius_difference:
      case Kind::radius_sum:
      case Kind::lift_difference:
        beads.read(&step, values);
        break;
      case Kind::next_coordinate:
        break;  // read together with the first coordinate
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
        const bool is_multiple = step.number < 0 || own == 0;  // at a single moment all degrees are 0
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

// The motions that formulas are played over.
#define KDS_FOR_EACH_PLAYED_MOTION(compile) \
  compile(Curves<1>) compile(Curves<2>) compile(Curves<3>) compile(LiftedCurves<2>) compile(LiftedCurves<3>)
