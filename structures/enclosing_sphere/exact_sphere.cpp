#include "structures/enclosing_sphere/exact_sphere.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "certificates/base/determinant.h"

namespace kds {

namespace {

int sign_of(const Integer& x) { return sgn(x); }
/// Returns 1 if x is proved to be positive, otherwise -1: never 0.
int sign_of(const TrackedDouble& x) { return x.value > x.error * TrackedDouble::inflation ? 1 : -1; }

// Returns the sign of a + b sqrt(d), d >= 0.
template <class Number>
int radical_sign(const Number& a, const Number& b, const Number& d) {
  const int sa = sign_of(a);
  const int sb = sign_of(d) == 0 ? 0 : sign_of(b);
  if (sa == sb || sb == 0) return sa;
  if (sa == 0) return sb;
  const Number more = a * a - b * b * d;
  if (sign_of(more) > 0) return sa;
  if (sign_of(-more) > 0) return sb;
  return sign_of(Number{0});
}

// Returns n / d * 2^unit, truncated to 64 bits before it is rounded.
double rounded_quotient(Integer n, const Integer& d, int unit) {
  if (sgn(n) == 0) return 0;
  const bool negative = sgn(n) < 0;
  if (negative) n = -n;
  const int shift = 64 - (static_cast<int>(bit_length(n)) - static_cast<int>(bit_length(d)));
  const Integer q = shift >= 0 ? Integer((n << static_cast<unsigned>(shift)) / d)
                               : Integer(n / (d << static_cast<unsigned>(-shift)));
  const double size = std::ldexp(q.get_d(), unit - shift);
  return negative ? -size : size;
}

template <class Number, std::size_t N>
Number dot(const std::array<Number, N>& a, const std::array<Number, N>& b) {
  Number sum = a[0] * b[0];
  for (std::size_t i = 1; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

template <int Dimension>
class ExactSearch {
 public:
  using Whole = IntegerBall<Dimension>;

  ExactSearch(const Balls<Dimension>& balls, BeadId first, BeadId last, bool of_points, ExactUse use)
      : balls_(balls),
        first_(first),
        last_(last),
        of_points_(of_points),
        use_(use),
        unit_(whole_unit(balls, first, last)) {}

  Cage<Dimension> settle(Basis& basis) {
    while (true) {
      const ExactSphere<Dimension> sphere = sphere_of_basis(basis);
      look_from(sphere);
      const BeadId escaped = escaped_from(sphere, basis);
      if (escaped == no_bead) return cage_;
      std::vector<BeadId> among(basis.begin(), basis.end());
      among.push_back(escaped);
      basis = basis_among(among);
    }
  }

 private:
  Whole whole(BeadId bead) const {
    Whole ball = whole_ball(balls_, bead, unit_);
    if (of_points_) ball.radius = 0;
    return ball;
  }
  std::vector<Whole> wholes(std::span<const BeadId> beads) const {
    std::vector<Whole> some;
    for (const BeadId b : beads) some.push_back(whole(b));
    return some;
  }
  Basis basis_among(std::span<const BeadId> beads) const {
    Basis basis;
    for (const std::size_t index : exact_basis_among<Dimension>(wholes(beads)))
      basis.beads[basis.size++] = beads[index];
    basis.sort();
    return basis;
  }
  // Reduces a basis with superfluous beads to a proper one.
  ExactSphere<Dimension> sphere_of_basis(Basis& basis) const {
    const std::span<const BeadId> beads(basis.begin(), basis.size);
    auto sphere = ExactSphere<Dimension>::touching(wholes(beads));
    if (sphere && sphere->is_proper()) return *sphere;
    basis = basis_among(beads);
    return *ExactSphere<Dimension>::touching(wholes({basis.begin(), basis.size}));
  }
  // Sets the sphere in double, and the distances up to which beads are certainly inside and beyond which they
  // are certainly outside.
  void look_from(const ExactSphere<Dimension>& sphere) {
    const Sphere rounded = sphere.rounded(unit_);
    double size = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      cage_.center[axis] = rounded.center[static_cast<Eigen::Index>(axis)];
      size = std::max(size, std::abs(cage_.center[axis]));
    }
    cage_.radius = rounded.radius;
    const double error = 8 * detail::unit_roundoff * (size + rounded.radius);
    inner_ = rounded.radius - error;
    outer_ = rounded.radius + error;
    filtered_ = use_ == ExactUse::where_needed && rounded.radius >= 0x1p-150 && outer_ <= 0x1p150;
  }
  // Returns |p - center| + r, with each term rounded to within 8u.
  double reach(BeadId bead) const {
    double square = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const double d = balls_.coordinate(bead, axis) - cage_.center[axis];
      square += d * d;
    }
    return std::sqrt(square) + (of_points_ ? 0 : balls_.radius(bead));
  }
  // Returns the bead that sticks out most, if doubles can decide this. Otherwise returns the first bead that
  // sticks out at all.
  BeadId escaped_from(const ExactSphere<Dimension>& sphere, const Basis& basis) const {
    constexpr double inflation = 1 + 16 * detail::unit_roundoff;
    BeadId farthest = no_bead;
    double most = outer_ * inflation;
    if (filtered_) {
      for (BeadId b = first_; b <= last_; ++b) {
        const double r = reach(b);
        if (r > most) {
          most = r;
          farthest = b;
        }
      }
      if (farthest != no_bead) return farthest;
    }
    for (BeadId b = first_; b <= last_; ++b) {
      if (basis.contains(b) || (filtered_ && reach(b) * inflation < inner_)) continue;
      if (!sphere.holds(whole(b))) return b;
    }
    return no_bead;
  }

  const Balls<Dimension>& balls_;
  BeadId first_, last_;
  bool of_points_;
  ExactUse use_;
  int unit_;
  Cage<Dimension> cage_;
  double inner_ = 0, outer_ = 0;
  bool filtered_ = false;
};

}  // namespace

template <int Dimension>
int whole_unit(const Balls<Dimension>& balls, BeadId first, BeadId last) {
  int unit = std::numeric_limits<int>::max();
  const auto look = [&unit](double x) {
    if (x != 0) unit = std::min(unit, split(x).exponent);
  };
  for (BeadId b = first; b <= last; ++b) {
    for (std::size_t axis = 0; axis < Dimension; ++axis) look(balls.coordinate(b, axis));
    look(balls.radius(b));
  }
  return unit == std::numeric_limits<int>::max() ? 0 : unit;
}

template <int Dimension>
IntegerBall<Dimension> whole_ball(const Balls<Dimension>& balls, BeadId bead, int unit) {
  const auto whole = [unit](double x) -> Integer {
    const SplitDouble parts = split(x);
    if (parts.mantissa == 0) return 0;
    return Integer(parts.mantissa) << static_cast<unsigned>(parts.exponent - unit);
  };
  IntegerBall<Dimension> ball;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    ball.center[axis] = whole(balls.coordinate(bead, axis));
  ball.radius = whole(balls.radius(bead));
  return ball;
}

template <int Dimension, class Number>
std::optional<TouchingSphere<Dimension, Number>> TouchingSphere<Dimension, Number>::touching(
    std::span<const Ball> basis) {
  TouchingSphere sphere;
  sphere.base_ = basis[0];
  sphere.m_ = basis.size() - 1;
  const std::size_t m = sphere.m_;
  if (m == 0) return sphere;
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      sphere.d_[i][axis] = basis[i + 1].center[axis] - basis[0].center[axis];
  }
  const GramMatrix<Number> gram(sphere.d_, m);
  std::array<Number, 3> s, e;
  for (std::size_t i = 0; i < m; ++i) {
    s[i] = basis[i + 1].radius - basis[0].radius;
    e[i] = gram(i, i) - s[i] * s[i];
    if (sign_of(e[i]) <= 0) return std::nullopt;  // one ball holds the other
  }
  sphere.g_ = gram.determinant();
  if (sign_of(sphere.g_) <= 0) return std::nullopt;
  sphere.ae_ = gram.times_adjugate(e);
  sphere.as_ = gram.times_adjugate(s);
  sphere.a_ = gram.dot(s, sphere.as_) - sphere.g_;
  sphere.b_ = gram.dot(e, sphere.as_);
  sphere.c_ = gram.dot(e, sphere.ae_);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      sphere.qae_[axis] += sphere.d_[i][axis] * sphere.ae_[i];
      sphere.qas_[axis] += sphere.d_[i][axis] * sphere.as_[i];
    }
  }
  sphere.discriminant_ = sphere.b_ * sphere.b_ - sphere.a_ * sphere.c_;
  if (sign_of(sphere.discriminant_) < 0) return std::nullopt;
  if (radical_sign<Number>(-sphere.b_, Number{1}, sphere.discriminant_) <= 0) return std::nullopt;
  for (std::size_t i = 0; i < m; ++i) {  // no ball of the basis is larger than the sphere
    const Number twice = s[i] + s[i];
    if (radical_sign<Number>(sphere.c_ + twice * sphere.b_, -twice, sphere.discriminant_) < 0)
      return std::nullopt;
  }
  return sphere;
}

