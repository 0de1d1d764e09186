#include "certificates/filters/lanes_descent.h"

#include "certificates/filters/bounded_polynomial.h"

namespace kds {

namespace {

/// Evaluates odd and even powers separately, which halves the chain of dependent operations of Horner's
/// scheme.
template <class Row>
[[gnu::always_inline]] inline Lanes value_of_powers(const Row& c, const Lanes& t, const Lanes& square) {
  if (c.size() == 1) return c[0];
  Lanes later = c[c.size() - 1], next = c[c.size() - 2];
  for (std::size_t k = c.size() - 2; k-- > 0;) {
    const Lanes sum = later * square + c[k];
    later = next;
    next = sum;
  }
  return next + t * later;
}

/// Returns the derivative's coefficients divided by `divisor`; zero for a constant.
template <std::size_t N>
[[gnu::always_inline]] inline std::array<Lanes, (N > 1 ? N - 1 : 1)> derivative(const std::array<Lanes, N>& c,
                                                                                double divisor) {
  std::array<Lanes, (N > 1 ? N - 1 : 1)> result;
  if constexpr (N == 1) result[0] = Lanes(0.0);
  for (std::size_t k = 1; k < N; ++k) result[k - 1] = Lanes(static_cast<double>(k) / divisor) * c[k];
  return result;
}
[[nodiscard]] inline Coefficients<Lanes> derivative(const Coefficients<Lanes>& c, double divisor) {
  Coefficients<Lanes> result;
  result.resize(std::max<std::size_t>(c.size(), 2) - 1);
  result[0] = Lanes(0.0);
  for (std::size_t k = 1; k < c.size(); ++k) result[k - 1] = Lanes(static_cast<double>(k) / divisor) * c[k];
  return result;
}

/// Returns a point near the descent of the polynomial with these coefficients on [0,1]. `slope` is set to the
/// derivative there.
template <class Row>
[[gnu::always_inline]] inline Lanes halley(const Row& c, Lanes::Mask moving, Lanes& slope) {
  const std::size_t count = c.size();
  const int degree = static_cast<int>(count) - 1;
  // Find where the control polygon descends through zero.
  Lanes index(0.0), left(0.0), right(-1.0);
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const Lanes::Mask crosses = (c[k] > Lanes(0.0)) & (c[k + 1] <= Lanes(0.0));
    index = Lanes::choose(crosses, Lanes(static_cast<double>(k)), index);
    left = Lanes::choose(crosses, c[k], left);
    right = Lanes::choose(crosses, c[k + 1], right);
  }
  Lanes t = (index + left / (left - right)) * Lanes(1.0 / degree);
  Row power = c;  // coefficients of t^k, by forward differences
  for (std::size_t r = 1; r < count; ++r) {
    for (std::size_t i = count - 1; i >= r; --i) power[i] = power[i] - power[i - 1];
  }
  for (std::size_t k = 1; k + 1 < count; ++k)
    power[k] = Lanes(static_cast<double>(binomial(degree, static_cast<int>(k)))) * power[k];
  const auto first = derivative(power, 1);
  const auto second = derivative(first, 2);  // half the second derivative; zero for a line

