#include "structures/sphere_chord.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "motions/lanes.h"

namespace kds {

namespace {

using Eigen::Vector3d;
template <class Value>
using Ends = std::array<Value, 2>;

// Relative to the lengths that went in; the roundings of the formulas here add up to less than 2^-48.
constexpr double margin = 0x1p-45;

struct Quadratic {  // Bernstein coefficients
  std::array<Vector3d, 3> c;
  [[nodiscard]] double most() const {
    return std::sqrt(std::max({c[0].squaredNorm(), c[1].squaredNorm(), c[2].squaredNorm()}));
  }
};
using Cubic = std::array<double, 4>;

Quadratic cross(const Ends<Vector3d>& a, const Ends<Vector3d>& b) {
  return {{a[0].cross(b[0]), 0.5 * (a[0].cross(b[1]) + a[1].cross(b[0])), a[1].cross(b[1])}};
}
Cubic dot(const Quadratic& q, const Ends<Vector3d>& a) {
  return {q.c[0].dot(a[0]), (q.c[0].dot(a[1]) + 2 * q.c[1].dot(a[0])) / 3,
          (2 * q.c[1].dot(a[1]) + q.c[2].dot(a[0])) / 3, q.c[2].dot(a[1])};
}
std::array<double, 3> dot(const Ends<Vector3d>& a, const Ends<Vector3d>& b) {
  return {a[0].dot(b[0]), 0.5 * (a[0].dot(b[1]) + a[1].dot(b[0])), a[1].dot(b[1])};
}
template <std::size_t N>
double least(const std::array<double, N>& c) {
  return *std::min_element(c.begin(), c.end());
}
double longer(const Ends<Vector3d>& a) { return std::sqrt(std::max(a[0].squaredNorm(), a[1].squaredNorm())); }

/// Most of |d|^2 / 2 - d.z', which is near zero at both ends.
double residual(const Ends<Vector3d>& d, const Ends<Vector3d>& z) {
  const auto r = [&](int i, int j) {
    return 0.5 * (d[static_cast<std::size_t>(i)].dot(d[static_cast<std::size_t>(j)]) -
                  d[static_cast<std::size_t>(i)].dot(z[static_cast<std::size_t>(j)]) -
                  d[static_cast<std::size_t>(j)].dot(z[static_cast<std::size_t>(i)]));
  };
  return std::max(std::abs(r(0, 0)), std::abs(r(1, 1))) + 0.5 * std::abs(r(0, 1));
}

/// What a basis says of its sphere's chord.
struct Sphere {
  Ends<Vector3d> z;
  double strays = HUGE_VAL;  // B
  bool keeps_basis = false;
};

Sphere of_pair(const Ends<Vector3d>& d, double length) {
  return {{0.5 * d[0], 0.5 * d[1]}, margin * length, true};
}

Sphere of_triple(const std::array<Ends<Vector3d>, 3>& d, double length) {
  Sphere sphere;
  for (std::size_t e = 0; e < 2; ++e) {
    const Vector3d n = d[0][e].cross(d[1][e]);
    sphere.z[e] = (d[0][e].squaredNorm() * d[1][e].cross(n) + d[1][e].squaredNorm() * n.cross(d[0][e])) /
                  (2 * n.squaredNorm());
  }
  const Quadratic n = cross(d[0], d[1]);
  const Vector3d along = (n.c[0] + n.c[2]).normalized();
  const double square = length * length;
  const double least_n =
      std::min({n.c[0].dot(along), n.c[1].dot(along), n.c[2].dot(along)}) - margin * square;
  if (!(least_n > 0)) return sphere;
  const double l = std::max(length, longer(sphere.z));
  const double rounding = margin * l * l;
  const double r0 = residual(d[0], sphere.z) + rounding;
  const double r1 = residual(d[1], sphere.z) + rounding;
  const Cubic across = dot(n, sphere.z);
  const double r2 = std::max(std::abs(across[0]), std::abs(across[3])) +
                    0.75 * std::max(std::abs(across[1]), std::abs(across[2])) + margin * square * l;
  sphere.strays = (1 + 0x1p-30) * (r0 * longer(d[1]) + r1 * longer(d[0]) + r2) / least_n;
  // No angle reaches a right one.
  const Ends<Vector3d> third{d[1][0] - d[0][0], d[1][1] - d[0][1]};
  const Ends<Vector3d> back{-third[0], -third[1]};
  const Ends<Vector3d> from_first{-d[0][0], -d[0][1]}, from_second{-d[1][0], -d[1][1]};
  sphere.keeps_basis = std::min({least(dot(d[0], d[1])), least(dot(from_first, third)),
                                 least(dot(from_second, back))}) > margin * square;
  return sphere;
}

Sphere of_quadruple(const std::array<Ends<Vector3d>, 3>& d, double length) {
  Sphere sphere;
  std::array<Quadratic, 3> n{cross(d[1], d[2]), cross(d[2], d[0]), cross(d[0], d[1])};
  Cubic det = dot(n[0], d[0]);
  if (det[0] < 0) {
    for (double& c : det) c = -c;
    for (Quadratic& q : n) {
      for (Vector3d& c : q.c) c = -c;
    }
  }
  const double cube = length * length * length;
  const double least_det = least(det) - margin * cube;
  if (!(least_det > 0)) return sphere;
  for (std::size_t e = 0; e < 2; ++e) {
    sphere.z[e].setZero();
    for (std::size_t i = 0; i < 3; ++i) sphere.z[e] += 0.5 * d[i][e].squaredNorm() * n[i].c[2 * e];
    sphere.z[e] /= det[3 * e];
  }
  const double l = std::max(length, longer(sphere.z));
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sum += (residual(d[i], sphere.z) + margin * l * l) * (n[i].most() + margin * length * length);
  sphere.strays = (1 + 0x1p-30) * sum / least_det;
  // Barycentric coordinates of the centre, times the determinant.
  sphere.keeps_basis = true;
  Cubic rest = det;
  double rest_strays = 0;
  for (const Quadratic& q : n) {
    const Cubic share = dot(q, sphere.z);
    const double strays = sphere.strays * q.most() * (1 + 0x1p-30) + margin * length * length * l;
    sphere.keeps_basis &= least(share) > strays;
    for (std::size_t k = 0; k < 4; ++k) rest[k] -= share[k];
    rest_strays += strays;
  }
  sphere.keeps_basis &= least(rest) > rest_strays + margin * cube;
  return sphere;
}

}  // namespace

void StepEnds::measure() {
  extent_ = 0;
  for (auto& column : columns_) {
    const auto end = column.end() - 3;
    if (column.begin() == end) continue;
    const auto [low, high] = std::minmax_element(column.begin(), end);
    extent_ = std::max(extent_, *high - *low);
    std::fill(end, column.end(), *low);
  }
}

SphereChord sphere_chord(const StepEnds& ends, const Basis& basis, double from) {
  SphereChord chord;
  if (basis.size < 2) return chord;
  std::array<Ends<Vector3d>, 3> d;
  double length = 0;
  const Ends<Vector3d> base{ends.center(basis.beads[0], 0), ends.center(basis.beads[0], 1)};
  for (std::size_t i = 0; i + 1 < basis.size; ++i) {
    for (int e = 0; e < 2; ++e)
      d[i][static_cast<std::size_t>(e)] =
          ends.center(basis.beads[i + 1], e) - base[static_cast<std::size_t>(e)];
    length = std::max(length, longer(d[i]));
    if (from > 0) d[i][0] = (1 - from) * d[i][0] + from * d[i][1];
  }
  // Within these, products keep clear of overflow and of subnormal numbers.
  if (!(length > 0x1p-150 && ends.extent() < 0x1p150)) return chord;
  const Sphere sphere = basis.size == 2   ? of_pair(d[0], length)
                        : basis.size == 3 ? of_triple(d, length)
                                          : of_quadruple(d, length);
  const Vector3d along = (sphere.z[0] + sphere.z[1]).normalized();
  const double nearest =
      std::min(sphere.z[0].dot(along), sphere.z[1].dot(along)) - margin * (length + longer(sphere.z));
  if (!(nearest > 0)) return chord;
  const double stray = 2 * sphere.strays +
                       (sphere.z[1] - sphere.z[0]).squaredNorm() / (8 * nearest) * (1 + 0x1p-30) +
                       margin * (ends.extent() + length + longer(sphere.z));
  chord.keeps_basis = sphere.keeps_basis;
  chord.center = sphere.z;
  for (std::size_t e = 0; e < 2; ++e) chord.limit[e] = sphere.z[e].norm() - stray;
  // Also where a bound is no number.
  chord.proved = chord.limit[0] > 0 && chord.limit[1] > 0;
  return chord;
}

[[KDS_LANES_TARGETS]] void find_beyond(const StepEnds& ends, const BeadRange& range, BeadId base,
                                       const SphereChord& chord, double from, std::vector<BeadId>& beyond) {
  const Lanes later(from), earlier(1 - from);
  const double below = 1 - 0x1p-40;
  const Lanes most_start(chord.limit[0] * chord.limit[0] * below);
  const Lanes most_end(chord.limit[1] * chord.limit[1] * below);
  beyond.clear();
  for (BeadId b = range.first; b <= range.last; b += Lanes::width) {
    Lanes at_start(0.0), at_end(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const double* x0 = ends.column(0, axis);
      const double* x1 = ends.column(1, axis);
      const Lanes d0 = Lanes(Lanes::load(x0 + b)) - Lanes(x0[base]);
      const Lanes d1 = Lanes(Lanes::load(x1 + b)) - Lanes(x1[base]);
      const Lanes v0 = earlier * d0 + later * d1 - Lanes(chord.center[0][axis]);
      const Lanes v1 = d1 - Lanes(chord.center[1][axis]);
      at_start += v0 * v0;
      at_end += v1 * v1;
    }
    const Lanes::Mask inside = (at_start <= most_start) & (at_end <= most_end);
    if (Lanes::all(inside)) continue;
    for (BeadId lane = 0; lane < Lanes::width && b + lane <= range.last; ++lane) {
      if (inside[lane] == 0) beyond.push_back(b + lane);
    }
  }
}

}  // namespace kds
