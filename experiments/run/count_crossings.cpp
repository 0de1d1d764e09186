#include "experiments/run/count_crossings.h"

#include <fmt/format.h>

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

bool has_crossings(const Scene& scene) { return !structure_registry().find("crossings")->refusal(scene); }

CrossingCounts count_crossings(const Scene& scene,
                               const std::function<void(std::size_t, std::size_t)>& progress) {
  KineticRun run(scene, {.structures = {"crossings"}});
  for (std::size_t done = 0; run.run_step();) progress(++done, scene.step_count());
  return {scene, run.structures().front()->statistics.events_by_kind};
}

}  // namespace kds
