#include "experiments/run/count_crossings.h"

#include <fmt/format.h>

#include "motions/base/text_input.h"
#include "structures/crossings/crossings.h"
#include "structures/session/parallel_run.h"

namespace kds {

CrossingCounts::CrossingCounts(const Scene& scene, const std::vector<std::uint64_t>& events_by_kind)
    : crosses(events_by_kind[Crossings::cross_plus] + events_by_kind[Crossings::cross_minus]),
      at_ends(events_by_kind[Crossings::end_plus] + events_by_kind[Crossings::end_minus]),
      touches(events_by_kind[Crossings::touch]),
      bonds(scene.bonds().size()) {}

std::string CrossingCounts::sentence() const {
  const std::string all = counted(bonds, "bond");
  if (crosses + at_ends == 0)
    return fmt::format("none of {} passes through another on the paths between frames", all);
  std::string text =
      fmt::format("frames are too far apart: on the paths between them, {} pass through each other {}", all,
                  counted(crosses, "time"));
  if (at_ends > 0) text += fmt::format(", and an end of one through another {}", counted(at_ends, "time"));
  return text;
}

Json CrossingCounts::json() const {
  return {{"bonds", bonds}, {"crosses", crosses}, {"at_ends", at_ends}, {"touches", touches}};
}

bool has_crossings(const Scene& scene) { return scene.dimension() == 3 && !scene.bonds().empty(); }

CrossingCounts count_crossings(const Scene& scene,
                               const std::function<void(std::size_t, std::size_t)>& progress) {
  ParallelRun run(scene, {.structures = {"crossings"}}, {.threads = all_threads()});
  run.run([&](std::size_t frame) { progress(frame, scene.step_count()); });
  return {scene, run.whole().structures().front()->statistics.events_by_kind};
}

}  // namespace kds
