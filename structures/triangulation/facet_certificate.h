#pragma once
// The certificate of a facet of a regular triangulation: the power test of its two cells' beads or, if the
// infinite vertex is among them, the orientation of the other beads (the hull is locally convex there). Also
// the faces of the hull.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// The certificates of a cell's facets. The cell's beads are sorted only once for all facets.
template <std::size_t N>
class CellCertificates {
 public:
  static constexpr int dimension = static_cast<int>(N) - 1;

  [[gnu::always_inline]] explicit CellCertificates(const std::array<BeadId, N>& cell)
      : sorted_(cell), sign_(sort_beads(sorted_)) {}

  /// Calls `use` with the certificate of the facet whose other cell has the vertex `apex` opposite to it.
  template <class Use>
  [[gnu::always_inline]] decltype(auto) to(BeadId apex, Use use) const {
    if (!on_hull(apex)) {
      PowerTest<dimension> test;
      make(apex, test);
      return use(test);
    }
    Orientation<dimension> orientation;
    make(apex, orientation);
    return use(orientation);
  }
  /// Same as `to`, in two parts and without a call: `on_hull` returns whether the certificate is an
  /// orientation, and `make` constructs the certificate in place.
  [[nodiscard, gnu::always_inline]] bool on_hull(BeadId apex) const {
    return sorted_.back() == infinite_bead || apex == infinite_bead;
  }
  [[gnu::always_inline]] void make(BeadId apex, PowerTest<dimension>& test) const {
    auto beads = with(apex);
    test.sign = sign_ * sort_last_bead(beads);
    for (std::size_t i = 0; i < beads.size(); ++i) test.beads[i] = beads[i];
  }
  [[gnu::always_inline]] void make(BeadId apex, Orientation<dimension>& orientation) const {
    auto beads = with(apex);
    orientation.sign = sign_ * sort_last_bead(beads);
    // After sorting, the infinite vertex is last. The row of the infinite vertex, (0, ..., 0, 1), reduces the
    // determinant to that of the other beads.
    std::copy(beads.begin(), beads.end() - 1, orientation.beads.begin());
  }

 private:
  [[gnu::always_inline]] std::array<BeadId, N + 1> with(BeadId apex) const {
    std::array<BeadId, N + 1> beads;
    std::copy(sorted_.begin(), sorted_.end(), beads.begin());
    beads.back() = apex;
    return beads;
  }

  std::array<BeadId, N> sorted_;
  int sign_;
};

/// Calls `use` with the certificate of one facet of a cell.
template <std::size_t N, class Use>
[[gnu::always_inline]] inline decltype(auto) with_facet_certificate(const std::array<BeadId, N>& cell,
                                                                    BeadId apex, Use use) {
  return CellCertificates(cell).to(apex, use);
}

/// Returns the face of the hull that is the finite facet of an infinite cell, positively oriented seen from
/// outside. Returns nothing for a finite cell.
template <int Dimension>
[[nodiscard]] std::optional<std::array<BeadId, Dimension>> hull_face(const CellBeads<Dimension>& v) {
  const auto index = static_cast<std::size_t>(std::find(v.begin(), v.end(), infinite_bead) - v.begin());
  if (index > Dimension) return std::nullopt;
  std::array<BeadId, Dimension> face{};
  std::copy(v.begin(), v.end() - 1, face.begin());
  if (index != Dimension) {
    face[index] = v[Dimension];
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
