#include "exact_sphere.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Min_sphere_of_spheres_d.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace oracle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

struct RationalBall {
  std::array<Rational, 3> centre;
  Rational radius;
  unsigned bead;
};

struct SphereTraits {
  using FT = Rational;
  using Sphere = RationalBall;
  using Cartesian_const_iterator = const Rational*;
  using Use_square_roots = CGAL::Tag_false;
  using Algorithm = CGAL::LP_algorithm;
  static const int D = 3;
  static const FT& radius(const Sphere& ball) { return ball.radius; }
  static Cartesian_const_iterator center_cartesian_begin(const Sphere& ball) { return ball.centre.data(); }
};

// Returns the sign of a + b sqrt(d).
CGAL::Sign sign_of(const Rational& a, const Rational& b, const Rational& d) {
  const CGAL::Sign sa = CGAL::sign(a), sb = CGAL::is_zero(d) ? CGAL::ZERO : CGAL::sign(b);
  if (sb == CGAL::ZERO || sa == sb) return sa;
  if (sa == CGAL::ZERO) return sb;
  return sa * CGAL::sign(Rational(a * a - b * b * d));
}

using Vector = std::array<Rational, 3>;

Rational dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Solves the m x m system by elimination; returns nothing if it is singular.
std::optional<std::vector<Rational>> solve(std::vector<std::vector<Rational>> rows) {
  const std::size_t m = rows.size();
  for (std::size_t c = 0; c < m; ++c) {
    std::size_t pivot = c;
    while (pivot < m && CGAL::is_zero(rows[pivot][c])) ++pivot;
    if (pivot == m) return std::nullopt;
    std::swap(rows[c], rows[pivot]);
    for (std::size_t r = 0; r < m; ++r) {
      if (r == c || CGAL::is_zero(rows[r][c])) continue;
      const Rational factor = rows[r][c] / rows[c][c];
      for (std::size_t k = c; k <= m; ++k) rows[r][k] -= factor * rows[c][k];
    }
  }
  std::vector<Rational> solution(m);
  for (std::size_t r = 0; r < m; ++r) solution[r] = rows[r][m] / rows[r][r];
  return solution;
}

Point point(const Ball& ball) { return Point(ball.centre[0], ball.centre[1], ball.centre[2]); }

// CGAL's filtered predicates on the circumsphere of one to four independent points.
class Circumsphere {
 public:
  explicit Circumsphere(std::vector<Point> points) : p_(std::move(points)) {}
  bool excludes(const Point& q) const {
    switch (p_.size()) {
      case 1:
        return q != p_[0];
      case 2:
        return CGAL::side_of_bounded_sphere(p_[0], p_[1], q) == CGAL::ON_UNBOUNDED_SIDE;
      case 3:
        return CGAL::side_of_bounded_sphere(p_[0], p_[1], p_[2], q) == CGAL::ON_UNBOUNDED_SIDE;
      default:
        return CGAL::side_of_bounded_sphere(p_[0], p_[1], p_[2], p_[3], q) == CGAL::ON_UNBOUNDED_SIDE;
    }
  }

 private:
  std::vector<Point> p_;
};

}  // namespace

CGAL::Sign compare(const RootNumber& x, const RootNumber& y) {
  // Compares (x.a - y.a + x.b sqrt(x.d)) with y.b sqrt(y.d): by signs, then by squares.
  const Rational a = x.a - y.a;
  const CGAL::Sign left = sign_of(a, x.b, x.d);
  const CGAL::Sign right = CGAL::is_zero(y.d) ? CGAL::ZERO : CGAL::sign(y.b);
  if (left != right) return left > right ? CGAL::POSITIVE : CGAL::NEGATIVE;
  if (left == CGAL::ZERO) return CGAL::ZERO;
  const Rational squares = a * a + x.b * x.b * x.d - y.b * y.b * y.d;
  return left * sign_of(squares, 2 * a * x.b, x.d);
}

double to_double(const RootNumber& x) {
  // Uses the conjugate if the two parts cancel.
  const double a = CGAL::to_double(x.a), b = CGAL::to_double(x.b), root = std::sqrt(CGAL::to_double(x.d));
  if (a * b >= 0) return a + b * root;
  const Rational norm = x.a * x.a - x.b * x.b * x.d;
  return CGAL::to_double(norm) / (a - b * root);
}

