#pragma once
// The slack of a triangulation's facets (certificates/filters/slack.h), kept across steps: a facet whose
// beads stray less from where they were than it has slack is not looked at in the step. All slack is found at
// one reference frame, which is moved up when a fresh one would let many more facets rest; a sample of facets
// tells. Where motion is fast, none is.
//
// Of each cell the least slack is compared with what any bead strays, an array against one number: where
// motion is slow that is all that most cells cost. What is left is compared facet by facet, and with what its
// own beads stray if, by the sample, that tells more.

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

  /// At the start of a step, its motion loaded.
  void start_step(const Curves<Dimension>& curves, const Triangulation& triangulation);
  /// Whether any facet may rest.
  [[nodiscard]] bool any() const { return displacements_.has_reference(); }
  /// Calls `visit(cell, facets)` with all other facets of live cells, one bit each, each facet at one of its
  /// cells. Asked before any flip in the step.
  template <class Visit>
  void for_the_others(const Triangulation& triangulation, Visit visit) {
    const auto cells = triangulation.cells();
    candidates_.resize(cells.size());
    std::size_t count = 0;
    for (CellId id = 0; id < cells.size(); ++id) {
      candidates_[count] = id;
      count += farthest_ < least_[id] ? 0 : 1;  // no branch: no one foretells which
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
  /// The facet, as this cell has it, has got other beads.
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
  /// What both cells say of a facet that was forgotten; else one of them says that any stray is tolerated.
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

  /// How far beads stray; of a sample, the share of facets that may rest.
  double measure(const Curves<Dimension>& curves, const Triangulation& triangulation);
  /// New ones are forgotten before they are asked for.
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
  /// The share of some facets that a reference at this step's start would let rest.
  [[nodiscard]] double sampled(const Curves<Dimension>& curves, const Triangulation& triangulation,
                               std::span<const float> strays) const;

  BackOff samples_{0, 15};
  Displacements<Dimension, channels_of<PowerTest<Dimension>>> displacements_, fresh_;
  /// Of each facet, at the cell with the smaller id; at the other infinite. Or forgotten.
  std::vector<std::array<float, Dimension + 1>> slack_;
  std::vector<float> least_;                  ///< of each cell's
  std::vector<float> strays_, fresh_strays_;  ///< of each bead
  float farthest_ = 0;                        ///< any bead strays no more
  bool by_beads_ = false;
  std::vector<CellId> candidates_;
};

extern template class FacetSlack<2>;
extern template class FacetSlack<3>;

}  // namespace kds
