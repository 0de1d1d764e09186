#include "motions/scene/near_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

namespace kds {

namespace {

using Visit = std::function<void(BeadId, BeadId)>;

void visit_in_order(const Visit& visit, BeadId a, BeadId b) { visit(std::min(a, b), std::max(a, b)); }

struct GridCell {
  std::int64_t x = 0, y = 0, z = 0;
  friend auto operator<=>(const GridCell&, const GridCell&) = default;
};

struct BeadInCell {
  GridCell cell;
  BeadId bead = 0;
};

// Returns the grid cell, of side 2^power, that contains a centre. Scaling by a power of two and rounding down
// are exact, so two points within 2^power of each other lie in the same cell or in neighbouring cells.
// Returns nothing if a number needs more than 52 bits.
std::optional<GridCell> cell_of(const Eigen::Matrix3Xd& centers, BeadId bead, int power) {
  std::array<std::int64_t, 3> cell{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double x = centers(axis, static_cast<Eigen::Index>(bead));
    double number = std::floor(std::ldexp(x, -power));
    if (x < 0 && number == 0) number = -1;  // underflow in scaling
    if (!(std::abs(number) < 0x1p52)) return std::nullopt;
    cell[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(number);
  }
  return GridCell{cell[0], cell[1], cell[2]};
}

std::optional<std::vector<BeadInCell>> sorted_entries(const Eigen::Matrix3Xd& centers,
                                                      const std::vector<BeadId>& beads, int power) {
  std::vector<BeadInCell> entries;
  entries.reserve(beads.size());
  for (const BeadId bead : beads) {
    const auto cell = cell_of(centers, bead, power);
    if (!cell) return std::nullopt;
    entries.push_back({*cell, bead});
  }
  std::sort(entries.begin(), entries.end(),
            [](const BeadInCell& a, const BeadInCell& b) { return a.cell < b.cell; });
  return entries;
}

// Visits the pairs of entries in neighbouring cells. Both lists are sorted, and so are the starts of the nine
// rows of three cells that a query examines: nine positions in `others` advance together. `once`: both lists
// are the same, so each pair occurs twice and is visited once.
void visit_neighbours(const std::vector<BeadInCell>& queries, const std::vector<BeadInCell>& others,
                      bool once, const Visit& visit) {
  std::array<std::size_t, 9> starts{};
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const GridCell& cell = queries[q].cell;
    for (std::size_t row = 0; row < 9; ++row) {
      const GridCell from{cell.x + static_cast<std::int64_t>(row / 3) - 1,
                          cell.y + static_cast<std::int64_t>(row % 3) - 1, cell.z - 1};
      std::size_t& start = starts[row];
      while (start < others.size() && others[start].cell < from) ++start;
      for (std::size_t o = once ? std::max(start, q + 1) : start; o < others.size(); ++o) {
        const GridCell& other = others[o].cell;
        if (other.x != from.x || other.y != from.y || other.z > cell.z + 1) break;
        visit_in_order(visit, queries[q].bead, others[o].bead);
      }
    }
  }
}

// Returns the exponent of the smallest power of two that is at least the diameter.
int power_of(double radius) {
  int power = 0;
  const double fraction = std::frexp(radius, &power);
  return fraction == 0.5 ? power : power + 1;
}

// Groups balls by the size of their cells, smallest first. Points (radius 0) meet only if they coincide, so
// any cells serve them.
std::map<int, std::vector<BeadId>> by_size(std::span<const double> radii) {
  std::map<int, std::vector<BeadId>> levels;
  std::vector<BeadId> points;
  for (BeadId bead = 0; bead < radii.size(); ++bead) {
    if (radii[bead] > 0) {
      levels[power_of(radii[bead])].push_back(bead);
    } else {
      points.push_back(bead);
    }
  }
  auto& smallest = levels.empty() ? levels[0] : levels.begin()->second;
  smallest.insert(smallest.end(), points.begin(), points.end());
  return levels;
}

bool visit_by_grids(const Eigen::Matrix3Xd& centers, const std::map<int, std::vector<BeadId>>& levels,
                    const Visit& visit) {
  for (const auto& [power, beads] : levels)  // sort everything before the first visit
    for (auto finer = levels.begin(); finer != levels.upper_bound(power); ++finer)
      for (const BeadId bead : finer->second)
        if (!cell_of(centers, bead, power)) return false;
  for (const auto& [power, beads] : levels) {
    const auto coarse = sorted_entries(centers, beads, power);
    visit_neighbours(*coarse, *coarse, true, visit);
    for (auto finer = levels.begin(); finer->first < power; ++finer)
      visit_neighbours(*sorted_entries(centers, finer->second, power), *coarse, false, visit);
  }
  return true;
}

void visit_by_sweep(const Eigen::Matrix3Xd& centers, std::span<const double> radii, const Visit& visit) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto lower = [&](BeadId bead) {
    return std::nextafter(centers(0, static_cast<Eigen::Index>(bead)) - radii[bead], -infinity);
  };
  const auto upper = [&](BeadId bead) {
    return std::nextafter(centers(0, static_cast<Eigen::Index>(bead)) + radii[bead], infinity);
  };
  std::vector<BeadId> order(radii.size());
  std::iota(order.begin(), order.end(), BeadId{0});
  std::sort(order.begin(), order.end(), [&](BeadId a, BeadId b) { return lower(a) < lower(b); });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && lower(order[j]) <= upper(order[i]); ++j)
      visit_in_order(visit, order[i], order[j]);
}

}  // namespace

void visit_near_pairs(const Eigen::Matrix3Xd& centers, std::span<const double> radii, const Visit& visit) {
  if (!visit_by_grids(centers, by_size(radii), visit)) visit_by_sweep(centers, radii, visit);
}

}  // namespace kds
