#include "structures/triangulation/regularity_fault.h"

#include <algorithm>
#include <array>
#include <vector>

#include "structures/necklace/bead_names.h"
#include "structures/triangulation/facet_certificate.h"
#include "structures/triangulation/hull_faces.h"

namespace kds {

namespace {

template <int Dimension>
int facet_sign(const CellBeads<Dimension>& cell, BeadId apex, const SignsOfFunctions<Dimension>& signs) {
  return with_facet_certificate(cell, apex, [&](const auto& certificate) { return signs.of(certificate); });
}

/// Returns whether the centroid of one face lies in or on the boundary of another face in the same plane. (In
/// the plane: of another edge on the same line that has the same direction.)
template <int Dimension>
bool holds_centroid(const std::array<BeadId, Dimension>& of, const std::array<BeadId, Dimension>& face,
                    const SignsOfFunctions<Dimension>& signs) {
  const auto inside = [&](auto... line) {
    CentroidInside<Dimension> f;
    const std::array ends{line...};
    std::copy(ends.begin(), ends.end(), std::copy(of.begin(), of.end(), f.beads.begin()));
    return signs.of(f);
  };
  if constexpr (Dimension == 2) {
    return inside(face[0]) >= 0 && inside(face[1]) <= 0;
  } else {
    return inside(face[0], face[1]) >= 0 && inside(face[1], face[2]) >= 0 && inside(face[2], face[0]) >= 0;
  }
}

/// Returns whether a bead lies in its host or on its boundary, and not inside the host's power sphere. In a
/// regular triangulation, any of the cells that contain the bead may be its host.
template <int Dimension>
bool hides(const RegularTriangulation<Dimension>& triangulation, const HiddenBead& hidden,
           const SignsOfFunctions<Dimension>& signs) {
  const auto contains = [&](const CellBeads<Dimension>& v) {
    if (std::find(v.begin(), v.end(), infinite_bead) != v.end()) return false;
    for (std::size_t i = 0; i <= Dimension; ++i) {
      auto part = v;
      part[i] = hidden.bead;
      if (signs.of(Orientation<Dimension>(part, 1)) < 0) return false;
    }
    return true;
  };
  const auto hides_in = [&](CellId cell) {
    const CellBeads<Dimension>& v = triangulation.cells()[cell].vertex;
    return triangulation.is_live(cell) && contains(v) && facet_sign(v, hidden.bead, signs) >= 0;
  };
  if (hidden.host != no_cell) return hides_in(hidden.host);
  for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
    if (hides_in(cell)) return true;
  }
  return false;
}

}  // namespace

template <int Dimension>
std::optional<std::string> regularity_fault(const RegularTriangulation<Dimension>& triangulation,
                                            BeadId beads, std::span<const HiddenBead> hidden, bool flat_cells,
                                            const SignsOfFunctions<Dimension>& signs,
                                            std::span<const char> absent) {
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
      const int s = signs.of(Orientation<Dimension>(v, 1));
      if (s < 0 || (s == 0 && !flat_cells))
        return "the cell of beads " + bead_names(v) + " is " + (s < 0 ? "inverted" : "flat");
      for (const BeadId b : v) is_vertex[b] = 1;
    }
    for (int i = 0; i <= Dimension; ++i) {
      const FacetId beyond = triangulation.beyond(cell, i);
      if (cell_of(beyond) < cell) continue;
      const BeadId apex = triangulation.apex(beyond);
      if (facet_sign(v, apex, signs) < 0)
        return "the facet between the cell of beads " + bead_names(v) + " and bead " +
               bead_names(std::array{apex}) + " fails its test";
    }
  }
  for (const HiddenBead& h : hidden) {
    if (is_vertex[h.bead] != 0) return "bead " + std::to_string(h.bead) + " is hidden and has cells";
    is_vertex[h.bead] = 1;
    if (!hides<Dimension>(triangulation, h, signs))
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
    return signs.of(Orientation<Dimension>(cell, -1));
  };
  for (const Face& face : hull) {
    for (BeadId bead = 0; bead < beads; ++bead) {
      if (!is_absent(bead) && side(face, bead) < 0)
        return "bead " + std::to_string(bead) + " is outside the hull's face " + bead_names(face);
    }
  }
  const auto flat = [&](const Face& face) { return signs.of(same_turn<Dimension>(face, face)) == 0; };
  const auto first = std::find_if_not(hull.begin(), hull.end(), flat);
  if (first == hull.end()) return std::nullopt;
  const auto beside = [&](const Face& face) {
    return std::all_of(face.begin(), face.end(), [&](BeadId bead) { return side(*first, bead) == 0; });
  };
  for (auto other = first + 1; other != hull.end(); ++other) {
    if (beside(*other) && !flat(*other) && holds_centroid<Dimension>(*first, *other, signs))
      return "the hull's faces " + bead_names(*first) + " and " + bead_names(*other) + " overlap";
  }
  return std::nullopt;
}

template std::optional<std::string> regularity_fault(const RegularTriangulation<2>&, BeadId,
                                                     std::span<const HiddenBead>, bool,
                                                     const SignsOfFunctions<2>&, std::span<const char>);
template std::optional<std::string> regularity_fault(const RegularTriangulation<3>&, BeadId,
                                                     std::span<const HiddenBead>, bool,
                                                     const SignsOfFunctions<3>&, std::span<const char>);

}  // namespace kds
