#pragma once
// Tolerances of a triangulation's facets, kept across steps: a facet whose beads stray less from where they
// were than its certificate tolerates is not looked at in the step. All are taken at one reference frame,
// which is moved up when a fresh one would let many more facets rest; a sample of facets tells. Where motion
// is fast, none is taken.
//
// Of each cell the least tolerance is compared with what any bead strays, an array against one number: where
// motion is slow that is all that most cells cost. What is left is compared facet by facet, and with what its
// own beads stray if, by the sample, that tells more.

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "certificates/search/slack.h"
#include "motions/base/grow_little.h"
#include "motions/views/displacement.h"
#include "structures/triangulation/facet_certificate.h"

namespace kds {

template <Motion M>
class FacetSlack {
 public:
  static constexpr int dimension = M::dimension;
  using Triangulation = RegularTriangulation<dimension>;

  /// At the start of a step, its motion loaded.
  void start_step(const M& motion, const Triangulation& triangulation) {
    if (triangulation.cells().empty()) return forget_all();
    const double rest = settle(motion, triangulation);
    if (wandering_.has_reference() && rest < least_worth) forget_all();  // too far away to be of use
    const double wanted = std::max(rest + worth_a_reference, least_share);
    if (wanted > 1) return;
    if (skip_ > 0) {
      --skip_;
      return;
    }
    fresh_.set_reference(motion);
    fresh_.look_at(motion);
    round_up(fresh_.strays(), fresh_strays_);
    if (sampled(motion, triangulation, fresh_strays_) < wanted) {
      skip_ = std::exchange(next_skip_, std::min(2 * next_skip_ + 1, most_skipped));
      return;
    }
    next_skip_ = 0;
    std::swap(wandering_, fresh_);
    take_all(motion, triangulation);
    static_cast<void>(settle(motion, triangulation));
  }
  /// Whether any facet may rest.
  [[nodiscard]] bool any() const { return wandering_.has_reference(); }
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
    if (!wandering_.has_reference()) return;
    grow(cell + 1);
    tolerances_[cell][static_cast<std::size_t>(i)] = forgotten;
    least_[cell] = forgotten;
  }
  void forget_all() {
    wandering_.forget_reference();
    tolerances_.clear();
    least_.clear();
  }

 private:
  /// Taking tolerances costs about as much as settling in double, so a reference must let this share of all
  /// facets rest that do not yet.
  static constexpr double worth_a_reference = 0.25;
  /// And this share of all: looking at a tolerance and keeping it up to date is not free either.
  static constexpr double least_share = 0.4;
  /// Below this share a reference is given up.
  static constexpr double least_worth = 0.05;
  /// Looking at what its own beads stray costs a facet most of what a certificate does: so it must spare many
  /// facets one, a share of all.
  static constexpr double worth_a_look = 1.0 / 32;
  /// Motion that is fast is so for a while: after each sample in vain so many steps more go by without one.
  static constexpr unsigned most_skipped = 15;
  static constexpr std::size_t sample_size = 128;
  /// What both cells say of a facet that was forgotten; else one of them says that any stray is tolerated.
  static constexpr float forgotten = -1;

  [[nodiscard]] unsigned others(const TriangulationCell<dimension>& cell, CellId id) const {
    const auto& tolerance = tolerances_[id];
    unsigned facets = 0;
    for (std::size_t i = 0; i <= dimension; ++i) facets |= (farthest_ < tolerance[i] ? 0U : 1U) << i;
    if (least_[id] >= 0) return facets;
    for (std::size_t i = 0; i <= dimension; ++i) {
      if (tolerance[i] < 0 && cell_of(cell.beyond[i]) < id) facets &= ~(1U << i);
    }
    return facets;
  }
  [[nodiscard]] unsigned others_by_beads(const TriangulationCell<dimension>& cell, CellId id) const {
    const auto& tolerance = tolerances_[id];
    const float stray = stray_of(cell.vertex, strays_);
    unsigned facets = 0;
    for (std::size_t i = 0; i <= dimension; ++i) {
      const float most = std::max(stray, stray_of(std::span(&cell.apex[i], 1), strays_));
      const bool other = !(most < tolerance[i]) && id < cell_of(cell.beyond[i]);
      facets |= (other ? 1U : 0U) << i;
    }
    return facets;
  }

  /// How far beads stray; of a sample, the share of facets that may rest.
  double settle(const M& motion, const Triangulation& triangulation) {
    if (!wandering_.has_reference()) return 0;
    wandering_.look_at(motion);
    farthest_ = round_up(wandering_.strays(), strays_);
    grow(triangulation.cells().size());
    std::size_t looked_at = 0, rest = 0, by_beads = 0;
    for_sample(triangulation, [&](CellId cell, int i) {
      const FacetId beyond = triangulation.beyond(cell, i);
      const FacetId here = cell < cell_of(beyond) ? facet_id(cell, i) : beyond;
      const bool among_others =
          (others_by_beads(triangulation.cells()[cell_of(here)], cell_of(here)) >> index_of(here) & 1U) != 0;
      const bool coarsely = farthest_ < tolerances_[cell_of(here)][static_cast<std::size_t>(index_of(here))];
      ++looked_at;
      rest += among_others ? 0 : 1;
      by_beads += !among_others && !coarsely ? 1 : 0;
    });
    // Where nothing bounds all beads a facet's two cells must be told apart by their beads.
    by_beads_ =
        share_of(by_beads, looked_at) > worth_a_look || !(farthest_ < std::numeric_limits<float>::infinity());
    return share_of(rest, looked_at);
  }

  // Floats are half as long to read. A stray is no smaller than it was, a tolerance no larger.

