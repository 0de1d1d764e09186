#include "tests/support/judges/union_of_balls.h"

#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <optional>
#include <utility>

namespace kds::test {

namespace {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type,
                                           boost::multiprecision::et_off>;
using Vector = std::array<Real, 3>;
const Real tiny("1e-40");
const Real pi = boost::math::constants::pi<Real>();
constexpr long double circle = 2 * boost::math::constants::pi<long double>();

Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector sum(const Vector& a, const Vector& b, const Real& times) {
  return {a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]};
}
Vector center(const Eigen::Matrix3Xd& centers, std::size_t i) {
  const auto c = centers.col(static_cast<Eigen::Index>(i));
  return {Real(c.x()), Real(c.y()), Real(c.z())};
}

/// The circle in which two spheres meet.
struct Circle {
  Vector center, axis;  // the axis has length 1
  Real distance;        // from the first sphere's centre to the circle's plane
  Real squared_radius;  // negative if the spheres do not meet
};
std::optional<Circle> circle_of(const Vector& a, const Real& ra, const Vector& b, const Real& rb) {
  const Vector ab = sum(b, a, -1);
  const Real d = sqrt(dot(ab, ab));
  if (d == 0) return std::nullopt;
  const Vector axis = sum({0, 0, 0}, ab, 1 / d);
  const Real h = (d * d + ra * ra - rb * rb) / (2 * d);
  return Circle{sum(a, axis, h), axis, h, ra * ra - h * h};
}

/// Returns the parts of a circle that are outside some arcs, each given by its middle and half its angle.
std::vector<std::pair<long double, long double>> outside(
    std::vector<std::pair<long double, long double>> arcs) {
  std::vector<std::pair<long double, long double>> covered, open;
  for (auto [middle, half] : arcs) {
    long double begin = std::fmod(middle - half, circle);
    if (begin < 0) begin += circle;
    const long double end = begin + 2 * half;
    covered.emplace_back(begin, std::min(end, circle));
    if (end > circle) covered.emplace_back(0, end - circle);
  }
  std::sort(covered.begin(), covered.end());
  long double reached = 0;
  for (const auto& [begin, end] : covered) {
    if (begin > reached) open.emplace_back(reached, begin);
    reached = std::max(reached, end);
  }
  if (reached < circle) open.emplace_back(reached, circle);
  return open;
}

template <class Function>
long double integral(Function f, const std::vector<double>& heights, double low, double high) {
  std::vector<long double> ends{low};
  for (const double height : heights)
    if (height > low && height < high) ends.push_back(height);
  ends.push_back(high);
  std::sort(ends.begin(), ends.end());
  static boost::math::quadrature::tanh_sinh<long double> rule(12);
  long double total = 0;
  for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
    const long double length = ends[e + 1] - ends[e];
    if (length < 1e-15L * (high - low)) continue;
    total +=
        rule.integrate([&](long double u) { return f(ends[e] + length * u); }, 0.0L, 1.0L, 1e-13L) * length;
  }
  return total;
}

}  // namespace

UnionOfBalls::UnionOfBalls(const Eigen::Matrix3Xd& centers, std::vector<double> radii)
    : centers_(centers), radii_(std::move(radii)) {
  const std::size_t n = radii_.size();
  heights_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vector a = center(centers_, i);
    for (const double side : {-1, 1})
      heights_[i].push_back(centers_(2, static_cast<Eigen::Index>(i)) + side * radii_[i]);
    for (std::size_t j = i + 1; j < n; ++j) {
      const auto c = circle_of(a, radii_[i], center(centers_, j), radii_[j]);
      if (!c || c->squared_radius < 0) continue;
      const Real steep = 1 - c->axis[2] * c->axis[2],
                 rise = steep > 0 ? Real(sqrt(c->squared_radius * steep)) : Real(0);
      for (const int side : {-1, 1})
        for (const std::size_t b : {i, j})
          heights_[b].push_back(static_cast<double>(Real(c->center[2] + side * rise)));
      for (std::size_t k = j + 1; k < n; ++k) {
        // The radical plane of i and k cuts the circle's plane in a line.
        const auto other = circle_of(a, radii_[i], center(centers_, k), radii_[k]);
        if (!other) continue;
        const Vector along = cross(c->axis, other->axis);
        const Real squared = dot(along, along);
        if (squared < tiny) continue;
        const Vector across = cross(along, c->axis);  // in the circle's plane, towards the line
        const Real to_line = dot(sum(other->center, c->center, -1), other->axis) / dot(across, other->axis);
        const Vector foot = sum(c->center, across, to_line);
        const Real chord = c->squared_radius - to_line * to_line * squared;
        if (chord < 0) continue;
        for (const int side : {-1, 1}) {
          const Vector corner = sum(foot, along, side * sqrt(chord / squared));
          const bool is_hidden = [&] {  // deep in another ball, so on no boundary
            for (std::size_t l = 0; l < n; ++l) {
              const Vector to = sum(corner, center(centers_, l), -1);
              if (l != i && l != j && l != k && dot(to, to) < Real(0.999) * radii_[l] * radii_[l])
                return true;
            }
            return false;
          }();
          if (is_hidden) continue;
          for (const std::size_t b : {i, j, k}) heights_[b].push_back(static_cast<double>(corner[2]));
        }
      }
    }
  }
}

