#include "experiments/run/count_crossings.h"

#include <fmt/format.h>

#include "motions/base/text_input.h"
#include "structures/crossings/crossings.h"
#include "structures/session/parallel_run.h"

namespace kds {

CrossingCounts::CrossingCounts(const std::vector<std::uint64_t>& events_by_kind)
    : crosses(events_by_kind[Crossings::cross_plus] + events_by_kind[Crossings::cross_minus]),
      at_ends(events_by_kind[Crossings::end_plus] + events_by_kind[Crossings::end_minus]),
      touches(events_by_kind[Crossings::touch]) {}

std::string CrossingCounts::sentence() const {
  if (crosses + at_ends == 0) return "no bonds pass through each other on the paths between frames";
  std::string text =
      fmt::format("the paths between frames let bonds pass through each other {}", counted(crosses, "time"));
  if (at_ends > 0) text += fmt::format(", and an end of one through another {}", counted(at_ends, "time"));
  return text + ": frames are too far apart";
}

Json CrossingCounts::json() const {
  return {{"crosses", crosses}, {"at_ends", at_ends}, {"touches", touches}};
}

bool has_crossings(const Scene& scene) { return scene.dimension() == 3 && !scene.bonds().empty(); }

CrossingCounts count_crossings(const Scene& scene,
                               const std::function<void(std::size_t, std::size_t)>& progress) {
  ParallelRun run(scene, {.structures = {"crossings"}}, {.threads = all_threads()});
  run.run([&](std::size_t frame) { progress(frame, scene.step_count()); });
  return CrossingCounts(run.whole().structures().front()->statistics.events_by_kind);
}

}  // namespace kds
