#include "certificates/formulas/function_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "certificates/exact/exact_work.h"
#include "certificates/exact/recent_functions.h"
#include "certificates/exact/wide_polynomial.h"
#include "certificates/filters/tracked_moment.h"
#include "certificates/formulas/formula_player.h"
#include "motions/curves/curves.h"
#include "motions/curves/lifted_motion.h"
#include "motions/views/integer_view.h"

namespace kds {

namespace {

/// Sets the error bounds for values and after subdivision from one bound for all plain coefficients.
void set_errors(BoundedPolynomial& p, double uniform_error) {
  double largest = 0;
  for (const double c : p.bernstein) largest = std::max(largest, std::abs(c));
  // Rounding errors are relative only down to this size.
  if (largest < 0x1p-900) uniform_error = std::nan("");
  p.value_error = uniform_error + value_rounding(p.degree()) * largest;
  p.local_error = uniform_error + local_rounding(p.degree()) * largest;
}

/// Evaluates a formula with all degrees 0 in plain numbers. Does the work of `play`, because each event
/// evaluates a few such formulas.
template <class View>
TrackedDouble value_at_moment(const RecordedFormula& formula, const View& view) {
  using Kind = FormulaStep::Kind;
  thread_local std::vector<TrackedDouble> room;
  if (room.size() < formula.slots()) room.resize(formula.slots());
  TrackedDouble* const values = room.data();
  for (const FormulaStep& step : formula.steps()) {
    TrackedDouble& value = values[step.slot];
    switch (step.kind) {
      case Kind::centre_difference: {
        const FormulaStep* coordinate = &step;
        for (const auto& difference : view.difference(step.a, step.b))
          values[(coordinate++)->slot] = difference.scaled[0];
        break;
      }
      case Kind::next_coordinate:
        break;
      case Kind::weight:
        value = view.weight(step.a).scaled[0];
        break;
      case Kind::weight_difference:
        value = view.weight_difference(step.a, step.b).scaled[0];
        break;
      case Kind::radius_difference:
        value = view.radius_difference(step.a, step.b).scaled[0];
        break;
      case Kind::radius_sum:
        value = view.radius_sum(step.a, step.b).scaled[0];
        break;
      case Kind::lift_difference:
        throw std::logic_error("lifts are no curves at a moment");
      case Kind::sum:
        value = values[step.a] + values[step.b];
        break;
      case Kind::difference:
        value = values[step.a] - values[step.b];
        break;
      case Kind::negative:
        value = -values[step.a];
        break;
      case Kind::product:
        value = values[step.a] * values[step.b];
        break;
      case Kind::elevated:
        value = values[step.a];
        break;
      case Kind::multiple:
        value = TrackedDouble{static_cast<double>(step.number)} * values[step.a];
        break;
    }
  }
  return values[formula.result()];
}

}  // namespace

BoundedFunction bounded_function(std::span<const double> scaled, const ErrorBound& bound,
                                 double largest_length) {
  const auto degree = static_cast<int>(scaled.size()) - 1;
  const double scale = bound.scale(largest_length);
  BoundedFunction result{{}, true};
  result.polynomial.bernstein.resize(scaled.size());
  for (std::size_t k = 0; k < scaled.size(); ++k) {
    result.positive &= scaled[k] > bound.coefficient[k] * scale;
    result.polynomial.bernstein[k] = scaled[k] / static_cast<double>(binomial(degree, static_cast<int>(k)));
  }
  set_errors(result.polynomial, bound.uniform * scale);
  return result;
}

template <class C>
BoundedFunction bounded_function(const BeadFunction& function, const C& curves) {
  const DoubleView<C> view(curves);
  Coefficients<double>& scaled = play(function.formula, ViewedBeads<DoubleView<C>>(view, function.beads));
  if (function.negative) detail::negate<double>(scaled);
  return bounded_function({scaled.begin(), scaled.size()}, function.known.error_bound(degree_of(curves)),
                          view.largest_length());
}

template <class C>
BoundedFunction tracked_function(const BeadFunction& function, const C& curves) {
  const TrackedView<C> view(curves, function.beads, function.known.channels());
  Coefficients<TrackedDouble>& scaled =
      play(function.formula, ViewedBeads<TrackedView<C>>(view, function.beads));
  if (function.negative) detail::negate<TrackedDouble>(scaled);
  const auto degree = static_cast<int>(scaled.size()) - 1;
  BoundedFunction result{{}, true};
  result.polynomial.bernstein.resize(scaled.size());
  double uniform = 0;
  for (std::size_t k = 0; k < scaled.size(); ++k) {
    const auto choose = static_cast<double>(binomial(degree, static_cast<int>(k)));
    const TrackedDouble& c = scaled[k];
    // The division rounds once more. A NaN stays NaN and proves nothing.
    const double error =
        (c.error + TrackedDouble::unit_roundoff * std::abs(c.value)) * TrackedDouble::inflation +
        TrackedDouble::lost_to_underflow;
    result.positive &= c.value > error;
    result.polynomial.bernstein[k] = c.value / choose;
    uniform = error <= uniform || std::isnan(uniform) ? uniform : error;
  }
  set_errors(result.polynomial, uniform);
  return result;
}

template <class C>
int certain_sign_during(const BeadFunction& function, const C& curves, double lower, double upper) {
  const Channels channels = function.known.channels();
  if (lifted<C> && channels.weights) return 0;
  const TrackedMoment<C> view(curves, function.beads, lower, upper, channels);
  const int sign = certain_sign(value_at_moment(function.formula, view));
  return function.negative ? -sign : sign;
}

#define KDS_COMPILE(C)                                                                      \
  template BoundedFunction bounded_function(const BeadFunction& function, const C& curves); \
  template BoundedFunction tracked_function(const BeadFunction& function, const C& curves); \
  template int certain_sign_during(const BeadFunction& function, const C& curves, double lower, double upper);
KDS_FOR_EACH_PLAYED_MOTION(KDS_COMPILE)
#undef KDS_COMPILE

namespace {

/// Charges the work of forming `count` coefficients of `bits` bits.
void spend_on_forming(std::size_t count, int bits) {
  ExactWork::spend(count * count * (static_cast<std::size_t>(bits) / 64 + 1));
}

/// Copies a played value before its work is charged, because the watcher of the work may play other formulas.
template <class Number>
std::vector<Number> taken(const Coefficients<Number>& played, int bits) {
  std::vector<Number> coefficients(played.begin(), played.end());
  spend_on_forming(coefficients.size(), bits);
  return coefficients;
}

/// Returns the formula's coefficients for curves whose lengths are whole numbers at `scale`. `size` bounds
/// the coefficients.
template <class C>
std::vector<Integer> whole_coefficients(const RecordedFormula& formula, std::span<const BeadId> beads,
                                        const C& curves, const CoefficientBits& size,
                                        const WholeScale& scale) {
  const int bits = size.bits + size.power * (scale.bits + 1);
  std::vector<Integer> scaled;
  if (bits < FixedInteger::bits) {
    const FixedView<C> view(curves, scale);
    const auto& p = play(formula, ViewedBeads<FixedView<C>>(view, beads));
    scaled.reserve(p.size());
    for (const FixedInteger& c : p) scaled.push_back(c.whole_number());
    spend_on_forming(scaled.size(), bits);
    return scaled;
  }
  const std::size_t count = residues_for(bits);
  if (count > residue_folds.size()) {
    const IntegerView<C> view(curves, scale);
    scaled = play(formula, ViewedBeads<IntegerView<C>>(view, beads));
    spend_on_forming(scaled.size(), bits);
    return scaled;
  }

  using Residual = std::array<std::uint64_t, residue_folds.size()>;
  std::vector<Residual> residues;  // for each coefficient
  for (std::size_t i = 0; i < count; ++i) {
    const ResidueView<C> view(curves, scale, {residue_folds[i]});
    const auto& p = play(formula, ViewedBeads<ResidueView<C>>(view, beads));
    residues.resize(p.size());
    for (std::size_t k = 0; k < p.size(); ++k) residues[k][i] = p[k].value;
  }
  scaled.reserve(residues.size());
  for (const auto& coefficient : residues)
    scaled.push_back(whole_number(std::span(coefficient).first(count)));
  spend_on_forming(scaled.size(), bits);
  return scaled;
}

/// Integers as balls of limited precision.
struct BallNumbers {
  using Number = BallNumber;
  std::size_t bits = BallNumber::first_bits;
  [[nodiscard]] BallNumber of(std::int64_t x) const { return BallNumber::of(x, bits); }
};
template <Motion M>
using BallView = ExactView<M, BallNumbers>;

/// Appends the numbers by which a function's own formula differs from the formula of its type: the factors of
/// its multiples. Exact functions are cached by the type's formula and these numbers. Throws
/// std::logic_error if the formulas differ in anything else, because the type branches on its numbers.
void add_own_numbers(const BeadFunction& function, std::vector<double>& numbers) {
  if (&function.formula == &function.known.formula()) return;
  const auto own = function.formula.steps(), common = function.known.formula().steps();
  const auto is_same = [](const FormulaStep& a, const FormulaStep& b) {
    return a.kind == b.kind && a.a == b.a && a.b == b.b &&
           (a.kind == FormulaStep::Kind::multiple || a.number == b.number);
  };
  if (!std::ranges::equal(own, common, is_same))
    throw std::logic_error("formulas of one certificate type differ in more than their multiples");
  for (const FormulaStep& step : own)
    if (step.kind == FormulaStep::Kind::multiple) numbers.push_back(static_cast<double>(step.number));
}

/// The coefficients of a wide function's formula, computed from copies of its beads' curves.
template <class C>
class WideFunction final : public CoefficientSource {
 public:
  WideFunction(const BeadFunction& function, const C& curves, const CoefficientBits& size,
               const WholeScale& scale)
      : formula_(function.formula),
        curves_(curves, function.beads),
        beads_(function.beads.size()),
        size_(size),
        scale_(scale) {
    std::iota(beads_.begin(), beads_.end(), BeadId{0});
  }