double UnionOfBalls::area(std::size_t i) const {
  const Eigen::Vector3d c = centers_.col(static_cast<Eigen::Index>(i));
  const long double r = radii_[i];
  const auto exposed = [&](long double z) -> long double {
    const long double own = std::sqrt(std::max(0.0L, (r - (z - c.z())) * (r + (z - c.z()))));
    std::vector<std::pair<long double, long double>> arcs;
    for (std::size_t j = 0; j < radii_.size(); ++j) {
      if (j == i) continue;
      const auto p = centers_.col(static_cast<Eigen::Index>(j));
      const long double dz = z - p.z(), rj = radii_[j], squared = (rj - dz) * (rj + dz);
      if (squared <= 0) continue;
      const long double other = std::sqrt(squared), dx = p.x() - static_cast<long double>(c.x()),
                        dy = p.y() - static_cast<long double>(c.y()), d = std::hypot(dx, dy);
      if (d >= own + other || own >= d + other) continue;
      if (other >= d + own) return 0;
      const long double cosine = (d * d + (own - other) * (own + other)) / (2 * d * own);
      arcs.emplace_back(std::atan2(dy, dx), std::acos(std::clamp(cosine, -1.0L, 1.0L)));
    }
    long double angle = 0;
    for (const auto& [begin, end] : outside(std::move(arcs))) angle += end - begin;
    return angle;
  };
  return static_cast<double>(r * integral(exposed, heights_[i], c.z() - radii_[i], c.z() + radii_[i]));
}

double UnionOfBalls::contact(std::size_t i, std::size_t j) const {
  const Vector a = center(centers_, i);
  const auto disc = circle_of(a, radii_[i], center(centers_, j), radii_[j]);
  if (!disc || disc->squared_radius <= 0) return 0;
  const Real radius = sqrt(disc->squared_radius);
  // Two axes of the disc's plane.
  std::size_t least = 0;
  for (std::size_t x = 1; x < 3; ++x)
    if (abs(disc->axis[x]) < abs(disc->axis[least])) least = x;
  Vector unit{0, 0, 0};
  unit[least] = 1;
  Vector e = cross(disc->axis, unit);
  e = sum({0, 0, 0}, e, 1 / sqrt(dot(e, e)));
  const Vector f = cross(disc->axis, e);
  // Half-planes x cos + y sin <= offset in which the other balls are no nearer.
  struct Half {
    Real cosine, sine, offset;
  };
  std::vector<Half> halves;
  for (std::size_t k = 0; k < radii_.size(); ++k) {
    if (k == i || k == j) continue;
    const Vector ak = sum(center(centers_, k), a, -1), at = sum(disc->center, a, -1);
    // Power of i minus power of k, at the disc's centre and along its axes, is 2 ak.x - |ak|^2 + rk^2 - ri^2.
    const Real ri = radii_[i], rk = radii_[k];
    const Real offset = (dot(ak, ak) - rk * rk + ri * ri) / 2 - dot(ak, at), x = dot(ak, e), y = dot(ak, f);
    const Real length = sqrt(x * x + y * y), size = sqrt(dot(ak, ak));
    if (length < tiny * size || size == 0) {
      if (offset < -tiny) return 0;
      continue;
    }
    const Half half{x / length, y / length, offset / length};
    const bool is_twice = std::any_of(halves.begin(), halves.end(), [&](const Half& h) {
      return abs(h.cosine - half.cosine) < tiny && abs(h.sine - half.sine) < tiny &&
             abs(h.offset - half.offset) < tiny;
    });
    if (!is_twice) halves.push_back(half);
  }
  const auto inside = [&](const Real& x, const Real& y) {
    return std::all_of(halves.begin(), halves.end(),
                       [&](const Half& h) { return x * h.cosine + y * h.sine <= h.offset + tiny; });
  };
  Real doubled = 0;  // twice the area: parts of lines, then arcs
  std::vector<Real> angles;
  for (std::size_t h = 0; h < halves.size(); ++h) {
    const Half& own = halves[h];
    if (abs(own.offset) >= radius) continue;
    const Real half_chord = sqrt(disc->squared_radius - own.offset * own.offset);
    Real low = -half_chord, high = half_chord;
    for (std::size_t g = 0; g < halves.size(); ++g) {
      if (g == h) continue;
      const Half& other = halves[g];
      const Real slope = own.cosine * other.sine - own.sine * other.cosine;
      const Real at = own.offset * (own.cosine * other.cosine + own.sine * other.sine);
      if (abs(slope) < tiny) {
        if (at > other.offset + tiny) high = low;
      } else if (slope > 0) {
        high = std::min(high, Real((other.offset - at) / slope));
      } else {
        low = std::max(low, Real((other.offset - at) / slope));
      }
    }
    if (high > low) doubled += own.offset * (high - low);
    const Real middle = atan2(own.sine, own.cosine), half = acos(own.offset / radius);
    for (Real angle : {Real(middle - half), Real(middle + half)}) {
      while (angle < 0) angle += 2 * pi;
      while (angle >= 2 * pi) angle -= 2 * pi;
      angles.push_back(angle);
    }
  }
  std::sort(angles.begin(), angles.end());
  angles.insert(angles.begin(), 0);
  angles.push_back(2 * pi);
  for (std::size_t s = 0; s + 1 < angles.size(); ++s) {
    const Real middle = (angles[s] + angles[s + 1]) / 2;
    if (inside(radius * cos(middle), radius * sin(middle)))
      doubled += disc->squared_radius * (angles[s + 1] - angles[s]);
  }
  return static_cast<double>(Real(doubled / 2));
}

