#include "tests/laws/exact_balls.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace kds::test {

using Integer = second::Integer;
using Rational = second::Rational;

Beads box_of(const ExactBalls& balls, const Beads& present) {
  const auto& at = balls.centers;
  Beads ends;
  for (std::size_t axis = 0; axis < balls.dimension(); ++axis) {
    for (const bool high : {false, true}) {
      BeadId end = no_bead;
      for (const BeadId b : present)
        if (end == no_bead || (high ? at[b][axis] > at[end][axis] : at[b][axis] < at[end][axis])) end = b;
      ends.push_back(end);
    }
  }
  return ends;
}

namespace {

using Shift = std::vector<Integer>;

/// Returns all sums of up to six vectors of the cell, along each of them. Without a cell, returns zero.
std::vector<Shift> shifts_of(const ExactBalls& balls) {
  constexpr int most = 6;
  std::vector<Shift> shifts{Shift(balls.dimension(), 0)};
  for (const Shift& vector : balls.cell) {
    const std::vector<Shift> before = std::exchange(shifts, {});
    for (const Shift& shift : before)
      for (int multiple = -most; multiple <= most; ++multiple) {
        if (multiple != 0 && std::ranges::count(vector, Integer(0)) == std::ssize(vector)) continue;
        Shift& more = shifts.emplace_back(shift);
        for (std::size_t axis = 0; axis < vector.size(); ++axis) more[axis] += multiple * vector[axis];
      }
  }
  return shifts;
}

/// Returns the square of the distance of an image, or a number that is at least `enough` if the square is.
Integer square_up_to(const ExactBalls& balls, BeadId a, BeadId b, const Shift& shift,
                     const std::optional<Integer>& enough) {
  Integer square = 0;
  for (std::size_t axis = 0; axis < shift.size() && (!enough || square < *enough); ++axis) {
    const Integer along = balls.centers[b][axis] + shift[axis] - balls.centers[a][axis];
    square += along * along;
  }
  return square;
}

}  // namespace

Beads closest_of(const ExactBalls& balls, const Beads& present) {
  const std::vector<Shift> shifts = shifts_of(balls);
  Beads closest;
  std::optional<Integer> least;
  for (const BeadId a : present) {
    for (const BeadId b : present) {
      if (a >= b) continue;
      for (const Shift& shift : shifts) {
        const Integer square = square_up_to(balls, a, b, shift, least);
        if (least && *least <= square) continue;
        closest = {a, b};
        least = square;
      }
    }
  }
  return closest;
}

Beads hull_of(const ExactBalls& balls, const Beads& present) {
  if (present.empty()) return {};
  const auto& at = balls.centers;
  const auto first =
      *std::min_element(present.begin(), present.end(), [&](BeadId a, BeadId b) { return at[a] < at[b]; });
  Beads corners;
  BeadId last = first;
  do {
    corners.push_back(last);
    BeadId next = last;
    for (const BeadId b : present) {
      if (at[b] == at[last]) continue;
      const Integer turn = next == last ? Integer(-1)
                                        : (at[next][0] - at[last][0]) * (at[b][1] - at[last][1]) -
                                              (at[next][1] - at[last][1]) * (at[b][0] - at[last][0]);
      const bool is_between = turn == 0 && (at[next] < at[last] ? at[b] < at[next] : at[next] < at[b]);
      if (turn < 0 || is_between) next = b;  // the farthest of collinear beads
    }
    last = next;
  } while (at[last] != at[first]);
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

Beads supports_of(const ExactBalls& balls, const Beads& present, const std::vector<BeadRange>& nodes,
                  std::span<const SlabDirection> directions) {
  Beads supports;
  for (const BeadRange& node : nodes) {
    for (std::size_t side = 0; side < 2 * directions.size(); ++side) {
      const SlabDirection& direction = directions[side / 2];
      BeadId support = no_bead;
      for (const BeadId b : present) {
        if (b < node.first || node.last < b) continue;
        if (support == no_bead) {
          support = b;
          continue;
        }
        Integer along = 0;
        for (std::size_t axis = 0; axis < balls.dimension(); ++axis)
          along += (side % 2 == 0 ? -1 : 1) * direction.steps[axis] *
                   (balls.centers[b][axis] - balls.centers[support][axis]);
        const Integer larger = balls.radii[b] - balls.radii[support];
        const Integer of_radii = direction.square() * larger * larger;
        const bool is_further =
            larger >= 0 ? along > 0 || along * along < of_radii : along > 0 && along * along > of_radii;
        if (is_further) support = b;
      }
      supports.push_back(support);
    }
  }
  return supports;
}

Beads contacts_of(const ExactBalls& balls, const Beads& present, const PairsAsked& asked) {
  const std::vector<Shift> shifts = shifts_of(balls);
  Beads pairs;
  for (const BeadId a : present) {
    for (const BeadId b : present) {
      if (a >= b || !asked.asks({a, b})) continue;
      const Integer reach = balls.radii[a] + balls.radii[b];
      const Integer enough = reach * reach + 1;
      if (std::ranges::any_of(
              shifts, [&](const Shift& shift) { return square_up_to(balls, a, b, shift, enough) < enough; }))
        pairs.insert(pairs.end(), {a, b});
    }
  }
  return pairs;
}

std::optional<std::string> not_sorted(const ExactBalls& balls, const Beads& present, const Beads& order) {
  Beads ascending = order;
  std::sort(ascending.begin(), ascending.end());
  if (ascending != present) return "the list does not have each bead once";
  for (std::size_t i = 1; i < order.size(); ++i)
    if (balls.centers[order[i - 1]][0] > balls.centers[order[i]][0])
      return fmt::format("bead {} lies behind bead {}", order[i - 1], order[i]);
  return std::nullopt;
}

namespace {

/// Returns the sign of a determinant, by Bareiss' elimination.
int sign_of_determinant(std::vector<std::vector<Integer>> rows) {
  const std::size_t n = rows.size();
  int sign = 1;
  Integer before = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    while (pivot < n && rows[pivot][k] == 0) ++pivot;
    if (pivot == n) return 0;
    if (pivot != k) {
      std::swap(rows[pivot], rows[k]);
      sign = -sign;
    }
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = k + 1; j < n; ++j)
        rows[i][j] = (rows[i][j] * rows[k][k] - rows[i][k] * rows[k][j]) / before;
    before = rows[k][k];
  }
  return before > 0 ? sign : -sign;
}

