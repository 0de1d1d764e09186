#pragma once
// How near any two beads of a run come to each other, by their centres: of each step the pairs that its
// structure `closest` has had, each at its nearest. No other pair is nearer at any time.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "kds/event_log.h"
#include "motions/scene/scene.h"
#include "structures/session/session.h"

namespace kds {

struct DistanceRange {
  double lower = 0, upper = 0;
};

struct ClosestApproach {
  std::array<BeadId, 2> beads{};  ///< ascending
  std::size_t frame = 0;          ///< by its number in the file: the step begins there
  double u = 0;                   ///< in the step: these beads are no farther apart than `distance.upper`
  DistanceRange distance;         ///< the least of the run, rounded outward
};

/// The same of beads each of which is always within `deviation` of where the run has it.
[[nodiscard]] DistanceRange within_deviation(const DistanceRange& distance, double deviation);

class ClosestApproachOfRun final : public EventListener {
 public:
  /// Of the structure with this place in the session, which must outlive it. Listens from now on.
  ClosestApproachOfRun(Session& session, std::size_t structure);

  void on_event(const Event& event) override;
  /// The structures have been built.
  void begin();
  /// The step that begins with this frame has been run, and its motion is still there.
  void end_step(std::size_t frame);
  /// None before a step, of a single bead, and where doubles cannot hold the distance.
  [[nodiscard]] std::optional<ClosestApproach> least() const;

 private:
  Session& session_;
  std::size_t structure_;
  std::vector<std::array<BeadId, 2>> pairs_;  // of the step, the last of them the present one
  std::optional<ClosestApproach> least_;
};

/// Its place among the session's structures, if it is there.
[[nodiscard]] std::optional<std::size_t> place_of_closest(const Session& session);

}  // namespace kds
