#include "structures/chord_cages/chord_hierarchy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "kds/simulator.h"
#include "motions/base/floating_point_scope.h"
#include "motions/curves/positions.h"
#include "structures/enclosing_sphere/integer_balls.h"
#include "structures/necklace/ball_distance.h"

namespace kds {

namespace {

template <class Hierarchy>
constexpr bool is_layered = std::is_same_v<Hierarchy, LayeredHierarchy<Hierarchy::dimension>>;

template <int D>
const MotionRef<D>& accepted(const MotionRef<D>& motion) {
  if (motion.is_lifted()) throw std::invalid_argument("radii mean nothing in lifted motion");
  return motion;
}

// A basis whose sphere encloses all beads, and which has no superfluous bead, is the basis of the minimum
// enclosing sphere. Checking both conditions on integers is therefore as good as building the sphere.
template <int D>
std::optional<std::string> not_as_built(const ChordCages<StaticWrappedHierarchy<D>>& cages,
                                        const Curves<D>& curves, const Dyadic& time) {
  const StaticWrappedHierarchy<D>& hierarchy = cages.hierarchy();
  const IntegerBalls<D> whole = integer_balls_at(curves, time);
  for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
    const Basis& basis = hierarchy.basis(node);
    const BeadRange& range = hierarchy.tree().range(node);
    const auto name = [&range] {
      return "node " + std::to_string(range.first) + "-" + std::to_string(range.last) + ": ";
    };
    if (const auto bead = bead_outside(proper_part(basis, whole), range, whole))
      return name() + "bead " + std::to_string(*bead) + " is outside the sphere of the basis";
  }
  return std::nullopt;
}

template <int D>
std::optional<std::string> not_as_built(const ChordCages<LayeredHierarchy<D>>& cages, const Curves<D>& curves,
                                        const Dyadic& time) {
  LayeredHierarchy<D> built = cages.hierarchy();
  built.build(BallRows<D>(curves, time == Dyadic(0.0) ? 0 : curves.own_degree()));
  TakenCages<LayeredHierarchy<D>> taken;
  taken.take(built, {});
  for (NodeId node = 0; node < cages.tree().node_count(); ++node) {
    const Cage<D> known = cages.cages(cages.last())[node], fresh = taken.outward()[node];
    if (known.center != fresh.center || known.radius != fresh.radius) {
      const BeadRange& range = cages.tree().range(node);
      return "node " + std::to_string(range.first) + "-" + std::to_string(range.last) +
             ": the sphere is not that of its children";
    }
  }
  return std::nullopt;
}

// Blends the cages of all control points by de Casteljau's algorithm. Each of its steps rounds every number
// four times, by 2^-53 of the largest number of its kind.
template <int D>
Sphere blended(std::vector<Cage<D>> cages, double u) {
  if (u == 0 || u == 1) return sphere_of(u == 0 ? cages.front() : cages.back(), 0.0);
  const double largest_radius =
      std::max_element(cages.begin(), cages.end(), [](const Cage<D>& a, const Cage<D>& b) {
        return a.radius < b.radius;
      })->radius;
  double largest = largest_radius;
  for (const Cage<D>& cage : cages)
    for (const double x : cage.center) largest = std::max(largest, std::abs(x));
  const double rounding = static_cast<double>(2 * D * cages.size()) * 0x1p-51 * largest + 0x1p-1060;
  for (std::size_t rest = cages.size() - 1; rest > 0; --rest) {
    for (std::size_t k = 0; k < rest; ++k) {
      for (std::size_t axis = 0; axis < D; ++axis)
        cages[k].center[axis] = (1 - u) * cages[k].center[axis] + u * cages[k + 1].center[axis];
      cages[k].radius = (1 - u) * cages[k].radius + u * cages[k + 1].radius;
    }
  }
  Sphere sphere = sphere_of(cages.front(), 0.0);
  sphere.radius += rounding;
  return sphere;
}

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

// A ball or cage at one time, with its radius last.
template <int Dimension>
using ExactBall = std::array<Rational, static_cast<std::size_t>(Dimension) + 1>;

// Evaluates the Bernstein form with these control points at u by de Casteljau's algorithm.
Rational blended(std::vector<Rational> points, const Rational& u) {
  for (std::size_t left = points.size(); left > 1; --left)
    for (std::size_t k = 0; k + 1 < left; ++k) points[k] += u * (points[k + 1] - points[k]);
  return points.front();
}

// Returns the node and bead of the first ball that sticks out of a cage at the k-th control point, or none,
// in exact arithmetic. A cage whose radius has overflowed holds all balls.
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

// Does the check at time `time` for cages blended from the cages of all control points. `cages[k]` are those
// of control point k.
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

}  // namespace

