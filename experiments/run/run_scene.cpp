#include "experiments/run/run_scene.h"

#include <fmt/format.h>

#include <optional>

#include "experiments/output/staged_files.h"
#include "experiments/output/text.h"
#include "experiments/program/warnings.h"
#include "experiments/run/event_log_file.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/report_of_session.h"
#include "experiments/run/run_settings.h"
#include "kds/audit.h"
#include "motions/base/input_error.h"
#include "structures/session/session.h"

namespace kds {

namespace {

void write_dump(std::optional<StagedFiles>& dumps, std::size_t frame, Session& session) {
  if (!dumps) return;
  for (const DumpFile& file : session.dump(frame))
    dumps->write(fmt::format("frame-{}.{}", frame, file.ending), file.text);
}

// Structures count steps from 0: messages say which frames of the file these are.
template <class Work>
void in_step(const Scene& scene, std::size_t step, const RunOptions& options, Work work) {
  const auto named = [&](const char* message) {
    return fmt::format("{} (step {} leads from frame {} to frame {})", message, step,
                       scene.frame_number(step), scene.frame_number(step + 1));
  };
  try {
    work();
  } catch (const AuditError& error) {
    throw AuditError(fmt::format("{}\nto see it again: kds run {}", named(error.what()),
                                 shell_words(option_arguments(options))));
  } catch (const InputError& error) {
    throw InputError(named(error.what()));
  }
}

/// What is only known when no step follows is about the last one.
void finish(Session& session, const Scene& scene, const RunOptions& options) {
  if (scene.step_count() == 0) return;
  in_step(scene, scene.step_count() - 1, options, [&] { session.simulator().finish(); });
}

}  // namespace

RunReport run_scene(const RunOptions& options, const Progress& progress,
                    const std::function<void(const std::string&)>& warn) {
  HeldWarnings warnings;
  const Scene scene = load_scene(options, warnings.hold());
  const auto session = open_session(options, scene, options.audit);
  std::optional<EventLogWriter> log;
  if (options.log) {
    log.emplace(*options.log, options, scene);
    session->simulator().listen(*log);
  }

  std::optional<StagedFiles> dumps;
  if (options.dump) dumps.emplace(*options.dump, "--dump");
  session->load(0);
  session->simulator().build();
  warnings.release(warn);
  write_dump(dumps, 0, *session);
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    session->load(step);
    in_step(scene, step, options, [&] { session->simulator().run_step(); });
    write_dump(dumps, step + 1, *session);
    progress(step + 1, scene.step_count());
  }

  finish(*session, scene, options);

  RunReport report = report_of(*session, scene, options);
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
