#pragma once
// Definitions of FunctionValues. The floating-point filter derives its constants from the formula itself,
// over magnitudes (error_bound.h); the exact stage knows by the same means how many primes it takes.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>

#include "certificates/exact/exact_function.h"
#include "certificates/filters/tracked_moment.h"
#include "certificates/search/function_values.h"
#include "motions/curves/lifted_motion.h"
#include "motions/views/integer_view.h"

namespace kds {

namespace detail {

template <class F, class C>
[[nodiscard]] ErrorBound derive_error_bound(int degree) {
  const auto magnitudes = function_of(F{}, MagnitudeViewOf<C>(degree));
  const auto of_function = static_cast<int>(magnitudes.scaled.size()) - 1;
  constexpr double inflation = 1 + 0x1p-30;
  constexpr double u = Magnitude::unit_roundoff;

  ErrorBound bound;
  bound.coefficient.resize(magnitudes.scaled.size());
  for (std::size_t k = 0; k < magnitudes.scaled.size(); ++k) {
    const Magnitude& m = magnitudes.scaled[k];
    const auto choose = static_cast<double>(binomial(of_function, static_cast<int>(k)));
    bound.power = m.power;
    bound.coefficient[k] = m.error * inflation;
    bound.uniform = std::max(bound.uniform, (m.error + u * (m.bound + m.error)) / choose * inflation);
  }
  return bound;
}

/// What is derived of a degree once, whoever asks first.
template <class T>
class OncePerDegree {
 public:
  template <class Derive>
  [[nodiscard]] const T& of(int degree, Derive derive) {
    const std::lock_guard lock(mutex_);
    std::unique_ptr<T>& known = known_[degree];
    if (!known) known = std::make_unique<T>(derive(degree));
    return *known;
  }

 private:
  std::mutex mutex_;
  std::map<int, std::unique_ptr<T>> known_;
};

/// Errors that hold for values and after subdivision, from one for all plain coefficients.
inline void set_errors(BoundedPolynomial& p, double uniform_error) {
  double largest = 0;
  for (const double c : p.bernstein) largest = std::max(largest, std::abs(c));
  // Roundings are relative down to here only.
  if (largest < 0x1p-900) uniform_error = std::nan("");
  p.value_error = uniform_error + value_rounding(p.degree()) * largest;
  p.local_error = uniform_error + local_rounding(p.degree()) * largest;
}

}  // namespace detail

template <class F, class C>
const ErrorBound& FunctionValues<F, C>::error_bound(int degree) {
  static detail::OncePerDegree<ErrorBound> bounds;
  return bounds.of(degree, detail::derive_error_bound<F, C>);
}

template <class F, class C>
[[gnu::noinline]] BoundedFunction FunctionValues<F, C>::bounded(const F& function, const C& curves) {
  const DoubleView<C> view(curves);
  const auto value = function_of(function, view);
  const auto degree = static_cast<int>(value.scaled.size()) - 1;
  const ErrorBound& bound = error_bound(degree_of(curves));
  const double scale = bound.scale(view.largest_length());
  BoundedFunction result{{}, true};
  result.polynomial.bernstein.resize(value.scaled.size());
  for (std::size_t k = 0; k < value.scaled.size(); ++k) {
    result.positive &= value.scaled[k] > bound.coefficient[k] * scale;
    result.polynomial.bernstein[k] =
        value.scaled[k] / static_cast<double>(binomial(degree, static_cast<int>(k)));
  }
  detail::set_errors(result.polynomial, bound.uniform * scale);
  return result;
}

template <class F, class C>
[[gnu::noinline]] BoundedFunction FunctionValues<F, C>::tracked(const F& function, const C& curves) {
  const auto value = function_of(function, TrackedView<C, channels_of<F>>(curves, function.beads));
  const auto degree = static_cast<int>(value.scaled.size()) - 1;
  BoundedFunction result{{}, true};
  result.polynomial.bernstein.resize(value.scaled.size());
  double uniform = 0;
  for (std::size_t k = 0; k < value.scaled.size(); ++k) {
    const auto choose = static_cast<double>(binomial(degree, static_cast<int>(k)));
    const TrackedDouble& c = value.scaled[k];
    // One more rounding for the division; a NaN is kept, and proves nothing.
    const double error =
        (c.error + TrackedDouble::unit_roundoff * std::abs(c.value)) * TrackedDouble::inflation +
        TrackedDouble::lost_to_underflow;
    result.positive &= c.value > error;
    result.polynomial.bernstein[k] = c.value / choose;
    uniform = error <= uniform || std::isnan(uniform) ? uniform : error;
  }
  detail::set_errors(result.polynomial, uniform);
  return result;
}

template <class F, class C>
[[gnu::noinline]] int FunctionValues<F, C>::sign_during(const F& function, const C& curves, double lower,
                                                        double upper) {
  if constexpr (lifted<C> && channels_of<F>.weights) {
    return 0;  // weights are no Bezier curves there
  } else {
    auto places = function.beads;
    for (std::size_t p = 0; p < places.size(); ++p) places[p] = static_cast<BeadId>(p);
    F at_places = function;
    at_places.beads = places;
    const TrackedMoment<C, std::tuple_size_v<decltype(places)>, channels_of<F>> view(curves, function.beads,
                                                                                     lower, upper);
    return certain_sign(function_of(at_places, view).scaled[0]);
  }
}

template <class F, class C>
[[gnu::noinline]] ExactPolynomial FunctionValues<F, C>::exact(const F& function, const C& curves) {
  static detail::OncePerDegree<CoefficientBits> sizes;
  const CoefficientBits& size = sizes.of(degree_of(curves), [](int degree) {
    return coefficient_bits(function_of(F{}, MagnitudeViewOf<C>(degree)));
  });
  return exact_function_of(function, curves, size);
}

template <class F, class C>
[[gnu::noinline]] int FunctionValues<F, C>::sign_at_rest(const F& function, const C& curves) {
  const int sign = sign_during(function, curves, 0, 0);
  return sign != 0 ? sign : sign_at(function, curves, Dyadic(0.0));
}

template <class F, class C>
[[gnu::noinline]] int FunctionValues<F, C>::sign_at(const F& function, const C& curves, const Dyadic& time) {
  return function_of(function, MomentView<C, channels_of<F>>(curves, function.beads, time)).scaled[0].sign();
}

}  // namespace kds
