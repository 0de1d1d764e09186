#include "certificates/filters/classify_lanes.h"

#include "certificates/filters/error_bound.h"

namespace kds {
namespace {

template <class Row>
[[gnu::always_inline]] inline void set_size([[maybe_unused]] Row& row, [[maybe_unused]] std::size_t size) {
  if constexpr (requires { row.resize(size); }) row.resize(size);
}

/// Computes the plain Bernstein coefficients and their error bounds.
template <int Degree>
[[gnu::always_inline]] inline void bound_lanes(const ScaledLanes<Degree>& given, double uniform_bound,
                                               double charge, LanesDescent<Degree>& lanes) {
  Lanes largest(0.0);
  const int degree = static_cast<int>(given.scaled.size()) - 1;
  set_size(lanes.bernstein, given.scaled.size());
  for (std::size_t k = 0; k < given.scaled.size(); ++k) {
    lanes.bernstein[k] = given.scaled[k] / Lanes(static_cast<double>(binomial(degree, static_cast<int>(k))));
    largest = Lanes::max(largest, Lanes::abs(lanes.bernstein[k]));
  }
  const Lanes uniform = Lanes::choose(largest >= Lanes(0x1p-900), Lanes(uniform_bound) * given.error_scale,
                                      Lanes(__builtin_nan("")));
  // Adds a tiny value, so that a function known to be positive also appears positive.
  const Lanes least(charge == 0 ? 0x1p-1000 : 0.0);
  lanes.value_error = uniform + Lanes(charge * value_rounding(degree)) * largest + least;
  lanes.local_error = uniform + Lanes(charge * local_rounding(degree)) * largest + least;
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
[[KDS_LANES_TARGETS]] void classify(const ScaledLanes<Degree>& functions, double uniform, double charge,
                                    const LanesNow& now, LanesOutcome<Degree>& out) {
  out.positive = functions.positive;
  bound_lanes(functions, uniform, charge, out.descent);
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
void classify_lanes(const ScaledLanes<Degree>& functions, double uniform, Rounding rounding,
                    const LanesNow& now, LanesOutcome<Degree>& out) {
  classify(functions, uniform, charge_of(rounding), now, out);
}

#define KDS_COMPILE(degree)                                                                   \
  template void classify_lanes(const ScaledLanes<degree>&, double, Rounding, const LanesNow&, \
                               LanesOutcome<degree>&);
KDS_FOR_EACH_LANES_DEGREE(KDS_COMPILE)
#undef KDS_COMPILE

}  // namespace kds
