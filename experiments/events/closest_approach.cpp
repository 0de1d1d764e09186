#include "experiments/events/closest_approach.h"

#include <algorithm>
#include <cmath>
#include <variant>

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
          for (const auto& [a, b] : pairs_) {
            const LeastDistance nearest = least_distance(ref.curves(), a, b);
            if (!least_) least_ = {{a, b}, frame, nearest.at, {nearest.lower, nearest.upper}};
            least_->distance.lower = std::min(least_->distance.lower, nearest.lower);
            if (nearest.upper < least_->distance.upper)
              least_ = {{a, b}, frame, nearest.at, {least_->distance.lower, nearest.upper}};
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
