#include "experiments/theorems/family_sizes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motions/models/shape.h"
#include "structures/collision/hierarchy_search.h"

namespace kds {

namespace {

template <int Dimension>
FamilySize measure(const Eigen::Matrix3Xd& centers, Hierarchy hierarchy, std::size_t rounds) {
  const auto beads = static_cast<std::size_t>(centers.cols());
  const Balls<Dimension> balls(centers, std::vector<double>(beads, models::radius));
  const PairsAsked asked{{{0, static_cast<BeadId>(beads - 1)}}, true, 2, true};
  SphereTree<Dimension> tree(hierarchy, asked.necklaces);
  tree.build(balls);
  FamilySize size;
  const auto search = [&] {
    return processor_seconds_of([&] { size.family = find_pairs(tree, asked).family; });
  };
  if (rounds == 0)
    search();
  else
    size.seconds = repeated_seconds(rounds, search, std::numeric_limits<double>::infinity());
  return size;
}

}  // namespace

FamilySize measure_family(const Eigen::Matrix3Xd& centers, int dimension, Hierarchy hierarchy,
                          std::size_t rounds) {
  return dimension == 2 ? measure<2>(centers, hierarchy, rounds) : measure<3>(centers, hierarchy, rounds);
}

std::size_t beads_of_grid(int dimension, std::size_t side) {
  const std::size_t rows = dimension == 2 ? side : side * side;
  return rows * side + rows - 1;
}

std::vector<std::size_t> sides_of_grids(int dimension, std::size_t most_beads) {
  constexpr std::size_t least_beads = 1000;
  const double factor = dimension == 2 ? 1.34 : 1.22;  // n grows by a factor of about 1.8
  std::vector<std::size_t> sides;
  std::size_t side = 3;
  while (beads_of_grid(dimension, side + 2) <= most_beads) side += 2;
  for (auto next = static_cast<double>(side); beads_of_grid(dimension, side) >= least_beads;) {
    sides.push_back(side);
    next /= factor;
    side = std::min(side - 2, 2 * static_cast<std::size_t>(next / 2) + 1);
  }
  std::reverse(sides.begin(), sides.end());
  return sides;
}

double family_bound(int dimension, std::size_t beads) {
  const auto n = static_cast<double>(beads);
  return dimension == 2 ? n * std::log2(n) : std::pow(n, 4.0 / 3);
}

}  // namespace kds
