#include "structures/enclosing_sphere.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "motions/exact_number.h"

namespace kds {

namespace {

// Weights y of the centre c_0 + sum_i y_i d_i: solves G y = (|d_i|^2 / 2), by Cramer's rule so that any field
// will do.
template <class Number>
std::array<Number, 3> center_offset(const std::array<std::array<Number, 3>, 3>& d, std::size_t m) {
  std::array<std::array<Number, 3>, 3> g{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      g[i][j] = i < m && j < m ? Number(d[i][0] * d[j][0] + d[i][1] * d[j][1] + d[i][2] * d[j][2])
                               : Number(i == j ? 1 : 0);
    }
  }
  const auto cofactor = [&](std::size_t i, std::size_t j) -> Number {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return g[i1][j1] * g[i2][j2] - g[i1][j2] * g[i2][j1];
  };
  Number det = 0;
  for (std::size_t j = 0; j < 3; ++j) det += g[0][j] * cofactor(0, j);
  std::array<Number, 3> offset{};
  for (std::size_t i = 0; i < m; ++i) {
    Number y = 0;
    for (std::size_t j = 0; j < m; ++j) y += cofactor(i, j) * g[j][j];
    y /= 2 * det;
    for (std::size_t axis = 0; axis < 3; ++axis) offset[axis] += y * d[i][axis];
  }
  return offset;
}

template <class Number>
std::array<Number, 3> offset_of(const Basis& basis, const Eigen::Matrix3Xd& centers) {
  std::array<std::array<Number, 3>, 3> d{};
  for (std::size_t i = 1; i < basis.size; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      d[i - 1][static_cast<std::size_t>(axis)] =
          Number(centers(axis, basis.beads[i])) - Number(centers(axis, basis.beads[0]));
    }
  }
  return center_offset(d, basis.size - 1U);
}

}  // namespace

Sphere sphere_of(const Basis& basis, const Eigen::Matrix3Xd& centers) {
  const auto offset = offset_of<double>(basis, centers);
  const Eigen::Vector3d z(offset[0], offset[1], offset[2]);
  return {centers.col(basis.beads[0]) + z, z.norm()};
}

Sphere exact_sphere_of(const Basis& basis, const Eigen::Matrix3Xd& centers) {
  const auto z = offset_of<Rational>(basis, centers);
  Sphere sphere;
  Rational square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Rational& along = z[static_cast<std::size_t>(axis)];
    sphere.center[axis] = Rational(Rational(centers(axis, basis.beads[0])) + along).convert_to<double>();
    square += along * along;
  }
  // A square may leave the range of double where its root does not: take out an even power of two.
  if (square == 0) return sphere;
  const Integer& n = boost::multiprecision::numerator(square);
  const Integer& q = boost::multiprecision::denominator(square);
  const long bits = (static_cast<long>(msb(n)) - static_cast<long>(msb(q))) / 2 * 2;
  if (bits > 0) {
    square /= Rational(Integer(1) << static_cast<unsigned>(bits));
  } else if (bits < 0) {
    square *= Rational(Integer(1) << static_cast<unsigned>(-bits));
  }
  sphere.radius = std::ldexp(std::sqrt(square.convert_to<double>()), static_cast<int>(bits / 2));
  return sphere;
}

Basis likely_basis(BeadId first, BeadId last, Basis basis, const Eigen::Matrix3Xd& centers) {
  constexpr int most_pivots = 64;
  constexpr double slack = 1e-10;  // of the squared radius: this is a guess
  for (int pivot = 0; pivot < most_pivots; ++pivot) {
    const Sphere sphere = sphere_of(basis, centers);
    double farthest = sphere.radius * sphere.radius * (1 + slack);
    BeadId escaped = no_bead;
    for (BeadId b = first; b <= last; ++b) {
      const double distance = (centers.col(b) - sphere.center).squaredNorm();
      if (distance > farthest) {
        farthest = distance;
        escaped = b;
      }
    }
    if (escaped == no_bead || basis.contains(escaped)) break;
    // The smallest sphere of the escaped bead and some of the basis that holds all of them.
    Basis best;
    double best_radius = std::numeric_limits<double>::infinity();
    for (unsigned subset = 0; subset < 1U << basis.size; ++subset) {
      Basis candidate;
      for (std::size_t i = 0; i < basis.size; ++i) {
        if ((subset >> i & 1U) != 0) candidate.beads[candidate.size++] = basis.beads[i];
      }
      if (candidate.size == Basis::max_size) continue;
      candidate.beads[candidate.size++] = escaped;
      const Sphere s = sphere_of(candidate, centers);
      bool encloses = s.radius < best_radius;
      for (const BeadId b : basis) {
        encloses = encloses && (centers.col(b) - s.center).squaredNorm() <= s.radius * s.radius * (1 + slack);
      }
      if (encloses) {
        best = candidate;
        best_radius = s.radius;
      }
    }
    if (best.size == 0) break;
    basis = Basis(std::span(best.beads).first(best.size));
  }
  return basis;
}

}  // namespace kds
