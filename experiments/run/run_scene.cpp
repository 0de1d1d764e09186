#include "experiments/run/run_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

#include "experiments/output/text.h"
#include "experiments/program/progress_bar.h"
#include "experiments/run/certify_stride.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/radius_hint.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "kds/kinetic_structure.h"
#include "motions/base/input_error.h"
#include "structures/session/kinetic_run.h"

namespace kds {

namespace {

class WorkWatcher {
 public:
  WorkWatcher(Simulator& simulator, const Scene& scene, std::function<void(const std::string&)> warn,
              std::uint64_t extraordinary)
      : simulator_(simulator), scene_(scene), warn_(std::move(warn)), extraordinary_(extraordinary) {}

  void operator()() {
    ExactWork& work = simulator_.exact_work();
    if (simulator_.moment() != moment_) {
      moment_ = simulator_.moment();
      before_ = work.done();
    }
    if (work.done() - before_ < extraordinary_ || work.done() < next_) return;
    next_ = 2 * work.done();
    const std::size_t step = std::min(simulator_.step(), scene_.step_count() - 1);
    warn_(fmt::format(
        "step {} (from frame {} to frame {}) has taken {} limb operations of exact arithmetic at one time "
        "near u = {}, now on {}; {} LIMIT ends a run that takes too many",
        step, scene_.frame_number(step), scene_.frame_number(step + 1), with_thousands(work.done() - before_),
        simulator_.now().lower(), simulator_.name_of_work(work.subject()), "--work"_arg));
  }

 private:
  Simulator& simulator_;
  const Scene& scene_;
  std::function<void(const std::string&)> warn_;
  std::uint64_t extraordinary_;
  std::uint64_t moment_ = 0, before_ = 0, next_ = 0;
};

// Runs `work`. Turns WorkLimitReached into an InputError that names the computation which used the last of
// the allowed work.
template <class Work>
void with_limit(KineticRun& run, const RunOptions& options, Work work) {
  try {
    work();
  } catch (const WorkLimitReached& limit) {
    throw InputError(
        fmt::format("{} {}: exact arithmetic takes more limb operations than that, the last on {}",
                    "--work"_arg, options.work.value_or(0), run.simulator().name_of_work(limit.subject())));
  }
}

// Runs `work`, which belongs to a step. Structures count steps from 0, so the message of an exception is
// extended by the step's frame numbers in the file.
template <class Work>
void in_step(KineticRun& run, std::size_t step, const RunOptions& options, Work work) {
  const auto named = [&](std::string_view message) {
    return fmt::format("{} (step {} leads from frame {} to frame {})", message, step,
                       run.scene().frame_number(step), run.scene().frame_number(step + 1));
  };
  try {
    with_limit(run, options, work);
  } catch (const AuditError& error) {
    throw AuditError(fmt::format("{}\nto see it again: kds run {}", named(error.what()),
                                 shell_words(repeating_arguments(options))));
  } catch (const InputError& error) {
    throw InputError(named(error.what()));
  }
}

/// Returns a bound on the distance of beads from their positions in all frames. Returns nothing if the run
/// passes through all frames exactly, or if frames were left out and never examined.
std::optional<double> deviation_of_run(const RunOptions& options, const Scene& scene,
                                       const RunReport& report) {
  if (report.stride) return report.stride->deviation.largest;
  if (options.tolerance && options.reading.frames.stride == 1)
    return options.tolerance->length(scene.radii());
  return std::nullopt;
}

/// Returns a hint if the cutoff or the automatic radius leaves a run without contacts.
std::optional<std::string> hint_of(const RunOptions& options, const Scene& scene, const RunReport& report) {
  const auto distance = options.distances.first();
  if (!distance && options.radius != "auto") return std::nullopt;
  if (!options.reading.groups.empty()) return std::nullopt;  // the hint counts pairs of all beads
  const auto has_none = [](const StructureReport& structure) {
    return structure.name == "contacts" && structure.events_total == 0 && structure.contacts_at_start == 0U;
  };
  if (std::ranges::none_of(report.structures, has_none)) return std::nullopt;
  const BeadId apart = options.apart.value_or(StructureSettings().apart);
  if (!distance) return radius_hint(scene, apart);
  const auto hint = cutoff_hint(scene, distance->between_surfaces, apart);
  return hint ? std::optional(fmt::format("contacts: there are none within {} {}; {}", "--cutoff"_arg,
                                          distance->length, *hint))
              : std::nullopt;
}

// Seconds of each structure by round: kinetic (`kept`), and built statically at every frame (`built`).
struct Times {
  std::vector<std::vector<double>> kept, built;
};

// Frames of a live scene are gone when static builds would need them.
void add_round(ParallelRun& run, Times& times) {
  const std::vector<double> built =
      run.scene().is_live() ? std::vector<double>(times.built.size()) : run.static_seconds();
  for (std::size_t s = 0; s < times.kept.size(); ++s) {
    times.kept[s].push_back(run.simulator().seconds_of(s));
    times.built[s].push_back(built[s]);
  }
}

// Follows the closest approach in a part of a run.
class ApproachOfPart final : public FrameObserver {
 public:
  ApproachOfPart(KineticRun& part, std::size_t closest) : part_(part), approach_(part, closest) {}
  void at_frame(std::size_t frame) override {
    began_ ? approach_.end_step(part_.scene().frame_number(frame - 1)) : approach_.begin();
    began_ = true;
  }
  [[nodiscard]] std::optional<ClosestApproach> least() const { return approach_.least(); }