  /// Returns the largest.
  static float round_up(std::span<const double> strays, std::vector<float>& floats) {
    floats.resize(strays.size());
    std::array<float, 4> most{};
    for (std::size_t b = 0; b < strays.size(); ++b) {
      const float least = strays[b] > 0 ? std::numeric_limits<float>::min() : 0.0F;
      floats[b] = std::max(static_cast<float>(strays[b] * (1 + 0x1p-23)), least);
      most[b % 4] = std::max(most[b % 4], floats[b]);
    }
    return *std::max_element(most.begin(), most.end());
  }
  [[nodiscard]] static float rounded_down(double tolerance) {
    if (tolerance < std::numeric_limits<float>::min()) return 0;
    constexpr double most = std::numeric_limits<float>::max();
    return static_cast<float>(std::min(tolerance, most) * (1 - 0x1p-23));
  }

  /// New ones are forgotten before they are asked for.
  void grow(std::size_t cells) {
    grow_little(tolerances_, cells);
    grow_little(least_, cells);
  }

  /// Some facets of live cells.
  template <class Visit>
  static void for_sample(const Triangulation& triangulation, Visit visit) {
    const std::size_t stride = std::max<std::size_t>(1, triangulation.cells().size() / sample_size);
    for (std::size_t at = 0; at < triangulation.cells().size(); at += stride) {
      const auto cell = static_cast<CellId>(at);
      if (triangulation.is_live(cell)) visit(cell, static_cast<int>(cell % (dimension + 1)));
    }
  }
  [[nodiscard]] static double share_of(std::size_t some, std::size_t all) {
    return all == 0 ? 0 : static_cast<double>(some) / static_cast<double>(all);
  }

  [[nodiscard]] static float stray_of(std::span<const BeadId> beads, std::span<const float> strays) {
    float most = 0;
    for (const BeadId b : beads) most = std::max(most, b == infinite_bead ? 0.0F : strays[b]);
    return most;
  }

  /// Facets of finite beads, four at a time: `use(cell, i, tolerance of one bead)`.
  template <class Use>
  class FourAtOnce {
   public:
    FourAtOnce(const M& motion, const Triangulation& triangulation, Use use)
        : motion_(motion), triangulation_(triangulation), use_(use) {}
    void add(CellId cell, int i) {
      std::array<BeadId, dimension + 2> beads{};
      const auto& vertex = triangulation_.cells()[cell].vertex;
      std::copy(vertex.begin(), vertex.end(), beads.begin());
      beads.back() = triangulation_.apex_beyond(cell, i);
      if (std::find(beads.begin(), beads.end(), infinite_bead) != beads.end()) return use_(cell, i, 0);
      tuples_[count_] = beads;
      facets_[count_] = {cell, i};
      if (++count_ == Lanes::width) flush();
    }
    void flush() {
      if (count_ == 0) return;
      for (std::size_t lane = count_; lane < Lanes::width; ++lane) tuples_[lane] = tuples_[0];
      Lanes tolerance;
      slack_lanes<PowerTest<dimension>>(motion_, tuples_, Lanes(1.0), tolerance);
      // A difference moves by what both of its beads stray.
      for (std::size_t lane = 0; lane < count_; ++lane)
        use_(facets_[lane].first, facets_[lane].second, rounded_down(0.5 * tolerance.v[lane]));
      count_ = 0;
    }

   private:
    const M& motion_;
    const Triangulation& triangulation_;
    Use use_;
    std::array<std::array<BeadId, dimension + 2>, Lanes::width> tuples_{};
    std::array<std::pair<CellId, int>, Lanes::width> facets_{};
    std::size_t count_ = 0;
  };

  void take_all(const M& motion, const Triangulation& triangulation) {
    std::array<float, dimension + 1> most;
    most.fill(std::numeric_limits<float>::infinity());
    tolerances_.assign(triangulation.cells().size(), most);
    FourAtOnce four(motion, triangulation, [&](CellId cell, int i, float tolerance) {
      tolerances_[cell][static_cast<std::size_t>(i)] = tolerance;
    });
    for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
      if (!triangulation.is_live(cell)) continue;
      for (int i = 0; i <= dimension; ++i) {
        if (cell < cell_of(triangulation.beyond(cell, i))) four.add(cell, i);
      }
    }
    four.flush();
    least_.resize(tolerances_.size());
    for (std::size_t cell = 0; cell < least_.size(); ++cell)
      least_[cell] = *std::min_element(tolerances_[cell].begin(), tolerances_[cell].end());
  }

  /// The share of some facets that a reference at this step's start would let rest.
  [[nodiscard]] double sampled(const M& motion, const Triangulation& triangulation,
                               std::span<const float> strays) const {
    const auto cells = triangulation.cells();
    std::size_t looked_at = 0, rest = 0;
    FourAtOnce four(motion, triangulation, [&](CellId cell, int i, float tolerance) {
      const BeadId apex = triangulation.apex_beyond(cell, i);
      const float most =
          std::max(stray_of(cells[cell].vertex, strays), stray_of(std::span(&apex, 1), strays));
      ++looked_at;
      rest += most < tolerance ? 1 : 0;
    });
    for_sample(triangulation, [&](CellId cell, int i) { four.add(cell, i); });
    four.flush();
    return share_of(rest, looked_at);
  }

  unsigned skip_ = 0, next_skip_ = 0;
  Displacements<M, channels_of<PowerTest<dimension>>> wandering_, fresh_;
  /// Of each facet, at the cell with the smaller id; at the other infinite. Or forgotten.
  std::vector<std::array<float, dimension + 1>> tolerances_;
  std::vector<float> least_;                  ///< of each cell's
  std::vector<float> strays_, fresh_strays_;  ///< of each bead
  float farthest_ = 0;                        ///< any bead strays no more
  bool by_beads_ = false;
  std::vector<CellId> candidates_;
};

}  // namespace kds
