#pragma once
// Whether a triangulation is regular, by the definition and by exact signs alone: sound in degenerate
// positions, where several are right and comparing with a static build would not do.
//
// All beads are vertices or hidden, all finite cells positive, all facets regular, the hull's faces have no
// bead outside, and each hidden bead is in a cell and not inside its power sphere. Then its triangles cover
// the hull's boundary equally often everywhere, and the cells its inside as often; once, if the centroid of
// one triangle lies in no other. (The cells close up: flips keep that.)

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "certificates/types/coplanar.h"
#include "structures/necklace/bead_names.h"
#include "structures/triangulation/facet_certificate.h"
#include "structures/triangulation/hidden_beads.h"

namespace kds {

/// The finite facet of an infinite cell, positive seen from outside; none of a finite cell.
template <int Dimension>
[[nodiscard]] std::optional<std::array<BeadId, Dimension>> hull_face(const CellBeads<Dimension>& v) {
  const auto place = static_cast<std::size_t>(std::find(v.begin(), v.end(), infinite_bead) - v.begin());
  if (place > Dimension) return std::nullopt;
  std::array<BeadId, Dimension> face{};
  std::copy(v.begin(), v.end() - 1, face.begin());
  if (place != Dimension) {
    face[place] = v[Dimension];
    std::swap(face[0], face[1]);  // one exchange made good by another
  }
  return face;
}

template <int Dimension>
[[nodiscard]] SameTurn<Dimension> same_turn(const std::array<BeadId, Dimension>& a,
                                            const std::array<BeadId, Dimension>& b) {
  SameTurn<Dimension> turn;
  std::copy(b.begin(), b.end(), std::copy(a.begin(), a.end(), turn.beads.begin()));
  return turn;
}

namespace detail {

/// Whether the centroid of one face lies in another of the same plane (line; both edges run
/// the same way), or on its boundary.
template <int Dimension, class Sign>
[[nodiscard]] bool holds_centroid(const std::array<BeadId, Dimension>& of,
                                  const std::array<BeadId, Dimension>& face, Sign sign) {
  const auto inside = [&](auto... line) {
    CentroidInside<Dimension> f;
    const std::array ends{line...};
    std::copy(ends.begin(), ends.end(), std::copy(of.begin(), of.end(), f.beads.begin()));
    return sign(f);
  };
  if constexpr (Dimension == 2) {
    return inside(face[0]) >= 0 && inside(face[1]) <= 0;
  } else {
    return inside(face[0], face[1]) >= 0 && inside(face[1], face[2]) >= 0 && inside(face[2], face[0]) >= 0;
  }
}

/// Whether a bead is in its host, on the boundary perhaps, and not inside the host's power sphere. In a
/// regular triangulation it does not matter which of the cells it is in.
template <int Dimension, class Sign>
[[nodiscard]] bool hides(const RegularTriangulation<Dimension>& triangulation, const HiddenBead& hidden,
                         Sign sign) {
  const auto contains = [&](const CellBeads<Dimension>& v) {
    if (std::find(v.begin(), v.end(), infinite_bead) != v.end()) return false;
    for (std::size_t i = 0; i <= Dimension; ++i) {
      auto part = v;
      part[i] = hidden.bead;
      if (sign(Orientation<Dimension>(part, 1)) < 0) return false;
    }
    return true;
  };
  const auto hides_in = [&](CellId cell) {
    const CellBeads<Dimension>& v = triangulation.cells()[cell].vertex;
    return triangulation.is_live(cell) && contains(v) && with_facet_certificate(v, hidden.bead, sign) >= 0;
  };
  if (hidden.host != no_cell) return hides_in(hidden.host);
  for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
    if (hides_in(cell)) return true;
  }
  return false;
}

}  // namespace detail

/// What is wrong with the triangulation of beads 0 ... beads-1 at one moment, or nothing. `sign` gives the
/// sign of a function of beads then; cells may be flat where `flat_cells` says so. A hidden bead whose host
/// is not known may be in any cell. Beads marked in `absent` do not take part.
template <int Dimension, class Sign>
[[nodiscard]] std::optional<std::string> regularity_fault(
    const RegularTriangulation<Dimension>& triangulation, BeadId beads, std::span<const HiddenBead> hidden,
    bool flat_cells, Sign sign, std::span<const char> absent = {}) {
  const auto is_absent = [&](BeadId bead) { return bead < absent.size() && absent[bead] != 0; };
  using Face = std::array<BeadId, Dimension>;
  std::vector<Face> hull;
  std::vector<char> is_vertex(beads, 0);
  for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
    if (!triangulation.is_live(cell)) continue;
    const CellBeads<Dimension>& v = triangulation.cells()[cell].vertex;
    if (const auto face = hull_face<Dimension>(v)) {
      hull.push_back(*face);
    } else {
      const int s = sign(Orientation<Dimension>(v, 1));
      if (s < 0 || (s == 0 && !flat_cells))
        return "the cell of beads " + bead_names(v) + " is " + (s < 0 ? "inverted" : "flat");
      for (const BeadId b : v) is_vertex[b] = 1;
    }
    for (int i = 0; i <= Dimension; ++i) {
      const FacetId beyond = triangulation.beyond(cell, i);
      if (cell_of(beyond) < cell) continue;
      const BeadId apex = triangulation.apex(beyond);
      if (with_facet_certificate(v, apex, sign) < 0)
        return "the facet between the cell of beads " + bead_names(v) + " and bead " +
               bead_names(std::array{apex}) + " fails its test";
    }
  }
  for (const HiddenBead& h : hidden) {
    if (is_vertex[h.bead] != 0) return "bead " + std::to_string(h.bead) + " is hidden and has cells";
    is_vertex[h.bead] = 1;
    if (!detail::hides<Dimension>(triangulation, h, sign))
      return "bead " + std::to_string(h.bead) + " is not hidden in its cell";
  }
  for (BeadId bead = 0; bead < beads; ++bead) {
    if (is_absent(bead) && is_vertex[bead] != 0) return "bead " + std::to_string(bead) + " should be absent";
    if (is_vertex[bead] == 0 && !is_absent(bead)) return "bead " + std::to_string(bead) + " has no cell";
  }
  const auto side = [&](const Face& face, BeadId bead) {  // positive inside
    if (std::find(face.begin(), face.end(), bead) != face.end()) return 0;
    CellBeads<Dimension> cell{};
    std::copy(face.begin(), face.end(), cell.begin());
    cell.back() = bead;
    return sign(Orientation<Dimension>(cell, -1));
  };
  for (const Face& face : hull) {
    for (BeadId bead = 0; bead < beads; ++bead) {
      if (!is_absent(bead) && side(face, bead) < 0)
        return "bead " + std::to_string(bead) + " is outside the hull's face " + bead_names(face);
    }
  }
  const auto flat = [&](const Face& face) { return sign(same_turn<Dimension>(face, face)) == 0; };
  const auto first = std::find_if_not(hull.begin(), hull.end(), flat);
  if (first == hull.end()) return std::nullopt;
  const auto beside = [&](const Face& face) {
    return std::all_of(face.begin(), face.end(), [&](BeadId bead) { return side(*first, bead) == 0; });
  };
  for (auto other = first + 1; other != hull.end(); ++other) {
    if (beside(*other) && !flat(*other) && detail::holds_centroid<Dimension>(*first, *other, sign))
      return "the hull's faces " + bead_names(*first) + " and " + bead_names(*other) + " overlap";
  }
  return std::nullopt;
}

}  // namespace kds
