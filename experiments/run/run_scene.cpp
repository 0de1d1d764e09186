#include "experiments/run/run_scene.h"

#include "experiments/program/warnings.h"
#include "experiments/run/certify_stride.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/report_of_session.h"
#include "experiments/run/watch_exact_work.h"
#include "structures/session/session.h"

namespace kds {

namespace {

/// How far beads may be from where all frames have them; none where the run has them there.
std::optional<double> deviation_of_run(const RunOptions& options, const Scene& scene,
                                       const RunReport& report) {
  if (report.stride) return report.stride->deviation.largest;
  if (options.tolerance) return options.tolerance->length(scene.radii());
  return std::nullopt;
}

}  // namespace

RunReport run_scene(const RunOptions& options, const Progress& progress,
                    const std::function<void(const std::string&)>& warn, RunResults& results) {
  HeldWarnings warnings;
  const Scene scene = load_scene(options, warnings.hold());
  const auto session = open_session(options, scene, options.audit);
  if (!options.quiet) watch_exact_work(session->simulator(), scene, warn);
  StepCounts counts(*session, scene);
  std::optional<ClosestApproachOfRun> approach;
  if (const auto closest = place_of_closest(*session); closest && options.kernel != Kernel::fast)
    approach.emplace(*session, *closest);
  results.begin(scene, *session);
  results.begin_dump_and_log(options, scene, *session);

  run_steps(*session, scene, options, [&](std::size_t frame) {
    if (frame == 0) warnings.release(warn);
    results.add_frame(frame, *session);
    if (approach) frame == 0 ? approach->begin() : approach->end_step(frame - 1);
    if (frame == 0) return;
    counts.end_step(frame - 1, &results);
    progress(frame, scene.step_count());
  });

  RunReport report = report_of(*session, scene, options, counts);
  if (options.certify) report.stride = certify_stride(options, scene);
  if (approach) report.approach = approach->least();
  if (const auto deviation = deviation_of_run(options, scene, report); deviation && report.approach)
    report.approach_in_all_frames = within_deviation(report.approach->distance, *deviation);
  std::vector<double> static_seconds;
  for (std::size_t frame = 0; frame < scene.frame_count(); ++frame)
    session->time_static_builds(frame, static_seconds);
  for (std::size_t s = 0; s < report.structures.size(); ++s)
    report.structures[s].static_seconds = static_seconds[s];
  return report;
}

}  // namespace kds