/// Returns a row for each bead after the first, relative to the first: coordinates, then, if `lifted`,
/// squared length minus weight.
std::vector<std::vector<Integer>> rows_of(const ExactBalls& balls, const Beads& beads, bool lifted) {
  std::vector<std::vector<Integer>> rows;
  const auto& origin = balls.centers[beads.front()];
  for (std::size_t i = 1; i < beads.size(); ++i) {
    auto& row = rows.emplace_back();
    Integer height = balls.weights[beads.front()] - balls.weights[beads[i]];
    for (std::size_t axis = 0; axis < origin.size(); ++axis) {
      row.push_back(balls.centers[beads[i]][axis] - origin[axis]);
      height += row.back() * row.back();
    }
    if (lifted) row.push_back(height);
  }
  return rows;
}

/// Returns the sign of the orientation of dimension + 1 beads.
int orientation(const ExactBalls& balls, const Beads& beads) {
  return sign_of_determinant(rows_of(balls, beads, false));
}
Beads with(Beads beads, BeadId more) {
  beads.push_back(more);
  return beads;
}

}  // namespace

namespace {

/// Explains which centres, one more than the dimension, do not lie in one line or plane.
std::optional<std::string> not_flat(const ExactBalls& balls, const Beads& present) {
  const std::size_t corners = balls.centers[0].size() + 1;
  if (present.size() < corners) return std::nullopt;
  std::vector<bool> chosen(present.size(), false);
  std::fill_n(chosen.begin(), corners, true);
  do {
    Beads simplex;
    for (std::size_t i = 0; i < present.size(); ++i)
      if (chosen[i]) simplex.push_back(present[i]);
    if (orientation(balls, simplex) != 0) return fmt::format("no cells, but {} are not flat", simplex);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return std::nullopt;
}

}  // namespace

std::optional<std::string> not_regular(const ExactBalls& balls, const Beads& present,
                                       const std::vector<Beads>& cells) {
  std::map<Beads, Beads> apices;  // of each facet
  Beads used;
  for (const Beads& cell : cells) {
    const int side = orientation(balls, cell);
    if (side == 0) return fmt::format("cell {} is flat", cell);
    for (const BeadId b : present) {
      if (std::find(cell.begin(), cell.end(), b) != cell.end()) continue;
      if (side * sign_of_determinant(rows_of(balls, with(cell, b), true)) < 0)
        return fmt::format("bead {} is inside the power sphere of cell {}", b, cell);
    }
    for (const BeadId apex : cell) {
      Beads facet;
      std::copy_if(cell.begin(), cell.end(), std::back_inserter(facet), [&](BeadId b) { return b != apex; });
      apices[facet].push_back(apex);
      used.push_back(apex);
    }
  }
  for (const auto& [facet, beside] : apices) {
    const int side = orientation(balls, with(facet, beside[0]));
    if (beside.size() > 2) return fmt::format("facet {} has more than two cells", facet);
    if (beside.size() == 2) {
      if (side * orientation(balls, with(facet, beside[1])) >= 0)
        return fmt::format("the cells of facet {} overlap", facet);
      continue;
    }
    for (const BeadId b : present)
      if (side * orientation(balls, with(facet, b)) < 0)
        return fmt::format("bead {} lies beyond the hull at facet {}", b, facet);
  }
  if (cells.empty()) return not_flat(balls, present);
  // A bead without a cell must be hidden, so some cell must contain it. The loop above has shown that its
  // power test there is not negative.
  for (const BeadId b : present) {
    if (std::find(used.begin(), used.end(), b) != used.end()) continue;
    const bool housed = std::any_of(cells.begin(), cells.end(), [&](const Beads& cell) {
      const int side = orientation(balls, cell);
      for (std::size_t i = 0; i < cell.size(); ++i) {
        Beads moved = cell;
        moved[i] = b;
        if (side * orientation(balls, moved) < 0) return false;
      }
      return true;
    });
    if (!housed) return fmt::format("bead {} is in no cell", b);
  }
  return std::nullopt;
}

namespace {

/// The smallest sphere orthogonal to the balls of a simplex.
struct OrthogonalSphere {
  std::vector<Rational> center;
  Rational square;  ///< of its radius; negative if the balls have a common interior point
};

/// Solves the linear equations of the centre by elimination. Returns nothing if the beads are dependent.
std::optional<OrthogonalSphere> orthogonal_sphere(const ExactBalls& balls, const Beads& simplex) {
  const std::size_t m = simplex.size() - 1, dimension = balls.dimension();
  const auto& origin = balls.centers[simplex[0]];
  std::vector<std::vector<Rational>> edges(m, std::vector<Rational>(dimension)), g = edges;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t axis = 0; axis < dimension; ++axis)
      edges[i][axis] = balls.centers[simplex[i + 1]][axis] - origin[axis];
  for (std::size_t i = 0; i < m; ++i) {
    g[i].assign(m + 1, 0);
    for (std::size_t j = 0; j < m; ++j)
      g[i][j] = std::inner_product(edges[i].begin(), edges[i].end(), edges[j].begin(), Rational(0));
    g[i][m] = (g[i][i] - balls.weights[simplex[i + 1]] + balls.weights[simplex[0]]) / 2;
  }
  for (std::size_t k = 0; k < m; ++k) {
    if (g[k][k] == 0) return std::nullopt;  // G is positive semidefinite
    for (std::size_t i = 0; i < m; ++i) {
      if (i == k) continue;
      const Rational factor = g[i][k] / g[k][k];
      for (std::size_t j = k; j <= m; ++j) g[i][j] -= factor * g[k][j];
    }
  }
  OrthogonalSphere sphere{std::vector<Rational>(origin.begin(), origin.end()),
                          -Rational(balls.weights[simplex[0]])};
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    Rational along = 0;
    for (std::size_t i = 0; i < m; ++i) along += g[i][m] / g[i][i] * edges[i][axis];
    sphere.center[axis] += along;
    sphere.square += along * along;
  }
  return sphere;
}

}  // namespace

