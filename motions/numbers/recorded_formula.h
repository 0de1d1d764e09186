#pragma once
// A formula over polynomials, recorded step by step instead of computed. Evaluating the formula of a
// certificate over a RecordingView (motions/views/motion_view.h) records it. Any number type can later
// play the recorded formula (certificates/formulas/formula_player.h). Rarely used number types are therefore
// compiled once, not once per formula. Playing a formula performs exactly the recorded operations: nothing is
// rounded, reordered or left out.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/numbers/bernstein.h"

namespace kds {

/// One operation of a recorded formula. In the first seven kinds, `a` and `b` are beads. In the other kinds
/// they are the slots of the operands; while the formula is being recorded, they are the numbers of the
/// steps that compute the operands.
struct FormulaStep {
  enum class Kind : std::uint8_t {
    centre_difference,  ///< its first coordinate; the next steps are the other coordinates
    next_coordinate,
    weight,  ///< of a
    weight_difference,
    radius_difference,
    radius_sum,
    lift_difference,
    sum,
    difference,
    negative,
    product,
    elevated,  ///< a, elevated to the degree `number`; if negative, to -number times a's degree
    multiple   ///< `number` times a
  };

  Kind kind;
  std::uint16_t a = 0, b = 0;
  std::int64_t number = 0;
  /// The slot where the result is stored. Steps share a slot once its value is no longer needed. In sums,
  /// differences, negatives and multiples the slot may be that of `a`.
  std::uint16_t slot = 0;
};

class RecordedFormula {
 public:
  using Kind = FormulaStep::Kind;

  /// Appends a step and returns its number. Throws std::length_error if there are already 2^16 steps.
  std::uint16_t add(Kind kind, std::uint16_t a, std::uint16_t b = 0, std::int64_t number = 0);
  /// Ends the recording and assigns slots. `result` is the step that computes the formula's value.
  void finish(std::uint16_t result);

  [[nodiscard]] std::span<const FormulaStep> steps() const { return steps_; }
  /// Returns the slot where the formula's value is finally stored.
  [[nodiscard]] std::size_t result() const { return result_; }
  /// Returns the number of slots.
  [[nodiscard]] std::size_t slots() const { return slots_; }

 private:
  std::vector<FormulaStep> steps_;
  std::size_t result_ = 0;
  std::size_t slots_ = 0;
};

/// Stands in for the number type of polynomials that are recorded, not computed.
struct Recorded {};

namespace detail {

/// Appends a step to `formula`. Throws std::logic_error if an operand was never given a value (`formula` is
/// null), and std::invalid_argument if `number` exceeds 2^53 in size.
[[nodiscard]] std::uint16_t record(RecordedFormula* formula, FormulaStep::Kind kind, std::uint16_t a,
                                   std::uint16_t b = 0, std::int64_t number = 0);

}  // namespace detail

template <int DegreeValue>
struct Bernstein<Recorded, DegreeValue> {
  using Number = Recorded;
  using Kind = FormulaStep::Kind;
  static constexpr int degree = DegreeValue;

  RecordedFormula* formula = nullptr;
  std::uint16_t step = 0;

  Bernstein& operator+=(const Bernstein& other) { return *this = *this + other; }
  Bernstein& operator-=(const Bernstein& other) { return *this = *this - other; }
  friend Bernstein operator+(const Bernstein& a, const Bernstein& b) {
    return {a.formula, detail::record(b.formula ? a.formula : nullptr, Kind::sum, a.step, b.step)};
  }
  friend Bernstein operator-(const Bernstein& a, const Bernstein& b) {
    return {a.formula, detail::record(b.formula ? a.formula : nullptr, Kind::difference, a.step, b.step)};
  }
  friend Bernstein operator-(const Bernstein& a) {
    return {a.formula, detail::record(a.formula, Kind::negative, a.step)};
  }
};

template <int A, int B>
Bernstein<Recorded, A + B> operator*(const Bernstein<Recorded, A>& a, const Bernstein<Recorded, B>& b) {
  return {a.formula,
          detail::record(b.formula ? a.formula : nullptr, FormulaStep::Kind::product, a.step, b.step)};
}

template <int To, int From>
Bernstein<Recorded, To> elevate(const Bernstein<Recorded, From>& p) {
  static_assert(From < 0 ? To <= From && To % From == 0 : To >= From);
  if constexpr (To == From) {
    return p;
  } else {
    constexpr int number = From < 0 ? -(To / From) : To;
    return {p.formula, detail::record(p.formula, FormulaStep::Kind::elevated, p.step, 0, number)};
  }
}

/// Returns `factor` times `p`. Throws std::invalid_argument if |factor| > 2^53.
template <int Degree>
Bernstein<Recorded, Degree> times(std::int64_t factor, const Bernstein<Recorded, Degree>& p) {
  return {p.formula, detail::record(p.formula, FormulaStep::Kind::multiple, p.step, 0, factor)};
}

}  // namespace kds
