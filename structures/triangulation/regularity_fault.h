#pragma once
// Checks whether a triangulation is regular, by the definition and by exact signs alone. The check is also
// sound for degenerate positions, which have several regular triangulations, so that a comparison with one
// static build would not suffice.
//
// All beads must be vertices or hidden, all finite cells positive and all facets regular. No bead may lie
// outside a face of the hull. Each hidden bead must lie in a cell and not inside the cell's power sphere.
// Under these conditions, the hull's triangles cover its boundary equally often everywhere, and the cells
// cover its inside as often. The triangles cover the boundary once if the centroid of one triangle lies in no
// other triangle. (The cells close up: flips preserve this.)
//
// Finds as well the certificates of a triangulation that fail at given positions.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "motions/curves/snapshot.h"
#include "structures/triangulation/hidden_beads.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// The signs of functions of beads at one moment.
template <int Dimension>
class SignsOfFunctions {
 public:
  virtual ~SignsOfFunctions() = default;
  [[nodiscard]] virtual int of(const PowerTest<Dimension>& function) const = 0;
  [[nodiscard]] virtual int of(const Orientation<Dimension>& function) const = 0;
  [[nodiscard]] virtual int of(const SameTurn<Dimension>& function) const = 0;
  [[nodiscard]] virtual int of(const CentroidInside<Dimension>& function) const = 0;
};

/// Signs computed by calling `sign` with the function.
template <int Dimension, class Sign>
class SignsBy final : public SignsOfFunctions<Dimension> {
 public:
  explicit SignsBy(Sign sign) : sign_(sign) {}
  [[nodiscard]] int of(const PowerTest<Dimension>& function) const override { return sign_(function); }
  [[nodiscard]] int of(const Orientation<Dimension>& function) const override { return sign_(function); }
  [[nodiscard]] int of(const SameTurn<Dimension>& function) const override { return sign_(function); }
  [[nodiscard]] int of(const CentroidInside<Dimension>& function) const override { return sign_(function); }

 private:
  Sign sign_;
};

/// Returns a description of a fault of the triangulation of the beads 0 ... beads-1 at one moment, or
/// nothing. Flat cells are accepted if `flat_cells` is true. A hidden bead without a known host may lie in
/// any cell. Beads marked in `absent` are ignored.
template <int Dimension>
[[nodiscard]] std::optional<std::string> regularity_fault(
    const RegularTriangulation<Dimension>& triangulation, BeadId beads, std::span<const HiddenBead> hidden,
    bool flat_cells, const SignsOfFunctions<Dimension>& signs, std::span<const char> absent = {});

/// Same, with the signs computed by `sign`, which takes any of these functions.
template <int Dimension, class Sign>
requires(!std::is_base_of_v<SignsOfFunctions<Dimension>, Sign>)
    [[nodiscard]] std::optional<std::string> regularity_fault(
        const RegularTriangulation<Dimension>& triangulation, BeadId beads,
        std::span<const HiddenBead> hidden, bool flat_cells, Sign sign, std::span<const char> absent = {}) {
  const SignsOfFunctions<Dimension>& signs = SignsBy<Dimension, Sign>(sign);
  return regularity_fault(triangulation, beads, hidden, flat_cells, signs, absent);
}

/// Finds the certificates of a triangulation that fail at given positions: the certificates of its facets
/// (facet_certificate.h) and the orientations of its finite cells. Exact. Certificates that are zero are
/// listed too: in this case the triangulation may be valid, but other triangulations are valid as well.
struct SnapshotFaults {
  std::uint64_t tested = 0;
  std::vector<FacetId> facets, zero_facets;
  std::vector<CellId> cells, flat_cells;  ///< inverted cells; flat cells

  [[nodiscard]] std::uint64_t failed() const { return facets.size() + cells.size(); }
  [[nodiscard]] bool none_strictly() const {
    return failed() == 0 && zero_facets.empty() && flat_cells.empty();
  }
};

/// Returns -1 if some finite cell is inverted, otherwise 0 if some finite cell is flat, otherwise 1. Marked
/// cells are known to be positive; cells beyond the end of the marks count as not marked.
template <int Dimension>
[[nodiscard]] int least_orientation(const RegularTriangulation<Dimension>& triangulation,
                                    const Snapshot<Dimension>& snapshot,
                                    std::span<const std::uint8_t> known_positive = {});

/// Tests all facets and finite cells.
template <int Dimension>
[[nodiscard]] SnapshotFaults snapshot_faults(const RegularTriangulation<Dimension>& triangulation,
                                             const Snapshot<Dimension>& snapshot);

/// Tests the live ones among these cells, and all their facets. A facet between two of these cells is listed
/// twice.
template <int Dimension>
[[nodiscard]] SnapshotFaults snapshot_faults(const RegularTriangulation<Dimension>& triangulation,
                                             std::span<const CellId> cells,
                                             const Snapshot<Dimension>& snapshot);

}  // namespace kds
