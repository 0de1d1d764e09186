#include "experiments/run/count_crossings.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>

#include "motions/base/text_input.h"
#include "structures/crossings/crossings.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/structure_spec.h"

namespace kds {

CrossingCounts::CrossingCounts(const Scene& scene, const std::vector<std::uint64_t>& events_by_kind)
    : crosses(events_by_kind[Crossings::cross_plus] + events_by_kind[Crossings::cross_minus]),
      at_ends(events_by_kind[Crossings::end_plus] + events_by_kind[Crossings::end_minus]),
      plus_at_ends(events_by_kind[Crossings::end_plus]),
      touches(events_by_kind[Crossings::touch]),
      bonds(scene.bonds().size()) {}

std::string CrossingCounts::sentence() const {
  const std::string among = counted(bonds, "bond");
  if (!any()) return fmt::format("no bond passes through another on the paths between frames ({})", among);
  std::string text = fmt::format("bonds pass through each other {} on the paths between frames ({})",
                                 counted(crosses, "time"), among);
  if (at_ends > 0) text += fmt::format(" and {} at ends of bonds", counted(at_ends, "event"));
  return text + "; for bonds of molecules, frames are then too far apart";
}

Json CrossingCounts::json() const {
  return {{"bonds", bonds}, {"crosses", crosses}, {"at_ends", at_ends}, {"touches", touches}};
}

namespace {

/// Returns the mean number of bonds whose balls meet the ball around a bond, if bonds were spread evenly in
/// their bounding box: far above 1 if consecutive beads are anywhere.
double neighbours_of_a_bond(const Scene& scene) {
  const Eigen::Matrix3Xd beads = scene.centers(0);
  Eigen::Array3d low = beads.col(0), high = low;
  double cubes = 0, longest = 0;
  for (const BeadId bead : scene.bonds()) {
    const auto b = static_cast<Eigen::Index>(bead);
    const double length = (beads.col(b + 1) - beads.col(b)).stableNorm();
    cubes += length * length * length;
    longest = std::max(longest, length);
    for (const Eigen::Index end : {b, b + 1}) {
      low = low.min(beads.col(end).array());
      high = high.max(beads.col(end).array());
    }
  }
  return 4.19 * cubes / (high - low).max(longest).prod();
}

}  // namespace

std::optional<std::string> refusal_of_crossings(const Scene& scene) {
  constexpr double most_neighbours =
      64;  // 0.1 to 3 in proteins, 40 in a melt of chains without volume of density 10
  if (const auto refusal = structure_registry().find("crossings")->refusal(scene)) return refusal;
  if (neighbours_of_a_bond(scene) > most_neighbours)
    return "consecutive beads are as far apart as beads that are not bonded";
  return std::nullopt;
}

CrossingCounts count_crossings(const Scene& scene,
                               const std::function<void(std::size_t, std::size_t)>& progress) {
  KineticRun run(scene, {.structures = {"crossings"}});
  for (std::size_t done = 0; run.run_step();) progress(++done, scene.step_count());
  return {scene, run.structures().front()->statistics.events_by_kind};
}

}  // namespace kds
