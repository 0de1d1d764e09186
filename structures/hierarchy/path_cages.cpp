#include "structures/hierarchy/path_cages.h"

#include <algorithm>
#include <cmath>

#include "motions/base/floating_point_guard.h"

namespace kds {

namespace {

constexpr double kPathTolerance = 1e-9;

double farthest_point(const Sphere& sphere, const Eigen::Vector3d& from) {
  return (sphere.center - from).norm() + sphere.radius;
}

// Returns whether the farthest point of `a` from `from` lies in `b`.
bool holds_farthest(const Sphere& b, const Sphere& a, const Eigen::Vector3d& from) {
  const Eigen::Vector3d away = a.center - from;
  const double distance = away.norm();
  if (distance == 0) return (a.center - b.center).norm() + a.radius <= b.radius;
  return (a.center + a.radius / distance * away - b.center).norm() <= b.radius;
}

template <int Dimension>
class PathCascade {
 public:
  PathCascade(const StaticWrappedHierarchy<Dimension>& trusted, const StaticWrappedHierarchy<Dimension>& now,
              const Balls<Dimension>& balls, bool with_paths)
      : tree_(now.tree()), trusted_(trusted), now_(now), balls_(balls), with_paths_(with_paths) {}

  CascadeCost verify() {
    for (auto node = static_cast<NodeId>(tree_.node_count()); node-- > 0;) {
      old_ = trusted_.sphere(node);
      within_ = old_.radius * (1 + kPathTolerance);
      verified_ = node;
      if (!children_are_inside(node, tree_.range(node))) cost_.escaped.push_back(node);
    }
    return std::move(cost_);
  }

 private:
  bool children_are_inside(NodeId node, const BeadRange& range) {
    return is_inside(tree_.left(node), range.first) && is_inside(tree_.right(node), range.last);
  }

  // `bead` is the only bead if there is no node.
  bool is_inside(NodeId node, BeadId bead) {
    if (node == NecklaceTree::leaf) {
      const Basis& basis = trusted_.basis(verified_);
      if (basis.contains(bead)) return true;
      ++cost_.tests;
      Sphere ball{Eigen::Vector3d::Zero(), balls_.radius(bead)};
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        ball.center[static_cast<Eigen::Index>(axis)] = balls_.coordinate(bead, axis);
      return farthest_point(ball, old_.center) <= within_;
    }
    ++cost_.tests;
    const Sphere cage = now_.sphere(node);
    if (farthest_point(cage, old_.center) <= within_) return true;
    if (with_paths_) {
      for (auto above = path_.rbegin(); above != path_.rend(); ++above) {
        ++cost_.path_tests;
        if (farthest_in_both(cage, *above, old_.center) <= within_) return true;
      }
      path_.push_back(cage);
    }
    const bool inside = children_are_inside(node, tree_.range(node));
    if (with_paths_) path_.pop_back();
    return inside;
  }

  const NecklaceTree& tree_;
  const StaticWrappedHierarchy<Dimension>& trusted_;
  const StaticWrappedHierarchy<Dimension>& now_;
  const Balls<Dimension>& balls_;
  bool with_paths_;
  NodeId verified_ = 0;
  Sphere old_;  // of the verified node's old basis
  double within_ = 0;
  std::vector<Sphere> path_;  // cages above, the uppermost first
  CascadeCost cost_;
};

}  // namespace

double farthest_in_both(const Sphere& a, const Sphere& b, const Eigen::Vector3d& from) {
  if (holds_farthest(b, a, from)) return farthest_point(a, from);
  if (holds_farthest(a, b, from)) return farthest_point(b, from);
  const Eigen::Vector3d between = b.center - a.center;
  const double distance = between.norm();
  if (distance == 0) return std::min(farthest_point(a, from), farthest_point(b, from));
  const Eigen::Vector3d axis = between / distance;
  // The circle's plane is `along` from the centre of `a`.
  const double along = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
  const double radius = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
  const Eigen::Vector3d offset = from - a.center;
  const double height = offset.dot(axis);
  const double aside = (offset - height * axis).norm();
  return std::hypot(along - height, aside + radius);
}

template <int Dimension>
CascadeCost cascade_cost(const StaticWrappedHierarchy<Dimension>& trusted,
                         const StaticWrappedHierarchy<Dimension>& now, const Balls<Dimension>& balls,
                         bool with_paths) {
  const FloatingPointGuard to_nearest;
  return PathCascade<Dimension>(trusted, now, balls, with_paths).verify();
}

template CascadeCost cascade_cost(const StaticWrappedHierarchy<2>&, const StaticWrappedHierarchy<2>&,
                                  const Balls<2>&, bool);
template CascadeCost cascade_cost(const StaticWrappedHierarchy<3>&, const StaticWrappedHierarchy<3>&,
                                  const Balls<3>&, bool);

}  // namespace kds