template <class Hierarchy>
Sphere ChordHierarchy<Hierarchy>::sphere_at(NodeId node, double u) const {
  std::vector<Cage<dimension>> cages;
  if constexpr (!is_layered<Hierarchy>) {
    if (tight_) {
      for (const CagePiece<dimension>& part : tight_->parts(node)) {
        if (u <= part.to) return blended(part.cages, (u - part.from) / (part.to - part.from));
      }
    }
  }
  for (int k = 0; k <= cages_.degree(); ++k) cages.push_back(cages_.cages(k)[node]);
  return blended(std::move(cages), u);
}

template <class Hierarchy>
ChordHierarchy<Hierarchy>::ChordHierarchy(Simulator& simulator, const MotionRef<dimension>& motion,
                                          std::span<const BeadRange> necklaces,
                                          std::optional<double> tightness)
    : motion_(accepted(motion)), cages_(necklaces, motion.degree(), tightness.has_value()) {
  if (tightness) {
    if (is_layered<Hierarchy>) throw std::invalid_argument("layered spheres cannot be proved tight");
    tight_.emplace(*tightness);
  }
  (void)simulator.add(*this);
}

template <class Hierarchy>
std::span<const EventKind> ChordHierarchy<Hierarchy>::kinds() const {
  static constexpr std::array<EventKind, 2> kinds{{{"bisection", false}, {"unproved", false}}};
  return tight_ ? std::span<const EventKind>(kinds) : std::span<const EventKind>();
}

template <class Hierarchy>
std::string_view ChordHierarchy<Hierarchy>::name() const {
  return is_layered<Hierarchy> ? "layered" : "wrapped";
}

template <class Hierarchy>
void ChordHierarchy<Hierarchy>::build() {
  cages_.build(motion_.curves());
}

template <class Hierarchy>
void ChordHierarchy<Hierarchy>::start_step() {
  cages_.move_to(motion_.curves());
  if constexpr (!is_layered<Hierarchy>) {
    if (!tight_) return;
    tight_->prove(cages_, motion_.curves());
    statistics.events_by_kind[bisection] += tight_->bisections();
    statistics.events_by_kind[unproved] += tight_->unproved();
  }
}

template <class Hierarchy>
void ChordHierarchy<Hierarchy>::apply(const Change&) {
  throw std::invalid_argument("chord cages have no events");
}

template <class Hierarchy>
std::optional<std::string> ChordHierarchy<Hierarchy>::audit(const Dyadic& time) {
  const FloatingPointScope to_nearest;
  const Curves<dimension> curves = motion_.curves();
  const bool at_start = time == Dyadic(0.0), at_end = time == Dyadic(1.0);
  if (at_start || at_end) {
    if (auto fault = not_as_built(cages_, curves, time)) return fault;
    for (int k = 0; k <= (at_start ? 0 : cages_.degree()); ++k)
      if (auto fault = ball_outside(cages_.tree(), cages_.cages(k), curves, k)) return fault;
    return std::nullopt;
  }
  std::vector<OutwardCages<dimension>> all;
  for (int k = 0; k <= cages_.degree(); ++k) all.push_back(cages_.cages(k));
  return ball_outside_at<dimension>(cages_.tree(), all, curves, time);
}

template class ChordHierarchy<StaticWrappedHierarchy<2>>;
template class ChordHierarchy<StaticWrappedHierarchy<3>>;
template class ChordHierarchy<LayeredHierarchy<2>>;
template class ChordHierarchy<LayeredHierarchy<3>>;

}  // namespace kds
