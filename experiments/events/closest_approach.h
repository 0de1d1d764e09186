#pragma once
// Computes how close two beads of a run come to each other, measured between centres. In each step it takes
// the least distance of every pair that the structure `closest` held during the step. No other pair is closer
// at any time.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "kds/event.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"

namespace kds {

struct DistanceRange {
  double lower = 0, upper = 0;
};

struct ClosestApproach {
  std::array<BeadId, 2> beads{};  ///< ascending
  std::size_t frame = 0;          ///< number in the file of the frame at which the step begins
  double u = 0;  ///< time in the step at which the distance of these beads is at most `distance.upper`
  DistanceRange distance;  ///< least distance of the run, rounded outward
};

/// Returns the range of the least distance if each bead may always deviate by up to `deviation` from its
/// position in the run.
[[nodiscard]] DistanceRange within_deviation(const DistanceRange& distance, double deviation);

/// Returns the closest approach of two parts of a run, either of which may have none. `earlier` comes first.
[[nodiscard]] std::optional<ClosestApproach> closer(const std::optional<ClosestApproach>& earlier,
                                                    const std::optional<ClosestApproach>& later);

class ClosestApproachOfRun final : public EventListener {
 public:
  /// Follows the structure with this index in the run. The run must outlive this object. Listens from
  /// now on.
  ClosestApproachOfRun(KineticRun& run, std::size_t structure);

  void on_event(const Event& event) override;
  /// Call it when the structures have been built.
  void begin();
  /// Call it after each step while the motion of the step is still loaded. `frame` is the frame at which the
  /// step begins.
  void end_step(std::size_t frame);
  /// Returns the closest approach. Returns nothing before the first step, for a single bead, and if doubles
  /// cannot hold the distance.
  [[nodiscard]] std::optional<ClosestApproach> least() const;

 private:
  KineticRun& run_;
  std::size_t structure_;
  std::vector<std::array<BeadId, 2>> pairs_;  // closest pairs of the step; the last one is current
  std::optional<ClosestApproach> least_;
};

/// Returns the index of the structure `closest` in the run, if the run has it.
[[nodiscard]] std::optional<std::size_t> index_of_closest(const KineticRun& run);

}  // namespace kds
