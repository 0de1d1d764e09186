#pragma once
// The faces of a triangulation's hull, which are the finite facets of its infinite cells.

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "certificates/types/coplanar.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// Returns the finite facet of an infinite cell, positively oriented seen from outside. Returns nothing for a
/// finite cell.
template <int Dimension>
[[nodiscard]] std::optional<std::array<BeadId, Dimension>> hull_face(const CellBeads<Dimension>& v) {
  const auto place = static_cast<std::size_t>(std::find(v.begin(), v.end(), infinite_bead) - v.begin());
  if (place > Dimension) return std::nullopt;
  std::array<BeadId, Dimension> face{};
  std::copy(v.begin(), v.end() - 1, face.begin());
  if (place != Dimension) {
    face[place] = v[Dimension];
    std::swap(face[0], face[1]);  // a second exchange restores the orientation
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

}  // namespace kds