ExactSphere cgal_sphere(const Frame& frame, const std::vector<unsigned>& beads) {
  std::vector<RationalBall> balls;
  for (const unsigned bead : beads) {
    const Ball& b = frame[bead];
    balls.push_back({{b.centre[0], b.centre[1], b.centre[2]}, b.radius, bead});
  }
  CGAL::Min_sphere_of_spheres_d<SphereTraits> smallest(balls.begin(), balls.end());
  ExactSphere sphere;
  const Rational d = smallest.discriminant();
  const auto radius = smallest.radius();
  sphere.exact_radius = {radius.first, radius.second, d};
  sphere.radius = to_double(sphere.exact_radius);
  auto centre = smallest.center_cartesian_begin();
  for (std::size_t c = 0; c < 3; ++c, ++centre) {
    sphere.exact_centre[c] = {centre->first, centre->second, d};
    sphere.centre[c] = to_double(sphere.exact_centre[c]);
  }
  for (auto it = smallest.support_begin(); it != smallest.support_end(); ++it) {
    sphere.support.push_back((*it).bead);
  }
  std::sort(sphere.support.begin(), sphere.support.end());
  return sphere;
}

bool touches(const ExactSphere& sphere, const Ball& ball) {
  // The squared distance of the centres minus the squared difference of the radii is a + b sqrt(d).
  const RootNumber& radius = sphere.exact_radius;
  const Rational& d = radius.d;
  const Rational gap = radius.a - Rational(ball.radius);
  Rational a = -(gap * gap + radius.b * radius.b * d), b = -2 * gap * radius.b;
  for (std::size_t c = 0; c < 3; ++c) {
    const RootNumber& centre = sphere.exact_centre[c];
    const Rational apart = centre.a - Rational(ball.centre[c]);
    a += apart * apart + centre.b * centre.b * d;
    b += 2 * apart * centre.b;
  }
  return sign_of(a, b, d) == CGAL::ZERO;
}

Proof prove_sphere(const Frame& frame, const Node& node) {
  Proof proof;
  proof.sphere.support = node.basis;
  const std::size_t m = node.basis.size() - 1;
  const Ball& base = frame[node.basis[0]];
  std::vector<Vector> d(m);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      d[i][c] = Rational(frame[node.basis[i + 1]].centre[c]) - Rational(base.centre[c]);
    }
  }
  // The centre is base + sum lambda_i d_i. The point is equally far from all points if sum_k (d_i . d_k)
  // lambda_k = d_i . d_i / 2.
  std::vector<std::vector<Rational>> rows(m, std::vector<Rational>(m + 1));
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t k = 0; k < m; ++k) rows[i][k] = dot(d[i], d[k]);
    rows[i][m] = rows[i][i] / 2;
  }
  const auto lambda = solve(std::move(rows));
  if (!lambda) {
    proof.objection = "the basis is affinely dependent";
    return proof;
  }
  Vector offset{0, 0, 0};
  Rational rest = 1;
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t c = 0; c < 3; ++c) offset[c] += (*lambda)[i] * d[i][c];
    rest -= (*lambda)[i];
  }
  for (std::size_t c = 0; c < 3; ++c) proof.sphere.centre[c] = CGAL::to_double(offset[c] + base.centre[c]);
  proof.sphere.radius = std::sqrt(CGAL::to_double(dot(offset, offset))) + base.radius;

  const auto complain_of_weight = [&](std::size_t i, const Rational& weight) {
    if (CGAL::is_positive(weight) || proof.objection) return;
    proof.objection =
        CGAL::is_zero(weight) ? "the basis is not minimal, without bead " : "the centre lies beyond bead ";
    *proof.objection += std::to_string(node.basis[i]) +
                        (CGAL::is_zero(weight) ? " it has the same sphere" : "'s side of the basis hull");
  };
  complain_of_weight(0, rest);
  for (std::size_t i = 0; i < m; ++i) complain_of_weight(i + 1, (*lambda)[i]);
  if (proof.objection) return proof;

  std::vector<Point> corners;
  for (const unsigned bead : node.basis) corners.push_back(point(frame[bead]));
  const Circumsphere circumsphere(std::move(corners));
  for (unsigned bead = node.first; bead <= node.last; ++bead) {
    if (circumsphere.excludes(point(frame[bead]))) {
      proof.objection = "bead " + std::to_string(bead) + " sticks out of the basis sphere";
      return proof;
    }
  }
  return proof;
}

}  // namespace oracle
