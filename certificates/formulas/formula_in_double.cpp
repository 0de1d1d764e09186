#include "certificates/formulas/formula_in_double.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "certificates/filters/tracked_moment.h"
#include "certificates/formulas/formula_player.h"
#include "motions/curves/lifted_motion.h"

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
  if (room.size() < formula.places()) room.resize(formula.places());
  TrackedDouble* const values = room.data();
  for (const FormulaStep& step : formula.steps()) {
    TrackedDouble& value = values[step.place];
    switch (step.kind) {
      case Kind::centre_difference: {
        const FormulaStep* coordinate = &step;
        for (const auto& difference : view.difference(step.a, step.b))
          values[(coordinate++)->place] = difference.scaled[0];
        break;
      }
      case Kind::next_coordinate:
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

}  // namespace kds
