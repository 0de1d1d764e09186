#include "structures/collision/sphere_tree.h"

#include <cmath>

#include "motions/base/floating_point_scope.h"
#include "structures/enclosing_sphere/sphere_scan.h"

namespace kds {

namespace {

// Rounds up a radius that was computed with at most eight roundings.
double radius_rounded_up(double radius) {
  return std::isfinite(radius) ? radius * (1 + 0x1p-48) + 0x1p-500 : HUGE_VAL;
}

// Returns the distance from `from` to the farthest point of the ball.
template <int Dimension>
[[gnu::always_inline]] inline double reach_of(const Point<Dimension>& center, double radius,
                                              const Point<Dimension>& from) {
  const Point<Dimension> d = detail::minus(center, from);
  return std::sqrt(detail::dot(d, d)) + radius;
}

// Returns the greatest distance from `from` to a point of balls first..last, rounded.
template <int Dimension>
[[KDS_SCAN_TARGETS]] double farthest_reach(const Balls<Dimension>& balls, BeadId first, BeadId last,
                                           const Point<Dimension>& from) {
  if (balls.equal_radii()) {
    const detail::PointMeasure<Dimension> measure{detail::coordinates_of(balls), from, 0};
    detail::Farthest farthest;
    farthest.scan(measure, first, last);
    return std::sqrt(farthest.result()) + balls.radius(first);
  }
  double most = 0;
  for (BeadId b = first; b <= last; ++b) {
    const double reach = reach_of<Dimension>(detail::center_of(balls, b), balls.radii()[b], from);
    most = reach > most ? reach : most;
  }
  return most;
}

template <class Variant, int Dimension>
Variant made(Hierarchy kind, std::span<const BeadRange> necklaces) {
  if (kind == Hierarchy::wrapped) return StaticWrappedHierarchy<Dimension>(necklaces);
  return LayeredHierarchy<Dimension>(necklaces);
}

template <int Dimension>
Point<Dimension> center_in(const Sphere& sphere) {
  Point<Dimension> center;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    center[axis] = sphere.center[static_cast<Eigen::Index>(axis)];
  return center;
}

template <int Dimension>
bool is_finite(const Point<Dimension>& point) {
  double zero = 0;
  for (const double x : point) zero += 0 * x;
  return zero == 0;
}

}  // namespace

template <int Dimension>
SphereTree<Dimension>::SphereTree(Hierarchy kind, std::span<const BeadRange> necklaces)
    : hierarchy_(made<decltype(hierarchy_), Dimension>(kind, necklaces)) {
  const NecklaceTree& tree =
      std::visit([](const auto& hierarchy) -> const NecklaceTree& { return hierarchy.tree(); }, hierarchy_);
  const auto nodes = static_cast<std::uint32_t>(tree.node_count());
  const auto child = [nodes](NodeId node, BeadId leaf) {
    return node == NecklaceTree::leaf ? nodes + leaf : node;
  };
  const std::size_t beads = necklaces.empty() ? 0 : std::size_t{necklaces.back().last} + 1;
  spheres_.resize(nodes + beads);
  for (NodeId node = 0; node < nodes; ++node) {
    const auto [first, last] = tree.range(node);
    spheres_[node] = {{}, 0, child(tree.left(node), first), child(tree.right(node), last), first, last};
  }
  for (BeadId b = 0; b < beads; ++b) spheres_[nodes + b] = {{}, 0, nodes + b, nodes + b, b, b};
  std::uint32_t node = 0;
  for (const auto& [first, last] : necklaces) {
    roots_.push_back(first == last ? nodes + first : node);
    node += last - first;
  }
}

template <int Dimension>
void SphereTree<Dimension>::build(const Balls<Dimension>& balls) {
  const FloatingPointScope to_nearest;
  const std::size_t nodes = spheres_.size() - balls.size();
  for (BeadId b = 0; b < balls.size(); ++b) {
    spheres_[nodes + b].center = detail::center_of(balls, b);
    spheres_[nodes + b].radius = balls.radius(b);
  }
  std::visit(
      [&](auto& hierarchy) {
        hierarchy.build(balls);
        measure(hierarchy, balls);
      },
      hierarchy_);
}

template <int Dimension>
void SphereTree<Dimension>::measure(const StaticWrappedHierarchy<Dimension>& hierarchy,
                                    const Balls<Dimension>& balls) {
  for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
    TreeSphere<Dimension>& sphere = spheres_[node];
    sphere.center = center_in<Dimension>(hierarchy.sphere(node));
    sphere.radius = is_finite<Dimension>(sphere.center)
                        ? radius_rounded_up(farthest_reach(balls, sphere.first, sphere.last, sphere.center))
                        : HUGE_VAL;
  }
}

template <int Dimension>
void SphereTree<Dimension>::measure(const LayeredHierarchy<Dimension>& hierarchy, const Balls<Dimension>&) {
  for (auto node = static_cast<NodeId>(hierarchy.tree().node_count()); node-- > 0;) {  // children first
    TreeSphere<Dimension>& sphere = spheres_[node];
    sphere.center = center_in<Dimension>(hierarchy.sphere(node));
    const TreeSphere<Dimension>&left = spheres_[sphere.left], &right = spheres_[sphere.right];
    const double a = reach_of<Dimension>(left.center, left.radius, sphere.center);
    const double b = reach_of<Dimension>(right.center, right.radius, sphere.center);
    sphere.radius = a + b < HUGE_VAL ? radius_rounded_up(a > b ? a : b) : HUGE_VAL;
  }
}

template class SphereTree<2>;
template class SphereTree<3>;

}  // namespace kds
