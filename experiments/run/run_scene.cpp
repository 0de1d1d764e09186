#include "experiments/run/run_scene.h"

#include <optional>

#include "experiments/program/warnings.h"
#include "experiments/run/dumped_frames.h"
#include "experiments/run/event_log_file.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/report_of_session.h"
#include "experiments/run/watch_exact_work.h"
#include "structures/session/session.h"

namespace kds {

RunReport run_scene(const RunOptions& options, const Progress& progress,
                    const std::function<void(const std::string&)>& warn, RunResults* results) {
  HeldWarnings warnings;
  const Scene scene = load_scene(options, warnings.hold());
  const auto session = open_session(options, scene, options.audit);
  std::optional<EventLogWriter> log;
  if (options.log) {
    log.emplace(*options.log, options, scene);
    session->simulator().listen(*log);
  }
  std::optional<DumpedFrames> dumps;
  if (options.dump) dumps.emplace(*options.dump);
  if (!options.quiet) watch_exact_work(session->simulator(), scene, warn);
  StepCounts counts(*session, scene);
  if (results != nullptr) results->begin(scene);

  run_steps(*session, scene, options, [&](std::size_t frame) {
    if (frame == 0) warnings.release(warn);
    if (dumps) dumps->write(frame, session->dump(frame));
    if (frame == 0) return;
    counts.end_step(frame - 1, results);
    progress(frame, scene.step_count());
  });

  RunReport report = report_of(*session, scene, options, counts);
  std::vector<double> static_seconds;
  for (std::size_t frame = 0; frame < scene.frame_count(); ++frame)
    session->time_static_builds(frame, static_seconds);
  for (std::size_t s = 0; s < report.structures.size(); ++s)
    report.structures[s].static_seconds = static_seconds[s];
  if (dumps) dumps->commit();
  if (log) log->commit(report.fingerprint);
  return report;
}

}  // namespace kds
