#pragma once
// Sets of balls that are difficult inputs for minimum enclosing spheres, and a check of a basis from the
// definition over rationals. The check uses nothing of structures/ except the type names of its numbers.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/judges/enclosing_ball.h"
#include "tests/support/text_of.h"

namespace kds::test {

struct BallSet {
  std::string name;
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;
};

/// Makes the `which`-th kind of set, with `beads` balls. In the plane the third coordinate is zero.
inline BallSet hard_ball_set(std::mt19937& random, std::size_t which, Eigen::Index beads, bool equal,
                             bool flat) {
  const auto whole = [&random](unsigned range) { return static_cast<double>(random() % range); };
  std::uniform_real_distribution<double> real(-1, 1);
  BallSet set;
  set.centers = Eigen::Matrix3Xd::Zero(3, beads);
  const double scale = std::ldexp(1.0, static_cast<int>(random() % 3) * 200 - 200);
  for (Eigen::Index b = 0; b < beads; ++b) {
    const double angle = whole(24) * M_PI / 12;
    using V = Eigen::Vector3d;
    const auto [name, c] = [&]() -> std::pair<const char*, V> {
      switch (which) {
        case 0:
          return {"random", V(real(random), real(random), real(random))};
        case 1:
          return {"grid", V(whole(3), whole(3), whole(3))};
        case 2:
          return {"collinear", whole(9) * V(3, -1, 2)};
        case 3:
          return {"coplanar", V(whole(5), whole(5), 2)};
        case 4:
          return {"cocircular, rounded", V(std::cos(angle), std::sin(angle), whole(2) * 0x1p-30)};
        case 5:
          return {"coincident", V(1.5, 2.5, -1)};
        case 6:
          return {"two places", V(whole(2), whole(2) * 0x1p-52, 0)};
        case 7:
          return {"far away", V(0x1p40 + whole(4), 0x1p40 + real(random), whole(3))};
        case 8:
          return {"an ulp apart", V(1, 1, 1) + 0x1p-52 * V(whole(3), whole(3), whole(3))};
        case 9:
          return {"scaled", scale * V(real(random), real(random), real(random))};
        case 10:
          return {"scaled grid", scale * scale * V(whole(3), whole(3), whole(3))};
        default:
          return {"sizes apart",
                  V(std::ldexp(real(random), -static_cast<int>(random() % 120)), real(random), 0)};
      }
    }();
    set.name = name;
    set.centers.col(b) = c;
    if (flat) set.centers(2, b) = 0;
    double radius = 0.25;
    if (!equal) {
      radius = random() % 3 == 0 ? 0.5 : which == 1 ? whole(3) : std::abs(real(random));
      if (random() % 16 == 0) radius *= 8;  // contains other balls
      if (random() % 8 == 0) radius = 0;
    }
    if (which == 9) radius *= scale;
    if (which == 10) radius *= scale * scale;
    if (which == 8 && !equal) radius = whole(4) * 0x1p-52;
    set.radii.push_back(radius);
  }
  return set;
}
inline constexpr std::size_t hard_ball_sets = 12;

/// Explains why the basis' sphere is not the smallest sphere around balls first..last, or why the basis has a
/// superfluous ball. Returns nothing if the basis is correct. `radius` is compared with a relative tolerance
/// of 1e-12.
inline std::optional<std::string> not_smallest_ball(const BallSet& set, std::size_t first, std::size_t last,
                                                    const std::vector<std::size_t>& basis, double radius) {
  const auto ball = [&](std::size_t b) {
    const auto c = set.centers.col(static_cast<Eigen::Index>(b));
    return Ball{{Rational(c.x()), Rational(c.y()), Rational(c.z())}, Rational(set.radii[b])};
  };
  std::vector<Ball> members;
  for (const std::size_t b : basis) {
    if (b < first || b > last) return text_of("ball ", b, " is not of the set");
    members.push_back(ball(b));
  }
  if (members.empty()) return "no basis";
  const auto sphere = touching_sphere(members);
  if (!sphere) return "no sphere touches the basis";
  if (members.size() > 1 && !sphere->is_proper()) return "a ball is to spare";
  for (std::size_t b = first; b <= last; ++b)
    if (sphere->holds(members[0], ball(b)) < 0) return text_of("ball ", b, " sticks out");
  const Rational exact = sphere->radius.lower + members[0].radius;
  if (abs(Rational(Rational(radius) - exact)) > exact * Rational(1e-12))
    return text_of("radius ", radius, " should be ", exact.get_d());
  return std::nullopt;
}

}  // namespace kds::test
