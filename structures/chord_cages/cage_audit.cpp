#include "structures/chord_cages/cage_audit.h"

#include <cmath>
#include <vector>

#include "motions/curves/positions.h"
#include "structures/necklace/ball_distance.h"

namespace kds {

namespace {

std::string fault(const BeadRange& range, BeadId bead) {
  return "node " + std::to_string(range.first) + "-" + std::to_string(range.last) + ": bead " +
         std::to_string(bead) + " sticks out of its cage";
}

template <int Dimension>
Eigen::Vector3d in_space(const double* point) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (Eigen::Index axis = 0; axis < Dimension; ++axis) p[axis] = point[axis];
  return p;
}

/// A ball or cage at one time, with its radius last.
template <int Dimension>
using ExactBall = std::array<Rational, static_cast<std::size_t>(Dimension) + 1>;

/// Evaluates the Bernstein form with these control points at u by de Casteljau's algorithm.
Rational blended(std::vector<Rational> points, const Rational& u) {
  for (std::size_t left = points.size(); left > 1; --left)
    for (std::size_t k = 0; k + 1 < left; ++k) points[k] += u * (points[k + 1] - points[k]);
  return points.front();
}

}  // namespace

template <int Dimension>
std::optional<std::string> ball_outside(const NecklaceTree& tree, OutwardCages<Dimension> cages,
                                        const Curves<Dimension>& curves, int k) {
  for (NodeId node = 0; node < cages.size(); ++node) {
    const Cage<Dimension> cage = cages[node];
    if (std::isinf(cage.radius)) continue;
    const Eigen::Vector3d center = in_space<Dimension>(cage.center.data());
    const BeadRange& range = tree.range(node);
    for (BeadId b = range.first; b <= range.last; ++b) {
      const double r = curves.radius(b, k);
      const bool inside =
          cage.radius >= r &&
          compare_distance(in_space<Dimension>(curves.control_point(b, k)), center, cage.radius, -r) <= 0;
      if (!inside) return fault(range, b);
    }
  }
  return std::nullopt;
}

template <int Dimension>
std::optional<std::string> ball_outside_at(const NecklaceTree& tree,
                                           std::span<const OutwardCages<Dimension>> cages,
                                           const Curves<Dimension>& curves, const Dyadic& time) {
  const Rational u = time.rational();
  std::vector<ExactBall<Dimension>> balls(curves.bead_count());
  for (BeadId b = 0; b < balls.size(); ++b) {
    balls[b] = exact_position(curves, b, time);  // the last number is the weight
    balls[b].back() = exact_radius(curves, b, time);
  }
  std::vector<Rational> points(cages.size());
  for (NodeId node = 0; node < tree.node_count(); ++node) {
    const auto blend = [&](const auto& number) {
      for (std::size_t k = 0; k < cages.size(); ++k) points[k] = Rational(number(cages[k][node]));
      return blended(points, u);
    };
    bool overflowed = false;
    for (const auto& at_control : cages) overflowed |= std::isinf(at_control[node].radius);
    if (overflowed) continue;
    ExactBall<Dimension> cage;
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      cage[axis] = blend([axis](const Cage<Dimension>& c) { return c.center[axis]; });
    cage.back() = blend([](const Cage<Dimension>& c) { return c.radius; });
    const BeadRange& range = tree.range(node);
    for (BeadId b = range.first; b <= range.last; ++b) {
      const Rational room = cage.back() - balls[b].back();
      Rational square = 0;
      for (std::size_t axis = 0; axis < Dimension; ++axis) {
        const Rational d = balls[b][axis] - cage[axis];
        square += d * d;
      }
      if (room < 0 || square > room * room) return fault(range, b);
    }
  }
  return std::nullopt;
}

template std::optional<std::string> ball_outside(const NecklaceTree&, OutwardCages<2>, const Curves<2>&, int);
template std::optional<std::string> ball_outside(const NecklaceTree&, OutwardCages<3>, const Curves<3>&, int);
template std::optional<std::string> ball_outside_at(const NecklaceTree&, std::span<const OutwardCages<2>>,
                                                    const Curves<2>&, const Dyadic&);
template std::optional<std::string> ball_outside_at(const NecklaceTree&, std::span<const OutwardCages<3>>,
                                                    const Curves<3>&, const Dyadic&);

}  // namespace kds