std::optional<std::string> not_dual(const ExactBalls& balls, const Beads& present,
                                    const std::vector<Beads>& cells, const std::vector<Beads>& simplices) {
  std::map<Beads, bool> belongs;  // of all simplices of the triangulation; known faces are true already
  for (const Beads& cell : cells)
    for (unsigned faces = 1; faces < 1U << cell.size(); ++faces) {
      Beads face;
      for (std::size_t i = 0; i < cell.size(); ++i)
        if ((faces >> i & 1U) != 0) face.push_back(cell[i]);
      belongs[face] = false;
    }
  const auto mark_facets = [&](const Beads& simplex) {
    for (const BeadId off : simplex) {
      Beads facet = simplex;
      std::erase(facet, off);
      if (!facet.empty()) belongs[facet] = true;
    }
  };
  for (std::size_t size = balls.dimension() + 1; size > 0; --size)
    for (auto& [simplex, is_in] : belongs) {
      if (simplex.size() != size) continue;
      if (is_in) {
        mark_facets(simplex);
        continue;
      }
      const auto sphere = orthogonal_sphere(balls, simplex);
      if (!sphere) return fmt::format("the beads of simplex {} are dependent", simplex);
      if (sphere->square > 0) continue;
      const bool is_attached = std::any_of(present.begin(), present.end(), [&](BeadId b) {
        if (std::find(simplex.begin(), simplex.end(), b) != simplex.end()) return false;
        Rational power = -Rational(balls.weights[b]);
        for (std::size_t axis = 0; axis < balls.dimension(); ++axis) {
          const Rational along = sphere->center[axis] - balls.centers[b][axis];
          power += along * along;
        }
        return power < sphere->square;
      });
      is_in = !is_attached;
      if (is_in) mark_facets(simplex);
    }
  std::vector<Beads> expected;
  for (const auto& [simplex, is_in] : belongs)
    if (is_in) expected.push_back(simplex);
  std::vector<Beads> found = simplices;
  std::sort(found.begin(), found.end());
  if (found == expected) return std::nullopt;
  return fmt::format("the complex has the simplices {}, brute force finds {}", found, expected);
}

