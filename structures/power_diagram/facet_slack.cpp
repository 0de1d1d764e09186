#include "structures/power_diagram/facet_slack.h"

#include <limits>
#include <utility>

#include "certificates/filters/slack.h"

namespace kds {

namespace {

/// Computing slack costs about as much as a search in doubles, so a new reference must let at least this
/// share of all facets be skipped in addition to those that are skipped already.
constexpr double worth_a_reference = 0.25;
/// A new reference must also let at least this share of all facets be skipped, because comparing slack and
/// keeping it up to date also costs time.
constexpr double least_share = 0.4;
/// A reference below this share is dropped.
constexpr double least_worth = 0.05;
/// Comparing the slack of a facet with the strays of its own beads costs nearly as much as a certificate. The
/// comparison must therefore make the certificates of at least this share of all facets unnecessary.
constexpr double share_worth_a_look = 1.0 / 32;
constexpr std::size_t sample_size = 128;

// Slack is stored in floats, which are half as long to read as doubles. Strays are rounded up, slack is
// rounded down.

/// Rounds the strays up. Returns the largest.
float round_up(std::span<const double> strays, std::vector<float>& floats) {
  floats.resize(strays.size());
  std::array<float, 4> most{};
  for (std::size_t b = 0; b < strays.size(); ++b) {
    const float least = strays[b] > 0 ? std::numeric_limits<float>::min() : 0.0F;
    floats[b] = std::max(static_cast<float>(strays[b] * (1 + 0x1p-23)), least);
    most[b % 4] = std::max(most[b % 4], floats[b]);
  }
  return *std::max_element(most.begin(), most.end());
}
[[nodiscard]] float rounded_down(double slack) {
  if (slack < std::numeric_limits<float>::min()) return 0;
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::min(slack, most) * (1 - 0x1p-23));
}

/// Calls `visit` with some facets of live cells.
template <int Dimension, class Visit>
void for_sample(const RegularTriangulation<Dimension>& triangulation, Visit visit) {
  const std::size_t stride = std::max<std::size_t>(1, triangulation.cells().size() / sample_size);
  for (std::size_t at = 0; at < triangulation.cells().size(); at += stride) {
    const auto cell = static_cast<CellId>(at);
    if (triangulation.is_live(cell)) visit(cell, static_cast<int>(cell % (Dimension + 1)));
  }
}
[[nodiscard]] double share_of(std::size_t some, std::size_t all) {
  return all == 0 ? 0 : static_cast<double>(some) / static_cast<double>(all);
}

/// Computes the slack of facets with finite beads, four at a time, and calls `use(cell, i, slack for one
/// bead)`.
template <int Dimension, class Use>
class FourAtOnce {
 public:
  FourAtOnce(const Curves<Dimension>& curves, const RegularTriangulation<Dimension>& triangulation, Use use)
      : at_start_(curves), triangulation_(triangulation), use_(use) {}
  void add(CellId cell, int i) {
    std::array<BeadId, Dimension + 2> beads{};
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
    Lanes slack;
    slack_lanes<PowerTest<Dimension>>(at_start_, tuples_, Lanes(1.0), slack);
    // The difference of two beads changes by at most the sum of both strays.
    for (std::size_t lane = 0; lane < count_; ++lane)
      use_(facets_[lane].first, facets_[lane].second, rounded_down(0.5 * slack.v[lane]));
    count_ = 0;
  }

 private:
  FixedCurves<Dimension, 0> at_start_;
  const RegularTriangulation<Dimension>& triangulation_;
  Use use_;
  std::array<std::array<BeadId, Dimension + 2>, Lanes::width> tuples_{};
  std::array<std::pair<CellId, int>, Lanes::width> facets_{};
  std::size_t count_ = 0;
};

}  // namespace