  Lanes low(0.0), high(1.0);
  for (int iteration = 0; iteration < 40 && Lanes::any(moving); ++iteration) {
    const Lanes square = t * t;
    const Lanes value = value_of_powers(power, t, square);
    slope = value_of_powers(first, t, square);
    Lanes change = value / slope;
    if (count > 2) {
      const Lanes bend = value_of_powers(second, t, square);
      change = value * slope / (slope * slope - value * bend);
    }
    const Lanes::Mask before = value > Lanes(0.0);
    low = Lanes::choose(before, t, low);
    high = Lanes::choose(before, high, t);
    Lanes next = t - change;
    next = Lanes::choose((next >= low) & (next <= high), next, Lanes(0.5) * (low + high));
    const Lanes::Mask far = Lanes::abs(next - t) > Lanes(0x1p-16);  // if smaller, the next step is negligible
    t = Lanes::choose(moving, next, t);  // a converged lane stays, or bisection would move it
    moving &= far;
  }
  return t;
}

/// Returns where the control polygon first falls below zero in [0,1], or 1 if it does not.
template <class Row>
[[gnu::always_inline]] inline Lanes first_descent_of_polygon(const Row& c) {
  const std::size_t last = c.size() - 1;
  Lanes index(static_cast<double>(last)), left(0.0), right(-1.0);
  for (std::size_t k = last; k-- > 0;) {
    const Lanes::Mask falls = (c[k] > Lanes(0.0)) & (c[k + 1] <= Lanes(0.0));
    index = Lanes::choose(falls, Lanes(static_cast<double>(k)), index);
    left = Lanes::choose(falls, c[k], left);
    right = Lanes::choose(falls, c[k + 1], right);
  }
  return (index + left / (left - right)) * Lanes(1.0 / static_cast<double>(last));
}

/// Walks along each polynomial. The step doubles if all coefficients on it are positive and halves if they
/// are inconclusive, until a step contains a single root.
template <int Degree>
[[KDS_LANES_TARGETS]] void isolate(LanesDescent<Degree>& descent, double from, const Lanes::Mask& wanted,
                                   const Lanes::Mask& known, LanesSearch& result) {
  constexpr int most_steps = 100;
  Lanes::Mask searching = wanted;
  Lanes lower(from);
  const LanesCoefficients<Degree> given = descent.part;
  const Lanes rest(1 - from);
  LanesCoefficients<Degree> known_given = given;
  known_given[0] = known_positive(given[0], known, descent.local_error);
  Lanes step = Lanes(1.5) * rest * first_descent_of_polygon(known_given);
  for (int count = 0; count < most_steps && Lanes::any(searching); ++count) {
    const Lanes upper = Lanes::min(lower + step, Lanes(1.0));
    LanesCoefficients<Degree> part;
    if (Lanes::any(searching & (lower > Lanes(from)))) {
      part = descent.bernstein;
      casteljau_left(part, upper);
      casteljau(part, lower / upper);
    } else {  // also two subdivisions, one of them already done by the caller
      part = given;
      casteljau_left(part, (upper - lower) / rest);
    }
    part[0] = known_positive(part[0], known & (lower <= Lanes(from)), descent.local_error);
    const LanesShape shape = shape_of(part, descent.local_error);
    const Lanes::Mask found = searching & shape.one_descent;
    const Lanes::Mask never = searching & shape.positive & (upper >= Lanes(1.0));
    for (std::size_t k = 0; k < part.size(); ++k)
      descent.part[k] = Lanes::choose(found, part[k], descent.part[k]);
    descent.lower = Lanes::choose(found, lower, descent.lower);
    descent.upper = Lanes::choose(found, upper, descent.upper);
    result.found |= found;
    result.last |= found & (upper >= Lanes(1.0));
    result.never |= never;
    lower = Lanes::choose(shape.positive, upper, lower);
    step = Lanes::choose(shape.positive, step + step, step * Lanes(0.5));
    searching &= ~(found | never) & (step > Lanes(0x1p-30)) & (lower < Lanes(1.0));
  }
}

/// Runs Halley's iteration on the local polynomials, safeguarded by the bracket of signs seen so far, then
/// finds a bracket around the result whose ends are proved.
template <int Degree>
[[KDS_LANES_TARGETS]] void narrow(LanesDescent<Degree>& descent, const Lanes::Mask& wanted) {
  Lanes slope(-1.0);
  // The slope is in units of the part, so it is divided by the part's length below.
  const Lanes t = halley(descent.part, wanted, slope);
  const Lanes length = descent.upper - descent.lower;
  const Lanes root = descent.lower + length * t;
  // Go far enough to both sides that the signs are certain, also at the start of a later search. At the
  // part's own ends they are certain.
  const Lanes doubtful = Lanes(4.0) * descent.local_error * length / Lanes::abs(slope);
  Lanes reach = Lanes::max(doubtful, Lanes::max(length * Lanes(0x1p-40), root * Lanes(0x1p-50)));
  Lanes::Mask below = wanted;  // lanes whose lower end is still to be found
  Lanes::Mask above = wanted;
  for (int attempt = 0; attempt < 6 && (Lanes::any(below) || Lanes::any(above)); ++attempt) {
    const Lanes lower = root - reach;
    const Lanes upper = root + reach;
    auto at_lower = descent.bernstein, at_upper = descent.bernstein;
    const Lanes::Mask lower_proved =
        below & (lower > descent.lower) & (casteljau(at_lower, lower) > descent.value_error);
    const Lanes::Mask upper_proved =
        above & (upper < descent.upper) & (casteljau(at_upper, upper) < -descent.value_error);
    descent.lower = Lanes::choose(lower_proved, lower, descent.lower);
    descent.upper = Lanes::choose(upper_proved, upper, descent.upper);
    below &= ~lower_proved;
    above &= ~upper_proved;
    reach = reach * Lanes(16.0);
  }
}

}  // namespace

template <int Degree>
void isolate_lanes(LanesDescent<Degree>& descent, double from, const Lanes::Mask& wanted,
                   const Lanes::Mask& known, LanesSearch& result) {
  isolate(descent, from, wanted, known, result);
}

template <int Degree>
void narrow_lanes(LanesDescent<Degree>& descent, const Lanes::Mask& wanted) {
  narrow(descent, wanted);
}

double descent_of(const Coefficients<Lanes>& bernstein) {
  Lanes slope;
  return halley(bernstein, Lanes::Mask{-1, 0, 0, 0}, slope).v[0];
}