  /// Returns the numbers of the beads' curves.
  [[nodiscard]] std::vector<double> numbers() const { return curves_.numbers(); }

  [[nodiscard]] std::vector<BallNumber> balls(std::size_t bits) const override {
    const C curves = curves_.curves();
    const BallView<C> view(curves, scale_, {bits});
    return taken<BallNumber>(play(formula_, ViewedBeads<BallView<C>>(view, beads_)), static_cast<int>(bits));
  }
  [[nodiscard]] std::vector<Residue> residues(std::uint64_t fold) const override {
    const C curves = curves_.curves();
    const ResidueView<C> view(curves, scale_, {fold});
    return taken<Residue>(play(formula_, ViewedBeads<ResidueView<C>>(view, beads_)), Residue::bits);
  }
  [[nodiscard]] std::vector<Integer> whole() const override {
    return whole_coefficients(formula_, beads_, curves_.curves(), size_, scale_);
  }

 private:
  RecordedFormula formula_;
  CopiedCurves<C> curves_;
  std::vector<BeadId> beads_;  // numbered from 0
  CoefficientBits size_;
  WholeScale scale_;
};

/// Returns all numbers that a function depends on. The first number encodes the kind of its curves.
template <class C>
std::vector<double> numbers_of(const BeadFunction& function, const C& curves) {
  std::vector<double> numbers;
  numbers.reserve(64);
  numbers.push_back(lifted<C> ? -degree_of(curves) : degree_of(curves));
  each_control(curves, function.beads, function.known.channels(),
               [&](double value, int) { numbers.push_back(value); });
  add_own_numbers(function, numbers);
  return numbers;
}

/// Returns the coefficients, newly formed or from the cache.
template <class C>
std::vector<Integer> ordinary_coefficients(const BeadFunction& function, const C& curves,
                                           const CoefficientBits& size, const WholeScale& scale) {
  RecentCoefficients& recent = ExactWork::current().recent_functions().ordinary();
  const std::vector<double> numbers = numbers_of(function, curves);
  const RecentCoefficients::Key key{&function.known, numbers};
  if (const std::vector<Integer>* known = recent.of(key)) {
    std::vector<Integer> coefficients = *known;
    ExactWork::spend(coefficients.size());
    return coefficients;
  }
  std::vector<Integer> formed = whole_coefficients(function.formula, function.beads, curves, size, scale);
  recent.keep(key, formed);
  return formed;
}

}  // namespace

template <class C>
ExactPolynomial exact_function(const BeadFunction& function, const C& curves) {
  const CoefficientBits& size = function.known.coefficient_bits(degree_of(curves));
  const WholeScale scale = whole_scale(curves, function.beads, function.known.channels());
  if (scale.bits < wide_length_bits) {
    std::vector<Integer> scaled = ordinary_coefficients(function, curves, size, scale);
    if (function.negative) detail::negate<Integer>(scaled);
    return ExactPolynomial(std::move(scaled));
  }
  auto source = std::make_unique<WideFunction<C>>(function, curves, size, scale);
  std::vector<double> numbers = source->numbers();
  add_own_numbers(function, numbers);
  return ExactPolynomial(ExactWork::current().recent_functions().of(&function.known, numbers,
                                                                    std::move(source), function.negative));
}

template <class C>
int exact_sign_at(const BeadFunction& function, const C& curves, const Dyadic& time) {
  const MomentView<C> view(curves, function.beads, time, function.known.channels());
  const int sign = sgn(play(function.formula, ViewedBeads<MomentView<C>>(view, function.beads))[0]);
  return function.negative ? -sign : sign;
}

#define KDS_COMPILE(C)                                                                    \
  template ExactPolynomial exact_function(const BeadFunction& function, const C& curves); \
  template int exact_sign_at(const BeadFunction& function, const C& curves, const Dyadic& time);
KDS_FOR_EACH_PLAYED_MOTION(KDS_COMPILE)
#undef KDS_COMPILE

}  // namespace kds