template <int Dimension, class Number>
bool TouchingSphere<Dimension, Number>::is_proper() const {
  if (m_ == 0) return true;
  // Weight i is (A e)_i (sqrt(D) - b) + (A s)_i c, divided by a positive number. The base has the remaining
  // weight.
  Number rest_e = g_ + g_, rest_s{0};
  const auto positive = [this](const Number& e, const Number& s) {
    return radical_sign<Number>(s * c_ - e * b_, e, discriminant_) > 0;
  };
  for (std::size_t i = 0; i < m_; ++i) {
    if (!positive(ae_[i], as_[i])) return false;
    rest_e -= ae_[i];
    rest_s -= as_[i];
  }
  return positive(rest_e, rest_s);
}

template <int Dimension, class Number>
bool TouchingSphere<Dimension, Number>::holds(const Ball& ball) const {
  std::array<Number, Dimension> d;
  for (std::size_t axis = 0; axis < Dimension; ++axis) d[axis] = ball.center[axis] - base_.center[axis];
  const Number s = ball.radius - base_.radius;
  const Number e = dot(d, d) - s * s;
  if (m_ == 0) return sign_of(-s) >= 0 && sign_of(-e) >= 0;
  const Number twice = s + s;
  if (sign_of(-s) < 0 && radical_sign<Number>(c_ + twice * b_, -twice, discriminant_) < 0) return false;
  const Number f = dot(d, qae_) - g_ * e;
  const Number w = dot(d, qas_) - g_ * s;
  // The condition is F + W rho >= 0 (ball_in_sphere.h). Here e is twice as large, so
  // rho = c / (2 (sqrt(D) - b)).
  return radical_sign<Number>(w * c_ - f * b_, f, discriminant_) >= 0;
}

