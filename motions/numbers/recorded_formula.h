#pragma once
// A formula over polynomials, written down instead of computed: what the formula of a certificate becomes
// over a RecordingView (motions/views/recording_view.h). Any kind of number can play it afterwards
// (certificates/formulas/formula_player.h), so that kinds that are seldom asked for are compiled once and not
// once a formula. Nothing is rounded, reordered or left out: whoever plays it computes what the formula says.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/numbers/bernstein.h"

namespace kds {

/// `a` and `b` are beads in the first six kinds. In the others they are where the values lie that it is made
/// of; while the formula is being written, the steps that have them.
struct FormulaStep {
  enum class Kind : std::uint8_t {
    centre_difference,  ///< its first coordinate; the others are the steps after it
    next_coordinate,
    weight_difference,
    radius_difference,
    radius_sum,
    lift_difference,
    sum,
    difference,
    negative,
    product,
    elevated,  ///< a, to the degree `number`; to -number times its own where that is negative
    multiple   ///< `number` times a
  };

  Kind kind;
  std::uint16_t a = 0, b = 0;
  std::int64_t number = 0;
  /// Where its value is to lie; steps share a place whose value nobody needs any more. In sums, differences,
  /// negatives and multiples it may be a.
  std::uint16_t place = 0;
};

class RecordedFormula {
 public:
  using Kind = FormulaStep::Kind;

  /// The new step. Throws std::length_error if there are 2^16 already.
  std::uint16_t add(Kind kind, std::uint16_t a, std::uint16_t b = 0, std::int64_t number = 0);
  /// When all are there, and `result` is the formula's value.
  void finish(std::uint16_t result);

  [[nodiscard]] std::span<const FormulaStep> steps() const { return steps_; }
  /// Where the formula's value lies at last.
  [[nodiscard]] std::size_t result() const { return result_; }
  /// Of values.
  [[nodiscard]] std::size_t places() const { return places_; }

 private:
  std::vector<FormulaStep> steps_;
  std::size_t result_ = 0;
  std::size_t places_ = 0;
};

/// In the place of a number type, of polynomials that are written down.
struct Recorded {};

namespace detail {

/// Throws std::logic_error where one of them was never given a value, std::invalid_argument where a double
/// does not hold the number.
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

/// A whole number of times a polynomial: one of at most 2^53 in size, std::invalid_argument.
template <int Degree>
Bernstein<Recorded, Degree> times(std::int64_t factor, const Bernstein<Recorded, Degree>& p) {
  return {p.formula, detail::record(p.formula, FormulaStep::Kind::multiple, p.step, 0, factor)};
}

}  // namespace kds
