#include "structures/hierarchy/layered_hierarchy.h"

#include <algorithm>
#include <cmath>

#include "motions/base/floating_point_scope.h"
#include "motions/numbers/lanes.h"
#include "structures/enclosing_sphere/cage.h"

namespace kds {

// Computes the smallest sphere around two spheres, with the radius rounded up. The stored sphere, whose
// centre and radius are doubles, holds both stored spheres.
//
// The bound. Let u = 2^-53, D the true distance of centres, w = r_b - r_a, |w| < D, and R half the sum D +
// r_a + r_b. If squares neither overflow nor underflow, the distance has a relative error below 4u and the
// ratio w/D one below 7u, so `share` has an error of 3.5u |w|/D plus u of itself. The centre's error is at
// most 3.5u |w| + 3u share D, which is at most 6.5u R since |w| and share D are at most R, plus u of its
// coordinates. Half the sum of distance and radii has an error of 5u R, and the radius is rounded twice more.
// The sum of these errors is less than 16u R plus u of the coordinates.
//
// One sphere is reported to lie in the other only if this is true in spite of rounding. If it nearly does,
// the centre is the larger sphere's up to the same error, and the radius is no smaller.

namespace {

// Computes four spheres at once. Requires sizes whose squares neither overflow nor underflow; lanes that are
// false in the result are not valid. If `equal`, radii must be equal; the code then needs no quotient and
// gives the same bits.
template <bool equal, int Dimension>
[[gnu::always_inline]] inline Lanes::Mask spheres_of_two(const FourBalls<Dimension>& a,
                                                         const FourBalls<Dimension>& b,
                                                         FourBalls<Dimension>& sphere) {
  const auto d = detail::minus(b.center, a.center);
  const Lanes square = detail::dot(d, d);
  const Lanes distance = NumberTraits<Lanes>::sqrt(square);
  const Lanes wider = b.radius - a.radius;
  // The centre lies on the line of centres, with both far ends on the sphere.
  Lanes share(0.5), reach = Lanes(0.5) * (distance + (a.radius + b.radius));
  if constexpr (!equal) {
    const Lanes middle = Lanes(0.5) * (Lanes(1.0) + wider / square * distance);
    share = Lanes::min(Lanes::max(middle, Lanes(0.0)), Lanes(1.0));
    reach = Lanes::max(reach, Lanes::max(a.radius, b.radius));
  }
  for (std::size_t axis = 0; axis < Dimension; ++axis) sphere.center[axis] = a.center[axis] + share * d[axis];
  Lanes size = abs(sphere.center[0]);
  for (std::size_t axis = 1; axis < Dimension; ++axis) size += abs(sphere.center[axis]);
  sphere.radius = reach * Lanes(1 + 0x1p-49) + Lanes(0x1p-51) * size;
  if constexpr (!equal) {
    const auto nested = distance * Lanes(1 + 0x1p-48) <= abs(wider);
    const auto is_b = wider > Lanes(0.0);
    const auto larger = [&](const Lanes& of_a, const Lanes& of_b, const Lanes& around)
        __attribute__((always_inline)) {
      return Lanes::choose(nested, Lanes::choose(is_b, of_b, of_a), around);
    };
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      sphere.center[axis] = larger(a.center[axis], b.center[axis], sphere.center[axis]);
    sphere.radius = larger(a.radius, b.radius, sphere.radius);
  }
  return (square >= Lanes(0x1p-900)) & (square <= Lanes(0x1p900)) & (abs(wider) >= Lanes(0.0));
}

// Computes one sphere for any sizes.
template <int Dimension>
Cage<Dimension> sphere_of_two(const Cage<Dimension>& a, const Cage<Dimension>& b) {
  const double distance = distance_rounded_up<Dimension>(a.center, b.center);
  const double wider = b.radius - a.radius;
  if (distance * (1 + 0x1p-48) <= std::abs(wider)) return wider > 0 ? b : a;
  if (!(std::abs(wider) >= 0)) return a;  // both radii have overflowed
  const double share = std::clamp(0.5 * (1 + wider / distance), 0.0, 1.0);
  Cage<Dimension> cage;
  for (std::size_t axis = 0; axis < Dimension; ++axis)
    cage.center[axis] = (1 - share) * a.center[axis] + share * b.center[axis];
  cage.radius = std::max(reach_rounded_up<Dimension>(cage.center, a.center, a.radius),
                         reach_rounded_up<Dimension>(cage.center, b.center, b.radius));
  return cage;
}

// Computes the spheres of nodes of one height.
template <bool equal, int Dimension, class Four>
void wrap(std::span<const Four> merges, const Cage<Dimension>* left_spheres,
          const Cage<Dimension>* right_spheres, Cage<Dimension>* cages) {
  using Balls = FourBalls<Dimension>;
  Lanes::Mask usual = ~Lanes::Mask{};
  for (const Four& four : merges) {
    Balls spheres;
    usual &= spheres_of_two<equal>(Balls(left_spheres, four.left), Balls(right_spheres, four.right), spheres);
    spheres.store(cages, four.node);
  }
  if (Lanes::all(usual)) return;
  for (const Four& four : merges) {
    Balls spheres;
    usual = spheres_of_two<equal>(Balls(left_spheres, four.left), Balls(right_spheres, four.right), spheres);
    for (std::size_t lane = 0; lane < Lanes::width; ++lane)
      if (usual[lane] == 0)
        cages[four.node[lane]] =
            sphere_of_two(left_spheres[four.left[lane]], right_spheres[four.right[lane]]);
  }
}

}  // namespace

template <int Dimension>
LayeredHierarchy<Dimension>::LayeredHierarchy(std::span<const BeadRange> necklaces)
    : tree_(necklaces), order_(tree_), cages_(tree_.node_count()) {
  for (const BottomUpOrder::Run& run : order_.runs()) {
    for (const BottomUpOrder::Group& group : order_.groups(run)) {
      Height& height = heights_.emplace_back();
      for (const NodeId node : order_.nodes(group)) {
        const NodeId left = tree_.left(node), right = tree_.right(node);
        const BeadRange& range = tree_.range(node);
        if (left == NecklaceTree::leaf) {  // the left half is the larger, so both are single beads
          height.of_beads.append(node, range.first, range.last);
        } else if (right == NecklaceTree::leaf) {
          height.of_both.append(node, left, range.last);
        } else {
          height.of_nodes.append(node, left, right);
        }
      }
    }
  }
}

template <int Dimension>
void LayeredHierarchy<Dimension>::Merges::append(NodeId node, std::uint32_t left, std::uint32_t right) {
  if (count_ % Lanes::width == 0) fours_.emplace_back();
  for (std::size_t lane = count_++ % Lanes::width; lane < Lanes::width; ++lane) {
    fours_.back().node[lane] = node;
    fours_.back().left[lane] = left;
    fours_.back().right[lane] = right;
  }
}

template <int Dimension>
void LayeredHierarchy<Dimension>::build(const BallRows<Dimension>& balls) {
  const FloatingPointScope to_nearest;
  const BallRow<Dimension>* const beads = balls.rows();
  Cage<Dimension>* const cages = cages_.data();
  using Four = typename Merges::Four;
  constexpr auto wrap_in_lanes = in_long_lanes<&wrap<false, Dimension, Four>>;
  const auto wrap_beads = balls.equal_radii() ? in_long_lanes<&wrap<true, Dimension, Four>> : wrap_in_lanes;
  for (const Height& height : heights_) {
    wrap_beads(height.of_beads.fours(), beads, beads, cages);
    wrap_in_lanes(height.of_both.fours(), cages, beads, cages);
    wrap_in_lanes(height.of_nodes.fours(), cages, cages, cages);
  }
}

template class LayeredHierarchy<2>;
template class LayeredHierarchy<3>;

}  // namespace kds
