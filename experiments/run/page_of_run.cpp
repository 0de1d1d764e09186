#include "experiments/run/page_of_run.h"

#include "experiments/run/load_scene.h"
#include "experiments/run/replay_labels.h"
#include "experiments/run/run_scene.h"
#include "experiments/view/replay_page.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/replay_recorder.h"

namespace kds {

void write_page_of_run(const RunOptions& options, const Scene& scene, const std::filesystem::path& page,
                       AtomicFiles& files, const std::function<void(std::size_t, std::size_t)>& progress) {
  const auto run = open_run(options, scene, AuditMode::none);
  ReplayRecorder recorder(*run);
  run->listen(recorder);
  run_steps(*run, options, [&](std::size_t frame) {
    frame == 0 ? recorder.begin() : recorder.reach_frame();
    progress(frame, scene.step_count());
  });
  write_replay_page(files.open(page), scene, recorder, {replay_labels(options, "view"), {}, {}});
  files.check();
}

}  // namespace kds
