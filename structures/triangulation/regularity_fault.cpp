#include "structures/triangulation/regularity_fault.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <ranges>
#include <vector>

#include "certificates/search/snapshot_sign.h"
#include "structures/necklace/bead_pairs.h"
#include "structures/triangulation/facet_certificate.h"

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

/// Tests of one kind, evaluated four at a time.
template <class Certificate, int Dimension>
class FourAtSnapshot {
 public:
  using Beads = std::array<BeadId, Certificate::size>;

  explicit FourAtSnapshot(const Snapshot<Dimension>& snapshot) : snapshot_(snapshot) {}

  /// Calls `failed(tag, sign)`, now or later, if the certificate of these beads is not positive.
  template <class Failed>
  void test(const Beads& beads, std::uint32_t tag, Failed failed) {
    tuples_[count_] = beads;
    tags_[count_] = tag;
    if (++count_ == Lanes::width) flush(failed);
  }
  template <class Failed>
  void flush(Failed failed) {
    if (count_ == 0) return;
    for (std::size_t lane = count_; lane < Lanes::width; ++lane) tuples_[lane] = tuples_[0];
    Lanes::Mask positive;
    snapshot_positive<Certificate>(snapshot_, tuples_, Lanes(1.0), positive);
    if (!Lanes::all(positive)) {
      for (std::size_t lane = 0; lane < count_; ++lane) {
        if (positive[lane] != 0) continue;
        const int sign = snapshot_sign(Certificate(tuples_[lane], 1), snapshot_);
        if (sign <= 0) failed(tags_[lane], sign);
      }
    }
    count_ = 0;
  }

 private:
  const Snapshot<Dimension>& snapshot_;
  std::array<Beads, Lanes::width> tuples_{};
  std::array<std::uint32_t, Lanes::width> tags_{};
  std::size_t count_ = 0;
};

template <int Dimension, class Cells>
SnapshotFaults faults_of(const RegularTriangulation<Dimension>& triangulation, const Cells& cells,
                         const Snapshot<Dimension>& snapshot) {
  // If all cells are listed, each facet is visited twice, and is tested only once.
  constexpr bool of_all = !std::same_as<Cells, std::span<const CellId>>;
  SnapshotFaults faults;
  const auto facet_fails = [&](FacetId facet, int sign) {
    (sign < 0 ? faults.facets : faults.zero_facets).push_back(facet);
  };
  const auto cell_fails = [&](CellId cell, int sign) {
    (sign < 0 ? faults.cells : faults.flat_cells).push_back(cell);
  };
  FourAtSnapshot<PowerTest<Dimension>, Dimension> power_tests(snapshot);
  FourAtSnapshot<Orientation<Dimension>, Dimension> orientations(snapshot);
  const auto all = triangulation.cells();
  for (const CellId cell : cells) {
    if (!triangulation.is_live(cell)) continue;
    const CellBeads<Dimension>& v = all[cell].vertex;
    const bool finite = std::find(v.begin(), v.end(), infinite_bead) == v.end();
    if (finite) {
      ++faults.tested;
      orientations.test(v, cell, cell_fails);
    }
    for (int i = 0; i <= Dimension; ++i) {
      const FacetId beyond = triangulation.beyond(cell, i);
      const BeadId apex = triangulation.apex_beyond(cell, i);
      if (apex == infinite_bead || v[static_cast<std::size_t>(i)] == infinite_bead) {
        if (finite || apex != infinite_bead) continue;  // left to the orientation of the finite cell
      }
      if (of_all && cell_of(beyond) < cell) continue;
      ++faults.tested;
      if (finite) {
        std::array<BeadId, Dimension + 2> beads{};
        std::copy(v.begin(), v.end(), beads.begin());
        beads.back() = apex;
        power_tests.test(beads, facet_id(cell, i), facet_fails);
      } else {
        with_facet_certificate(v, apex, [&](const auto& certificate) {
          const int sign = snapshot_sign(certificate, snapshot);
          if (sign <= 0) facet_fails(facet_id(cell, i), sign);
        });
      }
    }
  }
  power_tests.flush(facet_fails);
  orientations.flush(cell_fails);
  return faults;
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

template <int Dimension>
int least_orientation(const RegularTriangulation<Dimension>& triangulation,
                      const Snapshot<Dimension>& snapshot, std::span<const std::uint8_t> known_positive) {
  int least = 1;
  const auto fails = [&](CellId, int sign) { least = std::min(least, sign); };
  FourAtSnapshot<Orientation<Dimension>, Dimension> orientations(snapshot);
  const auto all = triangulation.cells();
  for (CellId cell = 0; cell < all.size(); ++cell) {
    if (cell < known_positive.size() && known_positive[cell] != 0) continue;
    const CellBeads<Dimension>& v = all[cell].vertex;
    if (triangulation.is_live(cell) && std::find(v.begin(), v.end(), infinite_bead) == v.end())
      orientations.test(v, cell, fails);
  }
  orientations.flush(fails);
  return least;
}

template <int Dimension>
SnapshotFaults snapshot_faults(const RegularTriangulation<Dimension>& triangulation,
                               const Snapshot<Dimension>& snapshot) {
  const auto count = static_cast<CellId>(triangulation.cells().size());
  return faults_of(triangulation, std::views::iota(CellId{0}, count), snapshot);
}

template <int Dimension>
SnapshotFaults snapshot_faults(const RegularTriangulation<Dimension>& triangulation,
                               std::span<const CellId> cells, const Snapshot<Dimension>& snapshot) {
  return faults_of(triangulation, cells, snapshot);
}

template int least_orientation(const RegularTriangulation<2>&, const Snapshot<2>&,
                               std::span<const std::uint8_t>);
template SnapshotFaults snapshot_faults(const RegularTriangulation<2>&, const Snapshot<2>&);
template SnapshotFaults snapshot_faults(const RegularTriangulation<2>&, std::span<const CellId>,
                                        const Snapshot<2>&);
template int least_orientation(const RegularTriangulation<3>&, const Snapshot<3>&,
                               std::span<const std::uint8_t>);
template SnapshotFaults snapshot_faults(const RegularTriangulation<3>&, const Snapshot<3>&);
template SnapshotFaults snapshot_faults(const RegularTriangulation<3>&, std::span<const CellId>,
                                        const Snapshot<3>&);

}  // namespace kds