template <int Dimension, class Number>
Sphere TouchingSphere<Dimension, Number>::rounded(int unit) const requires(std::same_as<Number, Integer>) {
  Sphere sphere;
  if (m_ == 0) {
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      sphere.center[static_cast<Eigen::Index>(axis)] = rounded_quotient(base_.center[axis], 1, unit);
    sphere.radius = rounded_quotient(base_.radius, 1, unit);
    return sphere;
  }
  // Computes rho = p / q from sqrt(D) = root / 2^bits without cancellation. The formula is c / (2 (sqrt(D) -
  // b)). If b > 0 (and so a < 0), it is rewritten by D - b^2 = -a c as (sqrt(D) + b) / (-2 a).
  constexpr unsigned bits = 256;
  const Integer root = sqrt(Integer(discriminant_ << (2 * bits)));
  const bool conjugate = sgn(b_) > 0;
  const Integer shifted_b = b_ << bits;
  const Integer p = conjugate ? Integer(root + shifted_b) : Integer(c_ << bits);
  const Integer q = conjugate ? Integer((-2 * a_) << bits) : Integer(2 * (root - shifted_b));
  // Centre: base + Q A (e / 2 + s rho) / g.
  const Integer whole = 2 * g_ * q;
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    const Integer offset = qae_[axis] * q + 2 * qas_[axis] * p;
    sphere.center[static_cast<Eigen::Index>(axis)] =
        rounded_quotient(base_.center[axis] * whole + offset, whole, unit);
  }
  sphere.radius = rounded_quotient(base_.radius * q + p, q, unit);
  return sphere;
}

