#include "structures/power_diagram/diagram_update.h"

#include <algorithm>
#include <array>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "certificates/search/snapshot_sign.h"
#include "motions/base/input_error.h"
#include "structures/power_diagram/kinetic_update.h"
#include "structures/triangulation/regularity_fault.h"

namespace kds {

namespace {

// Common part of the updates that use no time but CGAL's construction. Hidden beads are the beads without a
// vertex.
template <int Dimension>
class StaticUpdate : public DiagramUpdate<Dimension> {
 public:
  void build(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;
  [[nodiscard]] StaticTriangulation<Dimension> diagram() const override;
  [[nodiscard]] std::optional<std::string> fault() const override;

 protected:
  void rebuild(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  void find_hidden();

  RegularTriangulation<Dimension> triangulation_;
  std::vector<BeadId> hidden_;  ///< ascending
  Snapshot<Dimension> frame_;   ///< the frame reached
  int affine_dimension_ = Dimension;
};

template <int Dimension>
class Rebuild final : public StaticUpdate<Dimension> {
 public:
  UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;
};

// Which bead of a failed certificate is taken out: any bead, or one with the most failed certificates.
enum class Choice : std::uint8_t { any, most_failed };

template <int Dimension>
class Reinsertion final : public StaticUpdate<Dimension> {
 public:
  explicit Reinsertion(Choice choice) : choice_(choice) {}
  UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;

 private:
  [[nodiscard]] std::vector<BeadId> choose(const SnapshotFaults& faults) const;

  Choice choice_;
};

/// The finite beads of a failed certificate; unused entries hold infinite_bead.
template <int Dimension>
using Suspects = std::array<BeadId, Dimension + 2>;

template <int Dimension>
std::vector<Suspects<Dimension>> suspects_of(const RegularTriangulation<Dimension>& triangulation,
                                             const SnapshotFaults& faults) {
  std::vector<Suspects<Dimension>> all;
  const auto add = [&](CellId cell, BeadId apex) {
    Suspects<Dimension> beads{};
    const auto& v = triangulation.cells()[cell].vertex;
    std::copy(v.begin(), v.end(), beads.begin());
    beads.back() = apex;
    std::sort(beads.begin(), beads.end());
    all.push_back(beads);
  };
  for (const auto* facets : {&faults.facets, &faults.zero_facets})
    for (const FacetId f : *facets) add(cell_of(f), triangulation.apex_beyond(cell_of(f), index_of(f)));
  for (const auto* cells : {&faults.cells, &faults.flat_cells})
    for (const CellId cell : *cells) add(cell, infinite_bead);
  std::sort(all.begin(), all.end());  // does not depend on how cells are numbered
  return all;
}

template <class Suspects>
std::vector<BeadId> one_of_each(const std::vector<Suspects>& failed) {
  std::vector<BeadId> chosen;
  for (const Suspects& beads : failed) {
    const bool done = std::any_of(beads.begin(), beads.end(), [&](BeadId b) {
      return std::binary_search(chosen.begin(), chosen.end(), b);
    });
    if (!done) chosen.insert(std::upper_bound(chosen.begin(), chosen.end(), beads[0]), beads[0]);
  }
  return chosen;
}

template <class Suspects>
std::vector<BeadId> most_failed_first(const std::vector<Suspects>& failed, std::size_t bead_count) {
  std::vector<std::vector<std::uint32_t>> of_bead(bead_count);
  for (std::uint32_t f = 0; f < failed.size(); ++f) {
    for (const BeadId b : failed[f])
      if (b != infinite_bead) of_bead[b].push_back(f);
  }
  std::vector<std::size_t> left(bead_count);
  // Among beads with equal counts, take the lowest id. Counts only decrease: an outdated entry is put back.
  using CountedBead = std::pair<std::size_t, BeadId>;
  const auto after = [](const CountedBead& a, const CountedBead& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::priority_queue<CountedBead, std::vector<CountedBead>, decltype(after)> queue(after);
  for (BeadId b = 0; b < bead_count; ++b) {
    left[b] = of_bead[b].size();
    if (left[b] > 0) queue.emplace(left[b], b);
  }
  std::vector<char> done(failed.size(), 0);
  std::vector<BeadId> chosen;
  while (!queue.empty()) {
    const auto [count, bead] = queue.top();
    queue.pop();
    if (count != left[bead]) {
      if (left[bead] > 0) queue.emplace(left[bead], bead);
      continue;
    }
    chosen.push_back(bead);
    for (const std::uint32_t f : of_bead[bead]) {
      if (std::exchange(done[f], 1) != 0) continue;
      for (const BeadId b : failed[f])
        if (b != infinite_bead) --left[b];
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

template <int Dimension>
void StaticUpdate<Dimension>::build(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  if (weights.size() <= Dimension) {
    throw InputError("the power diagram needs at least " + std::to_string(Dimension + 1) +
                     " beads, the input has " + std::to_string(weights.size()));
  }
  rebuild(centers, weights);
}

template <int Dimension>
void StaticUpdate<Dimension>::rebuild(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  auto built = triangulation_.build_bare(centers, weights);
  hidden_ = std::move(built.hidden);
  affine_dimension_ = built.dimension;
  frame_ = Snapshot<Dimension>(centers, weights);
}

template <int Dimension>
void StaticUpdate<Dimension>::find_hidden() {
  hidden_.clear();
  for (BeadId b = 0; b < frame_.bead_count(); ++b)
    if (!triangulation_.is_vertex(b)) hidden_.push_back(b);
}

template <int Dimension>
StaticTriangulation<Dimension> StaticUpdate<Dimension>::diagram() const {
  if (affine_dimension_ < Dimension) return {{}, hidden_, affine_dimension_};
  return {triangulation_.finite_cells(), hidden_, Dimension};
}

template <int Dimension>
std::optional<std::string> StaticUpdate<Dimension>::fault() const {
  if (!triangulation_.has_mirror()) return std::nullopt;  // built by CGAL, hence correct
  std::vector<HiddenBead> hidden;
  for (const BeadId b : hidden_) hidden.push_back({b, no_cell});
  return regularity_fault(triangulation_, static_cast<BeadId>(frame_.bead_count()), hidden, false,
                          [this](const auto& function) { return snapshot_sign(function, frame_); });
}

template <int Dimension>
UpdateCounts Rebuild<Dimension>::advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  this->rebuild(centers, weights);
  return {.rebuilds = 1};
}

template <int Dimension>
std::vector<BeadId> Reinsertion<Dimension>::choose(const SnapshotFaults& faults) const {
  const auto failed = suspects_of(this->triangulation_, faults);
  return choice_ == Choice::any ? one_of_each(failed) : most_failed_first(failed, this->frame_.bead_count());
}

template <int Dimension>
UpdateCounts Reinsertion<Dimension>::advance(const Eigen::Matrix3Xd& centers,
                                             std::span<const double> weights) {
  UpdateCounts counts;
  const auto give_up = [&] {
    this->rebuild(centers, weights);
    counts.rebuilds = 1;
    return counts;
  };
  if (this->affine_dimension_ < Dimension) return give_up();
  this->triangulation_.make_mirror();
  const Snapshot<Dimension> next(centers, weights);
  SnapshotFaults faults = snapshot_faults(this->triangulation_, next);
  counts.tested = faults.tested;
  counts.failed = faults.failed();
  // If a test is zero, another triangulation is equally correct, and CGAL would choose its own. Therefore
  // also take out the beads of tests that are zero.
  std::vector<BeadId> out;
  const std::size_t most = static_cast<std::size_t>(most_taken_out * static_cast<double>(weights.size()));
  while (!faults.none_strictly()) {
    const std::vector<BeadId> chosen = choose(faults);
    counts.removed = out.size() + chosen.size();
    if (counts.removed > most || counts.removed + this->hidden_.size() + 8 > weights.size()) return give_up();
    this->triangulation_.take_out(chosen);
    out.insert(out.end(), chosen.begin(), chosen.end());
    if (!this->triangulation_.is_solid()) return give_up();
    const std::vector<CellId> made = this->triangulation_.mirror_changes();
    faults = snapshot_faults(this->triangulation_, std::span<const CellId>(made), next);
  }
  this->triangulation_.set_points(centers, weights);
  // Any hidden bead may have become visible.
  out.insert(out.end(), this->hidden_.begin(), this->hidden_.end());
  std::sort(out.begin(), out.end());
  this->frame_ = next;
  if (!out.empty()) {
    this->triangulation_.put_in(out, centers, weights);
    static_cast<void>(this->triangulation_.mirror_changes());
    this->find_hidden();
  }
  return counts;
}

}  // namespace

template <int Dimension>
std::unique_ptr<DiagramUpdate<Dimension>> make_diagram_update(UpdateTechnique technique) {
  switch (technique) {
    case UpdateTechnique::rebuild:
      return std::make_unique<Rebuild<Dimension>>();
    case UpdateTechnique::reinsert:
      return std::make_unique<Reinsertion<Dimension>>(Choice::any);
    case UpdateTechnique::greedy:
      return std::make_unique<Reinsertion<Dimension>>(Choice::most_failed);
    case UpdateTechnique::kinetic:
      return std::make_unique<KineticUpdate<Dimension>>(UpdateMotion::linear);
    case UpdateTechnique::lifted:
      return std::make_unique<KineticUpdate<Dimension>>(UpdateMotion::lifted);
    case UpdateTechnique::activate:
      return std::make_unique<Activation<Dimension>>();
    case UpdateTechnique::automatic:
      break;
  }
  return std::make_unique<AutomaticUpdate<Dimension>>();
}

template std::unique_ptr<DiagramUpdate<2>> make_diagram_update(UpdateTechnique);
template std::unique_ptr<DiagramUpdate<3>> make_diagram_update(UpdateTechnique);

}  // namespace kds
