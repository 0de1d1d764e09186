#include "experiments/collide/family_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kds/seconds.h"
#include "motions/models/shapes.h"
#include "structures/collision/hierarchy_search.h"

namespace kds {

namespace {

// Rows, and a bead beside each but the last that joins it to the next.
std::size_t beads_of_grid(int dimension, std::size_t side) {
  const std::size_t rows = dimension == 2 ? side : side * side;
  return rows * side + rows - 1;
}

template <int Dimension>
void measure(FamilySize& size, double gap) {
  const Eigen::Matrix3Xd centers = models::packed_grid(size.beads, Dimension, gap);
  const Balls<Dimension> balls(centers, std::vector<double>(size.beads, models::radius));
  const PairsAsked asked{{{0, static_cast<BeadId>(size.beads - 1)}}, true, 2, true};
  SphereTree<Dimension> tree(size.hierarchy, asked.necklaces);
  size.build_seconds = seconds_of([&] { tree.build(balls); }).clock;
  size.seconds = seconds_of([&] { size.family = find_pairs(tree, asked).family; }).clock;
}

// Student's t: an interval this many standard errors to either side holds 95 percent, by degrees of freedom.
double student_95(std::size_t freedom) {
  constexpr std::array<double, 30> table{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                         2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
                                         2.110,  2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064,
                                         2.060,  2.056, 2.052, 2.048, 2.045, 2.042};
  return table[std::min(freedom, table.size()) - 1];
}

}  // namespace

double FamilySize::bound() const {
  const auto n = static_cast<double>(beads);
  return dimension == 2 ? n * std::log2(n) : std::pow(n, 4.0 / 3);
}

FamilySize measure_family(int dimension, Hierarchy hierarchy, std::size_t side, double gap) {
  FamilySize size{dimension, hierarchy, side, beads_of_grid(dimension, side)};
  if (dimension == 2) {
    measure<2>(size, gap);
  } else {
    measure<3>(size, gap);
  }
  return size;
}

std::vector<std::size_t> sides_of_grids(int dimension, std::size_t most_beads) {
  constexpr std::size_t least_beads = 1000;
  const double factor = dimension == 2 ? 1.34 : 1.22;  // n grows by about 1.8
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

std::optional<FittedExponent> fit_exponent(std::span<const FamilySize> sizes) {
  if (sizes.size() < 3) return std::nullopt;
  const bool plane = sizes.front().dimension == 2;
  const auto count = static_cast<double>(sizes.size());
  std::vector<double> x, y;
  for (const FamilySize& size : sizes) {
    x.push_back(std::log2(static_cast<double>(size.beads)));
    y.push_back(std::log2(static_cast<double>(size.family)) - (plane ? std::log2(x.back()) : 0));
  }
  double mean_x = 0, mean_y = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mean_x += x[k] / count;
    mean_y += y[k] / count;
  }
  double spread = 0, together = 0, left = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    spread += (x[k] - mean_x) * (x[k] - mean_x);
    together += (x[k] - mean_x) * (y[k] - mean_y);
  }
  const double slope = together / spread;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double off = y[k] - mean_y - slope * (x[k] - mean_x);
    left += off * off;
  }
  const std::size_t freedom = sizes.size() - 2;
  const double error = student_95(freedom) * std::sqrt(left / static_cast<double>(freedom) / spread);
  return FittedExponent{sizes.front().dimension, sizes.front().hierarchy, sizes.size(),       slope,
                        slope - error,           slope + error,           plane ? 1 : 4.0 / 3};
}

}  // namespace kds
