#include "experiments/theorems/root_ratio.h"

#include <array>
#include <bit>

#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"

namespace kds {

namespace {

template <int Dimension>
double ratio(const Eigen::Matrix3Xd& centers, std::span<const double> radii) {
  const std::array necklaces{BeadRange{0, static_cast<BeadId>(radii.size() - 1)}};
  const Balls<Dimension> balls(centers, radii);
  StaticWrappedHierarchy<Dimension> wrapped(necklaces);
  LayeredHierarchy<Dimension> layered(necklaces);
  wrapped.build(balls);
  layered.build(balls);
  const double inner = wrapped.sphere(0).radius;
  return inner > 0 ? layered.sphere(0).radius / inner : 1;
}

}  // namespace

double root_ratio(const Eigen::Matrix3Xd& centers, std::span<const double> radii, int dimension) {
  return dimension == 2 ? ratio<2>(centers, radii) : ratio<3>(centers, radii);
}

std::size_t tree_height(std::size_t beads) { return static_cast<std::size_t>(std::bit_width(beads - 1)); }

}  // namespace kds