std::array<std::int64_t, 3> betti_by_ranks(const std::vector<Beads>& simplices) {
  std::array<std::int64_t, 5> count{}, rank{};  // of simplices, and of their boundaries, by number of beads
  std::map<Beads, std::set<Beads>> columns;     // reduced boundaries, by their last facet
  for (const Beads& simplex : simplices) {
    ++count[simplex.size()];
    std::set<Beads> boundary;
    for (std::size_t i = 0; i < simplex.size() && simplex.size() > 1; ++i) {
      Beads facet = simplex;
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(i));
      boundary.insert(facet);
    }
    while (!boundary.empty()) {
      const auto [column, is_new] = columns.emplace(*boundary.rbegin(), boundary);
      if (is_new) {
        ++rank[simplex.size()];
        break;
      }
      std::set<Beads> sum;
      std::set_symmetric_difference(boundary.begin(), boundary.end(), column->second.begin(),
                                    column->second.end(), std::inserter(sum, sum.end()));
      boundary = std::move(sum);
    }
  }
  std::array<std::int64_t, 3> betti{};
  for (std::size_t size = 1; size <= 3; ++size) betti[size - 1] = count[size] - rank[size] - rank[size + 1];
  return betti;
}

std::optional<std::string> not_smallest(const ExactBalls& balls, const BeadRange& node, const Beads& basis) {
  if (basis.empty()) return "no basis";
  for (const BeadId b : basis)
    if (b < node.first || node.last < b) return fmt::format("basis bead {} is not of the node", b);
  // The centre is a combination of the basis with weights w, where G w = diag(G) / 2 for Gram matrix G.
  const std::size_t m = basis.size() - 1;
  const auto& origin = balls.centers[basis[0]];
  const auto rows = rows_of(balls, basis, false);
  const auto dot = [](const auto& a, const auto& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), Integer(0));
  };
  std::vector<std::vector<Rational>> g(m, std::vector<Rational>(m + 1));
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < m; ++j) g[i][j] = dot(rows[i], rows[j]);
    g[i][m] = g[i][i] / 2;
  }
  for (std::size_t k = 0; k < m; ++k) {
    if (g[k][k] == 0) return "the basis is dependent";  // G is positive semidefinite
    for (std::size_t i = 0; i < m; ++i) {
      if (i == k) continue;
      const Rational factor = g[i][k] / g[k][k];
      for (std::size_t j = k; j <= m; ++j) g[i][j] -= factor * g[k][j];
    }
  }
  Rational first = 1;
  std::vector<Rational> center(origin.size());  // relative to the first basis bead
  for (std::size_t i = 0; i < m; ++i) {
    const Rational weight = g[i][m] / g[i][i];
    if (weight < 0) return "the centre is not inside the basis";
    first -= weight;
    for (std::size_t axis = 0; axis < center.size(); ++axis) center[axis] += weight * rows[i][axis];
  }
  if (first < 0) return "the centre is not inside the basis";
  const auto square = [&](BeadId b) {
    Rational sum = 0;
    for (std::size_t axis = 0; axis < center.size(); ++axis) {
      const Rational along = balls.centers[b][axis] - origin[axis] - center[axis];
      sum += along * along;
    }
    return sum;
  };
  const Rational radius = square(basis[0]);
  for (BeadId b = node.first; b <= node.last; ++b)
    if (square(b) > radius) return fmt::format("bead {} of node {}-{} sticks out", b, node.first, node.last);
  return std::nullopt;
}

}  // namespace kds::test
