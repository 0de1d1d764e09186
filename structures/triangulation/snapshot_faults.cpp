#include "structures/triangulation/snapshot_faults.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <ranges>

#include "certificates/search/snapshot_sign.h"
#include "structures/triangulation/facet_certificate.h"

namespace kds {

namespace {

/// Tests of one kind, evaluated four at a time.
template <class Certificate, int Dimension>
class FourAtSnapshot {
 public:
  using Beads = std::array<BeadId, Certificate::size>;

  explicit FourAtSnapshot(const Snapshot<Dimension>& snapshot) : snapshot_(snapshot) {}

  /// Calls `failed(place, sign)`, now or later, if the certificate of these beads is not positive.
  template <class Failed>
  void test(const Beads& beads, std::uint32_t place, Failed failed) {
    tuples_[count_] = beads;
    places_[count_] = place;
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
        if (sign <= 0) failed(places_[lane], sign);
      }
    }
    count_ = 0;
  }

 private:
  const Snapshot<Dimension>& snapshot_;
  std::array<Beads, Lanes::width> tuples_{};
  std::array<std::uint32_t, Lanes::width> places_{};
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