template <int Dimension>
void FacetSlack<Dimension>::start_step(const Curves<Dimension>& curves, const Triangulation& triangulation) {
  if (triangulation.cells().empty()) return forget_all();
  const double skipped = measure(curves, triangulation);
  if (displacements_.has_reference() && skipped < least_worth) forget_all();  // too far away to be useful
  const double wanted = std::max(skipped + worth_a_reference, least_share);
  if (wanted > 1) return;
  if (samples_.skips()) return;
  fresh_.set_reference(curves);
  fresh_.look_at(curves);
  round_up(fresh_.strays(), fresh_strays_);
  if (sampled(curves, triangulation, fresh_strays_) < wanted) return samples_.lengthen();
  samples_.reset();
  std::swap(displacements_, fresh_);
  take_all(curves, triangulation);
  static_cast<void>(measure(curves, triangulation));
}

template <int Dimension>
double FacetSlack<Dimension>::measure(const Curves<Dimension>& curves, const Triangulation& triangulation) {
  if (!displacements_.has_reference()) return 0;
  displacements_.look_at(curves);
  farthest_ = round_up(displacements_.strays(), strays_);
  grow(triangulation.cells().size());
  std::size_t looked_at = 0, skipped = 0, by_beads = 0;
  for_sample(triangulation, [&](CellId cell, int i) {
    const FacetId beyond = triangulation.beyond(cell, i);
    const FacetId here = cell < cell_of(beyond) ? facet_id(cell, i) : beyond;
    const bool among_others =
        (others_by_beads(triangulation.cells()[cell_of(here)], cell_of(here)) >> index_of(here) & 1U) != 0;
    const bool coarsely = farthest_ < slack_[cell_of(here)][static_cast<std::size_t>(index_of(here))];
    ++looked_at;
    skipped += among_others ? 0 : 1;
    by_beads += !among_others && !coarsely ? 1 : 0;
  });
  // If the strays are unbounded, the slack of one cell does not determine at which of its two cells a facet
  // is stored; the comparison by beads does.
  by_beads_ = share_of(by_beads, looked_at) > share_worth_a_look ||
              !(farthest_ < std::numeric_limits<float>::infinity());
  return share_of(skipped, looked_at);
}

template <int Dimension>
void FacetSlack<Dimension>::take_all(const Curves<Dimension>& curves, const Triangulation& triangulation) {
  std::array<float, Dimension + 1> most;
  most.fill(std::numeric_limits<float>::infinity());
  slack_.assign(triangulation.cells().size(), most);
  FourAtOnce four(curves, triangulation, [&](CellId cell, int i, float slack) {
    slack_[cell][static_cast<std::size_t>(i)] = slack;
  });
  for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
    if (!triangulation.is_live(cell)) continue;
    for (int i = 0; i <= Dimension; ++i) {
      if (cell < cell_of(triangulation.beyond(cell, i))) four.add(cell, i);
    }
  }
  four.flush();
  least_.resize(slack_.size());
  for (std::size_t cell = 0; cell < least_.size(); ++cell)
    least_[cell] = *std::min_element(slack_[cell].begin(), slack_[cell].end());
}

template <int Dimension>
double FacetSlack<Dimension>::sampled(const Curves<Dimension>& curves, const Triangulation& triangulation,
                                      std::span<const float> strays) const {
  const auto cells = triangulation.cells();
  std::size_t looked_at = 0, skipped = 0;
  FourAtOnce four(curves, triangulation, [&](CellId cell, int i, float slack) {
    const BeadId apex = triangulation.apex_beyond(cell, i);
    const float most = std::max(stray_of(cells[cell].vertex, strays), stray_of(std::span(&apex, 1), strays));
    ++looked_at;
    skipped += most < slack ? 1 : 0;
  });
  for_sample(triangulation, [&](CellId cell, int i) { four.add(cell, i); });
  four.flush();
  return share_of(skipped, looked_at);
}

template class FacetSlack<2>;
template class FacetSlack<3>;

}  // namespace kds