template <int Dimension>
std::vector<std::size_t> exact_basis_among(std::span<const IntegerBall<Dimension>> balls) {
  const unsigned subsets = 1U << balls.size();
  std::vector<std::size_t> indices;
  std::vector<IntegerBall<Dimension>> basis;
  for (int size = 1; size <= Dimension + 1; ++size) {
    for (unsigned subset = 1; subset < subsets; ++subset) {
      if (std::popcount(subset) != size) continue;
      indices.clear();
      basis.clear();
      for (std::size_t i = 0; i < balls.size(); ++i) {
        if ((subset >> i & 1U) == 0) continue;
        indices.push_back(i);
        basis.push_back(balls[i]);
      }
      const auto sphere = ExactSphere<Dimension>::touching(basis);
      if (!sphere || !sphere->is_proper()) continue;
      bool encloses = true;
      for (std::size_t i = 0; encloses && i < balls.size(); ++i)
        encloses = (subset >> i & 1U) != 0 || sphere->holds(balls[i]);
      if (encloses) return indices;
    }
  }
  throw std::logic_error("balls without a minimum enclosing sphere");
}

template <int Dimension>
Sphere exact_sphere_of(const Basis& basis, const Balls<Dimension>& balls) {
  int unit = std::numeric_limits<int>::max();
  for (const BeadId b : basis) unit = std::min(unit, whole_unit(balls, b, b));
  std::vector<IntegerBall<Dimension>> members;
  for (const BeadId b : basis) members.push_back(whole_ball(balls, b, unit));
  auto sphere = ExactSphere<Dimension>::touching(members);
  if (!sphere) {
    std::vector<IntegerBall<Dimension>> proper;
    for (const std::size_t index : exact_basis_among<Dimension>(members)) proper.push_back(members[index]);
    sphere = ExactSphere<Dimension>::touching(proper);
  }
  return sphere->rounded(unit);
}

template Sphere exact_sphere_of(const Basis&, const Balls<2>&);
template Sphere exact_sphere_of(const Basis&, const Balls<3>&);
template int whole_unit(const Balls<2>&, BeadId, BeadId);
template int whole_unit(const Balls<3>&, BeadId, BeadId);
template IntegerBall<2> whole_ball(const Balls<2>&, BeadId, int);
template IntegerBall<3> whole_ball(const Balls<3>&, BeadId, int);
template class TouchingSphere<2, Integer>;
template class TouchingSphere<3, Integer>;
template class TouchingSphere<2, TrackedDouble>;
template class TouchingSphere<3, TrackedDouble>;
template std::vector<std::size_t> exact_basis_among<2>(std::span<const IntegerBall<2>>);
template std::vector<std::size_t> exact_basis_among<3>(std::span<const IntegerBall<3>>);

template <int Dimension>
Cage<Dimension> enclosing_sphere_exactly(const Balls<Dimension>& balls, BeadId first, BeadId last,
                                         Basis& basis, bool of_points, ExactUse use) {
  return ExactSearch<Dimension>(balls, first, last, of_points, use).settle(basis);
}

template Cage<2> enclosing_sphere_exactly(const Balls<2>&, BeadId, BeadId, Basis&, bool, ExactUse);
template Cage<3> enclosing_sphere_exactly(const Balls<3>&, BeadId, BeadId, Basis&, bool, ExactUse);

}  // namespace kds
