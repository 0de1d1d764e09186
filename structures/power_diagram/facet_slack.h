#pragma once
// The slack of a triangulation's facets (certificates/filters/slack.h), kept across steps. The stray of a
// bead is its distance from its position at the reference frame. A step skips a facet if the strays of its
// beads are smaller than its slack. All slack is computed at one reference frame. A newer reference frame
// replaces it if a sample of facets shows that many more facets would be skipped. In fast motion there is no
// reference.
//
// The least slack of each cell is first compared with the largest stray of any bead, in one pass over an
// array; in slow motion most cells need nothing else. The remaining cells are compared facet by facet. If the
// sample shows that it helps, a facet's slack is compared with the strays of its own beads.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "certificates/types/power_test.h"
#include "motions/base/back_off.h"
#include "motions/base/grow_little.h"
#include "motions/curves/curves.h"
#include "motions/views/displacement.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

template <int Dimension>
class FacetSlack {
 public:
  using Triangulation = RegularTriangulation<Dimension>;

  /// Called at the start of a step, when its motion is loaded.
  void start_step(const Curves<Dimension>& curves, const Triangulation& triangulation);
  /// Returns whether any facet may be skipped.
  [[nodiscard]] bool any() const { return displacements_.has_reference(); }
  /// Calls `visit(cell, facets)` for all facets of live cells that are not skipped, one bit each; each facet
  /// is reported at one of its cells. Must be called before any flip in the step.
  template <class Visit>
  void for_the_others(const Triangulation& triangulation, Visit visit) {
    const auto cells = triangulation.cells();
    candidates_.resize(cells.size());
    std::size_t count = 0;
    for (CellId id = 0; id < cells.size(); ++id) {
      candidates_[count] = id;
      count += farthest_ < least_[id] ? 0 : 1;  // branch-free, because the outcome is unpredictable
    }
    constexpr std::size_t ahead = 8;
    for (std::size_t k = 0; k < count; ++k) {
      if (by_beads_ && k + ahead < count) __builtin_prefetch(&cells[candidates_[k + ahead]]);
      const CellId id = candidates_[k];
      if (!triangulation.is_live(id)) continue;
      const unsigned facets = by_beads_ ? others_by_beads(cells[id], id) : others(cells[id], id);
      if (facets != 0) visit(id, facets);
    }
  }
  /// Notes that the facet, as stored at this cell, has other beads.
  void forget(CellId cell, int i) {
    if (!displacements_.has_reference()) return;
    grow(cell + 1);
    slack_[cell][static_cast<std::size_t>(i)] = forgotten;
    least_[cell] = forgotten;
  }
  void forget_all() {
    displacements_.forget_reference();
    slack_.clear();
    least_.clear();
  }

 private:
  /// Slack at both cells of a facet that was forgotten. Otherwise the cell with the larger id stores
  /// infinity.
  static constexpr float forgotten = -1;

  [[nodiscard]] unsigned others(const TriangulationCell<Dimension>& cell, CellId id) const {
    const auto& slack = slack_[id];
    unsigned facets = 0;
    for (std::size_t i = 0; i <= Dimension; ++i) facets |= (farthest_ < slack[i] ? 0U : 1U) << i;
    if (least_[id] >= 0) return facets;
    for (std::size_t i = 0; i <= Dimension; ++i) {
      if (slack[i] < 0 && cell_of(cell.beyond[i]) < id) facets &= ~(1U << i);
    }
    return facets;
  }
  [[nodiscard]] unsigned others_by_beads(const TriangulationCell<Dimension>& cell, CellId id) const {
    const auto& slack = slack_[id];
    const float stray = stray_of(cell.vertex, strays_);
    unsigned facets = 0;
    for (std::size_t i = 0; i <= Dimension; ++i) {
      const float most = std::max(stray, stray_of(std::span(&cell.apex[i], 1), strays_));
      const bool other = !(most < slack[i]) && id < cell_of(cell.beyond[i]);
      facets |= (other ? 1U : 0U) << i;
    }
    return facets;
  }

  /// Measures the strays. Returns the share of facets that may be skipped, in a sample.
  double measure(const Curves<Dimension>& curves, const Triangulation& triangulation);
  /// Makes room for new cells, whose facets are passed to `forget` before they are read.
  void grow(std::size_t cells) {
    grow_little(slack_, cells);
    grow_little(least_, cells);
  }
  [[nodiscard]] static float stray_of(std::span<const BeadId> beads, std::span<const float> strays) {
    float most = 0;
    for (const BeadId b : beads) most = std::max(most, b == infinite_bead ? 0.0F : strays[b]);
    return most;
  }
  void take_all(const Curves<Dimension>& curves, const Triangulation& triangulation);
  /// Returns the share of sampled facets that would be skipped if the start of this step were the reference.
  [[nodiscard]] double sampled(const Curves<Dimension>& curves, const Triangulation& triangulation,
                               std::span<const float> strays) const;

  BackOff samples_{0, 15};
  Displacements<Dimension, channels_of<PowerTest<Dimension>>> displacements_, fresh_;
  /// The slack of each facet, stored at the cell with the smaller id; infinite at the other cell. `forgotten`
  /// at both if unknown.
  std::vector<std::array<float, Dimension + 1>> slack_;
  std::vector<float> least_;                  ///< the least of each cell
  std::vector<float> strays_, fresh_strays_;  ///< for each bead
  float farthest_ = 0;                        ///< the largest stray of any bead
  bool by_beads_ = false;
  std::vector<CellId> candidates_;
};

extern template class FacetSlack<2>;
extern template class FacetSlack<3>;

}  // namespace kds