double UnionOfBalls::volume(std::size_t i) const {
  double volume = radii_[i] * area(i);
  for (std::size_t j = 0; j < radii_.size(); ++j)
    if (const double shared = j == i ? 0 : contact(i, j); shared != 0)
      volume +=
          shared * static_cast<double>(
                       circle_of(center(centers_, i), radii_[i], center(centers_, j), radii_[j])->distance);
  return volume / 3;
}

double UnionOfBalls::volume() const {
  const auto cross_section = [&](long double z) {
    struct Disc {
      long double x, y, radius;
    };
    std::vector<Disc> discs;
    for (std::size_t j = 0; j < radii_.size(); ++j) {
      const auto p = centers_.col(static_cast<Eigen::Index>(j));
      const long double dz = z - p.z(), squared = (radii_[j] - dz) * (radii_[j] + dz);
      if (squared > 0) discs.push_back({p.x(), p.y(), std::sqrt(squared)});
    }
    long double doubled = 0;  // by Green's theorem along the boundary
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const Disc& own = discs[i];
      std::vector<std::pair<long double, long double>> arcs;
      bool hidden = false;
      for (std::size_t j = 0; j < discs.size() && !hidden; ++j) {
        const Disc& other = discs[j];
        const long double dx = other.x - own.x, dy = other.y - own.y, d = std::hypot(dx, dy);
        if (j == i || d >= own.radius + other.radius || own.radius > d + other.radius) continue;
        const bool equal = d == 0 && own.radius == other.radius;
        if (equal && j > i) continue;  // the first of equal discs counts
        hidden = equal || other.radius >= d + own.radius;
        if (d == 0) continue;
        const long double cosine =
            (d * d + (own.radius - other.radius) * (own.radius + other.radius)) / (2 * d * own.radius);
        arcs.emplace_back(std::atan2(dy, dx), std::acos(std::clamp(cosine, -1.0L, 1.0L)));
      }
      if (hidden) continue;
      for (const auto& [begin, end] : outside(std::move(arcs)))
        doubled += own.radius * (own.radius * (end - begin) + own.x * (std::sin(end) - std::sin(begin)) -
                                 own.y * (std::cos(end) - std::cos(begin)));
    }
    return doubled / 2;
  };
  std::vector<double> heights;
  for (const auto& of_ball : heights_) heights.insert(heights.end(), of_ball.begin(), of_ball.end());
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return static_cast<double>(integral(cross_section, heights, heights.front(), heights.back()));
}

}  // namespace kds::test
