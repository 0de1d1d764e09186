#include "certificates/filters/bounded_polynomial.h"

#include <algorithm>
#include <cmath>

#include "certificates/filters/lanes_descent.h"

namespace kds {

namespace {

LanesCoefficients<any_degree> in_lanes(const Coefficients<double>& bernstein) {
  LanesCoefficients<any_degree> lanes;
  lanes.resize(bernstein.size());
  for (std::size_t k = 0; k < bernstein.size(); ++k) lanes[k] = Lanes(bernstein[k]);
  return lanes;
}

constexpr Lanes::Mask first_lane{-1, 0, 0, 0};

}  // namespace

double BoundedPolynomial::value_at(double u) const {
  Coefficients<double> c = bernstein;
  const double v = 1 - u;
  for (std::size_t round = c.size() - 1; round > 0; --round) {
    for (std::size_t i = 0; i < round; ++i) c[i] = v * c[i] + u * c[i + 1];
  }
  return c[0];
}

int BoundedPolynomial::certain_sign_at(double u) const {
  const double value = value_at(u);
  return value > value_error ? 1 : value < -value_error ? -1 : 0;
}

int BoundedPolynomial::certain_sign_on(double lower, double upper) const {
  const double value = value_at(upper);
  double reach = value_error;
  if (lower < upper) {
    double steepest = 0;
    for (std::size_t i = 0; i + 1 < bernstein.size(); ++i)
      steepest = std::max(steepest, std::abs(bernstein[i + 1] - bernstein[i]));
    // |p'| <= degree * steepest, and coefficients have an error of value_error each.
    reach += degree() * (steepest + 2 * value_error) * (upper - lower) * (1 + 0x1p-40);
  }
  return value > reach ? 1 : value < -reach ? -1 : 0;
}

auto BoundedPolynomial::first_descent(double from, bool known) const -> Result {
  if (degree() == 0) return {known || bernstein[0] > local_error ? Verdict::never : Verdict::undecided, {}};
  LanesDescent<any_degree> descent;
  descent.bernstein = in_lanes(bernstein);
  descent.value_error = Lanes(value_error);
  descent.local_error = Lanes(local_error);
  descent.lower = Lanes(from);
  descent.upper = Lanes(1.0);
  descent.part = descent.bernstein;
  if (from > 0) casteljau(descent.part, Lanes(from));
  LanesSearch search;
  isolate_lanes(descent, from, first_lane, known ? first_lane : Lanes::Mask{}, search);
  if (search.never[0] != 0) return {Verdict::never, {}};
  if (search.found[0] == 0) return {Verdict::undecided, {}};
  narrow_lanes(descent, first_lane);
  return {Verdict::found, {descent.lower.v[0], descent.upper.v[0]}};
}

double BoundedPolynomial::root_between(double lower, double upper) const {
  LanesCoefficients<any_degree> part = in_lanes(bernstein);
  casteljau_left(part, Lanes(upper));
  casteljau(part, Lanes(lower / upper));
  return lower + (upper - lower) * descent_of(part);
}

BoundedPolynomial operator-(BoundedPolynomial p) {
  for (double& c : p.bernstein) c = -c;
  return p;
}

}  // namespace kds
