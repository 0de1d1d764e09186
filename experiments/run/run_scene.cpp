#include "experiments/run/run_scene.h"

#include "experiments/program/progress_bar.h"
#include "experiments/run/certify_stride.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/radius_hint.h"
#include "experiments/run/report_of_session.h"
#include "experiments/run/watch_exact_work.h"
#include "structures/session/kinetic_run.h"

namespace kds {

namespace {

/// Returns a bound on the distance of beads from their positions in all frames. Returns nothing if the run
/// passes through all frames exactly, or if frames were left out and never examined.
std::optional<double> deviation_of_run(const RunOptions& options, const Scene& scene,
                                       const RunReport& report) {
  if (report.stride) return report.stride->deviation.largest;
  if (options.tolerance && options.reading.frames.stride == 1)
    return options.tolerance->length(scene.radii());
  return std::nullopt;
}

/// Returns a hint if the automatic radius leaves a run without contacts.
std::optional<std::string> hint_of(const RunOptions& options, const Scene& scene, const RunReport& report) {
  if (options.radius != "auto") return std::nullopt;
  for (const StructureReport& structure : report.structures)
    if (structure.name == "contacts" && structure.events_total == 0 && structure.contacts_at_start == 0U)
      return radius_hint(scene, options.apart.value_or(StructureSettings().apart));
  return std::nullopt;
}

// Seconds of each structure by round: kinetic (`kept`), and built statically at every frame (`built`).
struct Times {
  std::vector<std::vector<double>> kept, built;
};

void add_round(Session& session, const Scene& scene, Times& times) {
  std::vector<double> built;
  for (std::size_t frame = 0; frame < scene.frame_count(); ++frame) session.time_static_builds(frame, built);
  for (std::size_t s = 0; s < times.kept.size(); ++s) {
    times.kept[s].push_back(session.simulator().seconds_of(s));
    times.built[s].push_back(built[s]);
  }
}

void add_times(const Times& times, RunReport& report) {
  for (std::size_t s = 0; s < report.structures.size(); ++s) {
    StructureReport& structure = report.structures[s];
    structure.of_seconds = spread_of(times.kept[s]);
    structure.of_static_seconds = spread_of(times.built[s]);
    structure.seconds = structure.of_seconds.median;
    structure.static_seconds = structure.of_static_seconds.median;
    if (structure.of_static_seconds.least > 0)
      structure.of_ratio = ratios_by_round(times.kept[s], times.built[s]);
  }
}

}  // namespace

RunReport run_scene(const RunOptions& options, const Progress& progress,
                    const std::function<void(const std::string&)>& warn, RunResults& results) {
  HeldWarnings warnings;
  const Scene scene = load_scene(options, warnings.hold());
  const auto run = open_run(options, scene, options.audit);
  if (!options.quiet) watch_exact_work(run->simulator(), scene, warn);
  ProgressWithinSteps within(progress, options.rounds * scene.step_count());
  if (options.audit == AuditMode::events) run->listen(within);
  StepCounts counts(run->session(), scene);
  std::optional<ClosestApproachOfRun> approach;
  if (const auto closest = place_of_closest(run->session()); closest && options.kernel != Kernel::fast)
    approach.emplace(run->session(), *closest);
  results.begin(scene, run->session(), options.certify);
  results.begin_dump_and_log(options, scene, run->session());

  run_steps(*run, options, [&](std::size_t frame) {
    if (frame == 0) warnings.release(warn);
    if (frame == 0) counts.begin();
    results.add_frame(frame, run->session());
    if (approach) frame == 0 ? approach->begin() : approach->end_step(scene.frame_number(frame - 1));
    if (frame == 0) return;
    counts.end_step(frame - 1, &results);
    progress(frame, 0, options.rounds * scene.step_count());
  });

  RunReport report = report_of(run->session(), scene, options, counts);
  if (const auto hint = hint_of(options, scene, report)) warn(*hint);
  if (options.certify) {
    report.stride = certify_stride(options, scene);
    results.add_certificate(*report.stride, scene);
  }
  if (approach) report.approach = approach->least();
  if (const auto deviation = deviation_of_run(options, scene, report); deviation && report.approach)
    report.approach_in_all_frames = within_deviation(report.approach->distance, *deviation);
  Times times{std::vector<std::vector<double>>(report.structures.size()),
              std::vector<std::vector<double>>(report.structures.size())};
  add_round(run->session(), scene, times);
  for (std::size_t round = 1; round < options.rounds; ++round) {
    const auto again = open_run(options, scene, AuditMode::none);
    run_steps(*again, options, [&](std::size_t frame) {
      progress(round * scene.step_count() + frame, 0, options.rounds * scene.step_count());
    });
    add_round(again->session(), scene, times);
  }
  report.rounds = options.rounds;
  add_times(times, report);
  return report;
}

}  // namespace kds