 private:
  KineticRun& part_;
  ClosestApproachOfRun approach_;
  bool began_ = false;
};

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

void watch_exact_work(Simulator& simulator, const Scene& scene,
                      const std::function<void(const std::string&)>& warn, std::uint64_t extraordinary) {
  simulator.exact_work().set_watcher(WorkWatcher(simulator, scene, warn, extraordinary),
                                     extraordinary / 16 + 1);
}

void watch_exact_work(ParallelRun& run, const std::function<void(const std::string&)>& warn) {
  const auto mutex = std::make_shared<std::mutex>();
  run.prepare([mutex, warn](KineticRun& part) {
    watch_exact_work(part.simulator(), part.scene(), [mutex, warn](const std::string& warning) {
      const std::lock_guard lock(*mutex);
      warn(warning);
    });
  });
}

StepCounts::StepCounts(KineticRun& run, const Scene& scene)
    : run_(run),
      scene_(scene),
      courses_(run.structures().size(),
               EventCourse(scene.is_live() ? 1 : bin_width(scene.step_count(), EventCourse::most_bins))) {}

void StepCounts::begin() { contacts_at_start_ = contacts_at(run_, 0); }

void StepCounts::end_step(std::size_t step, RunResults* results) {
  const FrameStamp stamp = scene_.stamp(step);
  ++steps_;
  for (std::size_t s = 0; s < courses_.size(); ++s) {
    KineticStructure& structure = *run_.structures()[s];
    std::vector<std::uint64_t>& events_per_step = structure.statistics.events_per_step;
    const std::uint64_t events = events_per_step.empty() ? 0 : events_per_step.back();
    events_per_step.clear();
    courses_[s].add(events, stamp);
    events_ += events;
    if (results != nullptr) results->add_step(stamp, structure.name(), events);
  }
}

void run_steps(KineticRun& run, const RunOptions& options,
               const std::function<void(std::size_t frame)>& at_frame) {
  if (options.work) run.limit_work(*options.work);
  with_limit(run, options, [&] { run.build(); });
  at_frame(0);
  for (std::size_t step = 0; run.load_step(); ++step) {
    in_step(run, step, options, [&] { run.run_step(); });
    at_frame(step + 1);
  }
  // An error that can occur only after all steps is reported for the last step.
  in_step(run, run.scene().step_count() - 1, options, [&] { run.finish(); });
}

void run_steps(ParallelRun& run, const RunOptions& options,
               const std::function<void(std::size_t frame)>& at_frame) {
  run.run(at_frame,
          [&](KineticRun& part, std::optional<std::size_t> step, const std::function<void()>& work) {
            step ? in_step(part, *step, options, work) : with_limit(part, options, work);
          });
}

void follow_approach(ParallelRun& run) {
  const auto closest = index_of_closest(run.whole());
  if (closest)
    run.observe([at = *closest](KineticRun& part) { return std::make_unique<ApproachOfPart>(part, at); });
}

std::optional<ClosestApproach> followed_approach(const ParallelRun& run) {
  std::optional<ClosestApproach> least;
  for (const auto& observer : run.observers())
    least = closer(least, static_cast<const ApproachOfPart&>(*observer).least());
  return least;
}

void complete_report(const RunOptions& options, const Scene& scene,
                     const std::optional<ClosestApproach>& approach,
                     const std::function<void(const std::string&)>& warn, RunReport& report) {
  if (const auto hint = hint_of(options, scene, report)) warn(*hint);
  if (options.certify) report.stride = certify_stride(options, scene);
  report.approach = approach;
  if (const auto deviation = deviation_of_run(options, scene, report); deviation && approach)
    report.approach_in_all_frames = within_deviation(approach->distance, *deviation);
}

RunReport run_scene(const RunOptions& options, const Progress& progress,
                    const std::function<void(const std::string&)>& warn, RunResults& results,
                    const LiveHooks<RunReport>& hooks) {
  HeldWarnings warnings;
  const Scene scene = load_scene(options, warnings.hold());
  return run_over(scene, warnings, options, progress, warn, results, hooks);
}

RunReport run_over(const Scene& scene, HeldWarnings& warnings, const RunOptions& options,
                   const Progress& progress, const std::function<void(const std::string&)>& warn,
                   RunResults& results, const LiveHooks<RunReport>& hooks) {
  ParallelOptions parallel;
  parallel.dumps = options.dump.has_value();
  parallel.static_builds = true;
  const auto run = open_parallel_run(options, scene, options.audit, parallel, warn);
  if (!options.quiet) watch_exact_work(*run, warn);
  const std::size_t total = scene.is_live() ? 0 : options.rounds * scene.step_count();
  ProgressWithinSteps within(progress, total);
  if (options.audit == AuditMode::events && !scene.is_live()) run->listen(within);
  StepCounts counts(run->whole(), scene);
  follow_approach(*run);
  results.begin(scene, run->whole(), options);
  results.begin_dump_and_log(options, scene, run->whole());
  const LiveProgress live(scene);
  const auto report_so_far = [&](bool is_complete) {
    RunReport report = report_of(run->whole(), scene, options, counts);
    report.threads = run->threads();
    report.parts = run->parts();
    report.approach = followed_approach(*run);
    if (scene.is_live()) report.live = live.run(is_complete);
    return report;
  };
  if (hooks.describe && scene.is_live())
    hooks.describe([&] {
      return live.state(counts.steps(), counts.events(), "events", contacts_at(run->whole(), counts.steps()));
    });

  run_steps(*run, options, [&](std::size_t frame) {
    if (frame == 0) warnings.release(warn);
    if (frame == 0) counts.begin();
    results.add_frame(frame, run->whole());
    if (frame == 0) return;
    counts.end_step(frame - 1, &results);
    progress(frame, 0, total);
    if (hooks.at_frame && scene.is_live()) hooks.at_frame([&] { return report_so_far(false); });
  });

  results.end_run();
  RunReport report = report_so_far(true);
  for (const std::string& line : scene.live_warnings()) warn(line);
  complete_report(options, scene, report.approach, warn, report);
  if (report.stride) results.add_certificate(*report.stride, scene);
  Times times{std::vector<std::vector<double>>(report.structures.size()),
              std::vector<std::vector<double>>(report.structures.size())};
  add_round(*run, times);
  for (std::size_t round = 1; round < options.rounds; ++round) {
    const auto again =
        open_parallel_run(options, scene, AuditMode::none, parallel, [](const std::string&) {});
    run_steps(*again, options,
              [&](std::size_t frame) { progress(round * scene.step_count() + frame, 0, total); });
    add_round(*again, times);
  }
  report.rounds = options.rounds;
  add_times(times, report);
  return report;
}

}  // namespace kds