#define KDS_COMPILE(degree)                                                                          \
  template void isolate_lanes(LanesDescent<degree>&, double, const Lanes::Mask&, const Lanes::Mask&, \
                              LanesSearch&);                                                         \
  template void narrow_lanes(LanesDescent<degree>&, const Lanes::Mask&);
KDS_FOR_EACH_LANES_DEGREE(KDS_COMPILE)
#undef KDS_COMPILE

namespace {

template <class Row>
[[gnu::always_inline]] inline void set_size([[maybe_unused]] Row& row, [[maybe_unused]] std::size_t size) {
  if constexpr (requires { row.resize(size); }) row.resize(size);
}

/// Computes the plain Bernstein coefficients and their error bounds.
template <int Degree>
[[gnu::always_inline]] inline void bound_lanes(const ScaledLanes<Degree>& given, double uniform_bound,
                                               LanesDescent<Degree>& lanes) {
  Lanes largest(0.0);
  const int degree = static_cast<int>(given.scaled.size()) - 1;
  set_size(lanes.bernstein, given.scaled.size());
  for (std::size_t k = 0; k < given.scaled.size(); ++k) {
    lanes.bernstein[k] = given.scaled[k] / Lanes(static_cast<double>(binomial(degree, static_cast<int>(k))));
    largest = Lanes::max(largest, Lanes::abs(lanes.bernstein[k]));
  }
  const Lanes uniform = Lanes::choose(largest >= Lanes(0x1p-900), Lanes(uniform_bound) * given.error_scale,
                                      Lanes(__builtin_nan("")));
  lanes.value_error = uniform + Lanes(value_rounding(degree)) * largest;
  lanes.local_error = uniform + Lanes(local_rounding(degree)) * largest;
}

/// Bounds how much a function's value in the present bracket may differ from its value at the upper end.
template <int Degree>
[[gnu::always_inline]] inline Lanes change_within(const LanesDescent<Degree>& lanes, double lower,
                                                  double upper) {
  if (!(lower < upper)) return Lanes(0.0);
  // |p'| <= degree * steepest, and coefficients have an error of value_error each.
  Lanes steepest(0.0);
  const std::size_t degree = lanes.bernstein.size() - 1;
  for (std::size_t k = 0; k < degree; ++k)
    steepest = Lanes::max(steepest, Lanes::abs(lanes.bernstein[k + 1] - lanes.bernstein[k]));
  return Lanes(static_cast<double>(degree)) * (steepest + Lanes(2.0) * lanes.value_error) *
         Lanes((upper - lower) * (1 + 0x1p-40));
}

template <int Degree>
[[KDS_LANES_TARGETS]] void classify(const ScaledLanes<Degree>& functions, double uniform, const LanesNow& now,
                                    LanesOutcome<Degree>& out) {
  out.positive = functions.positive;
  bound_lanes(functions, uniform, out.descent);
  auto right = out.descent.bernstein;  // the part after now
  if (now.upper > 0) casteljau(right, Lanes(now.upper));
  // At its own root, the function has no other root in the bracket and is positive at the upper end.
  Lanes::Mask at_own_root{};
  for (unsigned lane = 0; lane < Lanes::width; ++lane)
    at_own_root[lane] = (now.at_own_root >> lane & 1U) != 0 ? -1 : 0;
  const Lanes::Mask known = now.isolating ? at_own_root : Lanes::Mask{};
  const Lanes start = right[0];
  right[0] = known_positive(start, known, out.descent.local_error);
  const Lanes change = Lanes::choose(at_own_root, Lanes(now.isolating ? 0.0 : __builtin_inf()),
                                     change_within(out.descent, now.lower, now.upper));
  const Lanes::Mask starts_positive = right[0] > out.descent.local_error + change;
  out.violated = right[0] < -(out.descent.local_error + change);
  const LanesShape shape = shape_of(right, out.descent.local_error);
  out.never = shape.positive & starts_positive & ~out.positive;
  out.found = shape.one_descent & starts_positive;
  out.unclear = starts_positive & ~(out.positive | shape.positive | shape.one_descent);
  out.known = known;
  right[0] = Lanes::choose(out.unclear, start, right[0]);  // lanes to be subdivided keep the computed value
  out.descent.part = right;
  out.descent.lower = Lanes(now.upper);
  out.descent.upper = Lanes(1.0);
}

}  // namespace

template <int Degree>
void classify_lanes(const ScaledLanes<Degree>& functions, double uniform, const LanesNow& now,
                    LanesOutcome<Degree>& out) {
  classify(functions, uniform, now, out);
}

#define KDS_COMPILE(degree) \
  template void classify_lanes(const ScaledLanes<degree>&, double, const LanesNow&, LanesOutcome<degree>&);
KDS_FOR_EACH_LANES_DEGREE(KDS_COMPILE)
#undef KDS_COMPILE

}  // namespace kds
