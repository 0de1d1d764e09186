#pragma once
// Checks triangulations and enclosing spheres by their definitions, from exact positions: all beads against
// all cells. The checks use nothing of certificates/ or structures/.

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "motions/curves/positions.h"
#include "tests/support/text_of.h"

namespace kds::test {

/// Coordinates, followed by the weight.
using ExactPoint = std::array<Rational, 4>;

template <Motion M>
std::vector<ExactPoint> exact_points(const M& motion, const Dyadic& time) {
  std::vector<ExactPoint> points;
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    const auto position = exact_position(motion, b, time);
    points.push_back({position[0], position[1], position[2], position[3]});
  }
  return points;
}

namespace detail {

using Row = std::array<Integer, 4>;

inline Integer det2(const Integer& a, const Integer& b, const Integer& c, const Integer& d) {
  return a * d - b * c;
}
inline Integer det3(const Row& a, const Row& b, const Row& c) {
  return a[0] * det2(b[1], b[2], c[1], c[2]) - a[1] * det2(b[0], b[2], c[0], c[2]) +
         a[2] * det2(b[0], b[1], c[0], c[1]);
}
inline Integer det4(const Row& a, const Row& b, const Row& c, const Row& d) {
  return -a[3] * det3(b, c, d) + b[3] * det3(a, c, d) - c[3] * det3(a, b, d) + d[3] * det3(a, b, c);
}

/// Scales to whole numbers: coordinates times the common denominator, weights times its square.
inline std::vector<Row> whole(std::span<const ExactPoint> points) {
  Integer common = 1;
  for (const ExactPoint& p : points) {
    for (const Rational& x : p) common = lcm(common, Integer(denominator(x)));
  }
  std::vector<Row> rows;
  for (const ExactPoint& p : points) {
    Row row;
    for (std::size_t i = 0; i < 4; ++i)
      row[i] = Integer(numerator(Rational(p[i] * (i < 3 ? common : common * common))));
    rows.push_back(row);
  }
  return rows;
}

inline Row difference(const Row& a, const Row& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2], 0}; }
inline Row lifted(const Row& a, const Row& b) {
  Row row = difference(a, b);
  row[3] = row[0] * row[0] + row[1] * row[1] + row[2] * row[2] - (a[3] - b[3]);
  return row;
}

}  // namespace detail

/// Explains why these finite cells (the beads of each ascend) are not a regular triangulation of the points;
/// returns nothing if they are. In degenerate position every regular triangulation is accepted. A bead may
/// lack a cell only if another bead has the same position.
inline std::optional<std::string> not_regular(std::span<const ExactPoint> points,
                                              std::span<const std::array<BeadId, 4>> cells) {
  const auto p = detail::whole(points);
  const auto name = [](std::span<const BeadId> beads) {
    std::string text;
    for (const BeadId b : beads) text += text_of(' ', b);
    return text;
  };
  std::map<std::array<BeadId, 3>, std::vector<BeadId>> facets;
  std::vector<char> used(p.size(), 0);
  if (std::set<std::array<BeadId, 4>>(cells.begin(), cells.end()).size() != cells.size())
    return "a cell stands twice";
  for (const auto& cell : cells) {
    const auto& [a, b, c, d] = cell;
    const int orientation = sgn(detail::det3(detail::difference(p[b], p[a]), detail::difference(p[c], p[a]),
                                             detail::difference(p[d], p[a])));
    if (orientation == 0) return text_of("cell ", name(cell), " is flat");
    for (const BeadId v : cell) used[v] = 1;
    for (BeadId t = 0; t < p.size(); ++t) {
      if (std::find(cell.begin(), cell.end(), t) != cell.end()) continue;
      const int side = sgn(detail::det4(detail::lifted(p[b], p[a]), detail::lifted(p[c], p[a]),
                                        detail::lifted(p[d], p[a]), detail::lifted(p[t], p[a])));
      if (side * orientation < 0) return text_of("bead ", t, " is inside the sphere of ", name(cell));
    }
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<BeadId, 3> facet{};
      for (std::size_t j = 0, k = 0; j < 4; ++j) {
        if (j != i) facet[k++] = cell[j];
      }
      facets[facet].push_back(cell[i]);
    }
  }
  for (const auto& [facet, apices] : facets) {
    const auto side = [&, &f = facet](BeadId t) {
      return sgn(detail::det3(detail::difference(p[f[1]], p[f[0]]), detail::difference(p[f[2]], p[f[0]]),
                              detail::difference(p[t], p[f[0]])));
    };
    if (apices.size() > 2) return text_of("facet ", name(facet), " has more than two cells");
    if (apices.size() == 2) {
      if (side(apices[0]) * side(apices[1]) >= 0)
        return text_of("the cells of facet ", name(facet), " overlap");
      continue;
    }
    for (BeadId t = 0; t < p.size(); ++t) {
      if (side(t) * side(apices[0]) < 0) return text_of("bead ", t, " lies beyond the hull at ", name(facet));
    }
  }
  for (BeadId t = 0; t < p.size(); ++t) {
    if (used[t] != 0) continue;
    bool shared = false;
    for (BeadId other = 0; other < p.size(); ++other) shared |= used[other] != 0 && p[other] == p[t];
    if (!shared && !cells.empty()) return text_of("bead ", t, " has no cell");
  }
  return std::nullopt;
}

