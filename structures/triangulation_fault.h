#pragma once
// Whether a triangulation is regular, by the definition and by exact signs alone: sound in degenerate
// positions, where several are right and comparing with a static build would not do.
//
// All beads are vertices, all finite cells positive, all facets regular, the hull's triangles have no bead
// outside. Then the triangles cover the hull's boundary equally often everywhere, and the cells its inside as
// often; once, if the centroid of one triangle lies in no other. (The cells close up: flips keep that.)

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certificates/coplanar.h"
#include "structures/bead_names.h"
#include "structures/facet_certificate.h"

namespace kds {

/// The finite facet of an infinite cell, counterclockwise seen from outside; none of a finite cell.
[[nodiscard]] inline std::optional<std::array<BeadId, 3>> hull_triangle(const CellBeads& v) {
  const auto place = std::find(v.begin(), v.end(), infinite_bead) - v.begin();
  if (place == 4) return std::nullopt;
  std::array<BeadId, 3> triangle{v[0], v[1], v[2]};
  if (place != 3) {
    triangle[static_cast<std::size_t>(place)] = v[3];
    std::swap(triangle[0], triangle[1]);  // one exchange made good by another
  }
  return triangle;
}

/// What is wrong with the triangulation of beads 0 ... beads-1 at one moment, or nothing. `sign` gives the
/// sign of a function of beads then; cells may be flat where `flat_cells` says so.
template <class Sign>
[[nodiscard]] std::optional<std::string> triangulation_fault(const RegularTriangulation& triangulation,
                                                             BeadId beads, bool flat_cells, Sign sign) {
  std::vector<std::array<BeadId, 3>> hull;
  std::vector<char> is_vertex(beads, 0);
  for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
    if (!triangulation.is_live(cell)) continue;
    const CellBeads& v = triangulation.cells()[cell].vertex;
    if (const auto triangle = hull_triangle(v)) {
      hull.push_back(*triangle);
    } else if (const int s = sign(Orientation(v, 1)); s < 0 || (s == 0 && !flat_cells)) {
      return "the cell of beads " + bead_names(v) + " is " + (s < 0 ? "inverted" : "flat");
    } else {
      for (const BeadId b : v) is_vertex[b] = 1;
    }
    for (int i = 0; i < 4; ++i) {
      const FacetId beyond = triangulation.beyond(cell, i);
      if (cell_of(beyond) < cell) continue;
      const BeadId apex = triangulation.apex(beyond);
      if (with_facet_certificate(v, apex, sign) < 0)
        return "the facet between the cell of beads " + bead_names(v) + " and bead " +
               bead_names(std::array{apex}) + " fails its test";
    }
  }
  for (BeadId bead = 0; bead < beads; ++bead) {
    if (is_vertex[bead] == 0) return "bead " + std::to_string(bead) + " has no cell";
  }
  for (const auto& [a, b, c] : hull) {
    for (BeadId bead = 0; bead < beads; ++bead) {
      if (bead != a && bead != b && bead != c && sign(Orientation({a, b, c, bead}, -1)) < 0)
        return "bead " + std::to_string(bead) + " is outside the hull's triangle " +
               bead_names(std::array{a, b, c});
    }
  }
  const auto flat = [&](const std::array<BeadId, 3>& t) {
    return sign(SameTurn{{t[0], t[1], t[2], t[0], t[1], t[2]}}) == 0;
  };
  const auto first = std::find_if_not(hull.begin(), hull.end(), flat);
  if (first == hull.end()) return std::nullopt;
  const auto& [a, b, c] = *first;
  const auto outside = [&](BeadId from, BeadId to) { return sign(CentroidLeftOf{{a, b, c, from, to}}) < 0; };
  const auto in_plane = [&](BeadId bead) {
    return bead == a || bead == b || bead == c || sign(Orientation({a, b, c, bead}, 1)) == 0;
  };
  for (auto other = first + 1; other != hull.end(); ++other) {
    const auto& [p, q, r] = *other;
    if (in_plane(p) && in_plane(q) && in_plane(r) && !flat(*other) && !outside(p, q) && !outside(q, r) &&
        !outside(r, p))
      return "the hull's triangles " + bead_names(*first) + " and " + bead_names(*other) + " overlap";
  }
  return std::nullopt;
}

}  // namespace kds
