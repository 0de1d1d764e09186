#include "experiments/events/closest_approach.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "structures/closest/candidate_pairs.h"
#include "structures/closest/kinetic_closest_pair.h"
#include "structures/closest/least_distance.h"

namespace kds {

DistanceRange within_deviation(const DistanceRange& distance, double deviation) {
  constexpr double more = 1 + 0x1p-50;
  return {std::max(0.0, distance.lower * (2 - more) - 2 * deviation * more),
          (distance.upper + 2 * deviation) * more};
}

std::optional<ClosestApproach> closer(const std::optional<ClosestApproach>& earlier,
                                      const std::optional<ClosestApproach>& later) {
  if (!earlier || !later) return earlier ? earlier : later;
  ClosestApproach least = later->distance.upper < earlier->distance.upper ? *later : *earlier;
  least.distance.lower = std::min(earlier->distance.lower, later->distance.lower);
  return least;
}

namespace {

/// Calls look(least distance) for the pair, or for each of its images that may be the nearest in the step.
template <int Dimension, class Look>
void each_image(const Curves<Dimension>& curves, BeadId a, BeadId b, const Look& look) {
  if (curves.cell() == nullptr) return look(least_distance(curves, a, b));
  std::vector<char> others(curves.bead_count(), 1);
  others[a] = others[b] = 0;
  ShiftNumbers<Dimension> shifts;
  for (const ImagePair& image : candidate_images(curves, shifts, others))
    look(least_distance(curves, a, b, shifts.shift(image.shift)));
}

}  // namespace

ClosestApproachOfRun::ClosestApproachOfRun(KineticRun& run, std::size_t structure)
    : run_(run), structure_(structure) {
  run_.simulator().listen(*this);
}

void ClosestApproachOfRun::on_event(const Event& event) {
  if (event.structure_index == structure_ && event.change.kind == KineticClosestPair<3>::replace)
    pairs_.push_back({event.ids()[2], event.ids()[3]});
}

void ClosestApproachOfRun::begin() {
  const auto built = run_.elements(structure_, 0);
  for (const CombinatorialElement& pair : built->all) pairs_.push_back({pair[1], pair[2]});
}

void ClosestApproachOfRun::end_step(std::size_t frame) {
  std::visit(
      [&]<int Dimension>(const MotionRef<Dimension>& ref) {
        if constexpr (Dimension > 1) {
          for (const std::array<BeadId, 2>& pair : pairs_) {
            each_image(ref.curves(), pair[0], pair[1], [&](const LeastDistance& nearest) {
              if (!least_) least_ = {pair, frame, nearest.at, {nearest.lower, nearest.upper}};
              least_->distance.lower = std::min(least_->distance.lower, nearest.lower);
              if (nearest.upper < least_->distance.upper)
                least_ = {pair, frame, nearest.at, {least_->distance.lower, nearest.upper}};
            });
          }
        }
      },
      run_.motion()->ref());
  if (!pairs_.empty()) pairs_ = {pairs_.back()};
}

std::optional<ClosestApproach> ClosestApproachOfRun::least() const {
  return least_ && least_->distance.upper < HUGE_VAL ? least_ : std::nullopt;
}

std::optional<std::size_t> index_of_closest(const KineticRun& run) {
  const auto& structures = run.structures();
  const auto closest = std::find_if(structures.begin(), structures.end(),
                                    [](const KineticStructure* s) { return s->name() == "closest"; });
  if (closest == structures.end()) return std::nullopt;
  return static_cast<std::size_t>(closest - structures.begin());
}

}  // namespace kds