struct ExactSphere {
  std::array<Rational, 3> center;
  Rational square;  ///< square of the radius
};

/// Returns the smallest sphere through some points, and the barycentric coordinates of its centre. Returns
/// nothing if the points are affinely dependent.
inline std::optional<std::pair<ExactSphere, std::vector<Rational>>> sphere_through(
    std::span<const ExactPoint> points, std::span<const BeadId> basis) {
  const std::size_t m = basis.size() - 1;
  std::vector<std::array<Rational, 3>> d(m);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      d[i][axis] = points[basis[i + 1]][axis] - points[basis[0]][axis];
  }
  const auto dot = [](const auto& a, const auto& b) {
    return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  };
  // Gaussian elimination on G y = diag(G) / 2.
  std::vector<std::vector<Rational>> g(m, std::vector<Rational>(m + 1));
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < m; ++j) g[i][j] = dot(d[i], d[j]);
    g[i][m] = dot(d[i], d[i]) / 2;
  }
  for (std::size_t k = 0; k < m; ++k) {
    // G is positive semidefinite, so a zero pivot means dependent points.
    if (g[k][k] == 0) return std::nullopt;
    for (std::size_t i = 0; i < m; ++i) {
      if (i == k) continue;
      const Rational factor = g[i][k] / g[k][k];
      for (std::size_t j = k; j <= m; ++j) g[i][j] -= factor * g[k][j];
    }
  }
  std::vector<Rational> weights{1};
  ExactSphere sphere;
  std::array<Rational, 3> z;
  for (std::size_t i = 0; i < m; ++i) {
    weights.push_back(g[i][m] / g[i][i]);
    weights[0] -= weights.back();
    for (std::size_t axis = 0; axis < 3; ++axis) z[axis] += weights.back() * d[i][axis];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) sphere.center[axis] = points[basis[0]][axis] + z[axis];
  sphere.square = dot(z, z);
  return std::pair(sphere, weights);
}

/// Explains why the basis' sphere is not the smallest sphere around beads first..last; returns nothing if it
/// is. With `strict`, a superfluous bead in the basis is a fault too.
inline std::optional<std::string> not_smallest_sphere(std::span<const ExactPoint> points, BeadId first,
                                                      BeadId last, std::span<const BeadId> basis,
                                                      bool strict) {
  if (basis.empty()) return "no basis";
  for (const BeadId b : basis) {
    if (b < first || b > last) return text_of("basis bead ", b, " is not of the node");
  }
  const auto found = sphere_through(points, basis);
  if (!found) return "the basis is dependent";
  const auto& [sphere, weights] = *found;
  for (const Rational& w : weights) {
    if (w < 0 || (strict && w == 0)) return "the centre is not inside the basis";
  }
  for (BeadId b = first; b <= last; ++b) {
    Rational square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Rational along = points[b][axis] - sphere.center[axis];
      square += along * along;
    }
    if (square > sphere.square) return text_of("bead ", b, " sticks out");
  }
  return std::nullopt;
}

}  // namespace kds::test
