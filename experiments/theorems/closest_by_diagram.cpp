#include "experiments/theorems/closest_by_diagram.h"

#include <limits>
#include <vector>

#include "motions/models/shape.h"
#include "structures/collision/closest_pair.h"
#include "structures/collision/hierarchy_search.h"

namespace kds {

namespace {

template <int Dimension>
ClosestByDiagram measure(const Eigen::Matrix3Xd& centers, std::size_t rounds) {
  const auto beads = static_cast<std::size_t>(centers.cols());
  const std::vector<double> radii(beads, models::radius);
  const PairsAsked asked{{{0, static_cast<BeadId>(beads - 1)}}, true, 2, true};
  const BeadPairs neighbors = BeadPairs::along(beads, asked.necklaces);
  ClosestPairReport report;
  ClosestByDiagram result;
  result.seconds = repeated_seconds(
      rounds,
      [&] {
        return processor_seconds_of([&] { report = closest_pair<Dimension>(centers, radii, neighbors); });
      },
      std::numeric_limits<double>::infinity());
  const PairsLookedAt& pairs = report.looked_at;
  result.looked_at = pairs.edges + pairs.common_neighbors + pairs.unconnected + pairs.centers + pairs.near;

  const Balls<Dimension> balls(centers, radii);
  SphereTree<Dimension> tree(Hierarchy::wrapped, asked.necklaces);
  tree.build(balls);
  const auto by_search = find_closest_pair(tree, balls, asked);
  result.same = by_search && report.pair && by_search->first == report.pair->first &&
                by_search->second == report.pair->second;
  return result;
}

}  // namespace

ClosestByDiagram closest_by_diagram(const Eigen::Matrix3Xd& centers, int dimension, std::size_t rounds) {
  return dimension == 2 ? measure<2>(centers, rounds) : measure<3>(centers, rounds);
}

}  // namespace kds
