#include "experiments/compare/compare_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <compare>
#include <exception>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <span>
#include <system_error>
#include <thread>
#include <utility>

#include "experiments/events/event_distribution.h"
#include "experiments/output/text.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_scene.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/frames/frame_fan.h"

namespace kds {

std::uint64_t net_changes(CombinatorialElements before, CombinatorialElements after) {
  std::sort(before.all.begin(), before.all.end());
  std::sort(after.all.begin(), after.all.end());
  const auto place_ids = static_cast<std::ptrdiff_t>(after.place_ids);
  std::uint64_t changes = 0;
  auto a = before.all.begin(), b = after.all.begin();
  while (a != before.all.end() && b != after.all.end()) {
    const std::strong_ordering order = std::lexicographical_compare_three_way(
        a->begin(), a->begin() + place_ids, b->begin(), b->begin() + place_ids);
    changes += *a != *b ? 1 : 0;
    if (order <= 0) ++a;
    if (order >= 0) ++b;
  }
  return changes + static_cast<std::uint64_t>((before.all.end() - a) + (after.all.end() - b));
}

void NetChanges::add(std::optional<CombinatorialElements> frame) {
  if (last_ && frame) count_ += net_changes(std::move(*last_), *frame);
  last_ = std::move(frame);
}

namespace {

using Warn = std::function<void(const std::string&)>;

double ratio(std::uint64_t count, double of) { return static_cast<double>(count) / of; }

// Returns the options of the `kds run` that runs one input.
RunOptions run_of(const CompareOptions& options, std::size_t input, FrameMotion motion) {
  RunOptions run;
  run.inputs = {options.inputs[input]};
  run.structures = options.structures;
  run.motion = motion;
  run.reading = reading_of(options, input);
  run.radius = options.radius;
  run.periodic = options.periodic;
  if (motion == FrameMotion::hermite || std::ranges::count(options.motions, FrameMotion::hermite) == 0)
    run.velocities = options.velocities;
  run.apart = options.apart;
  run.directions = options.directions;
  run.stretch = options.stretch;
  run.probe = options.probe;
  run.threads = options.threads;
  return run;
}

// Returns the number of frames that remain at this stride.
std::size_t strided(std::size_t frames, std::size_t stride) { return (frames + stride - 1) / stride; }

// The names of the inputs, as ComparedInput has them.
class InputNames {
 public:
  // Throws InputError if two inputs are the same run. The inputs must exist or be in memory.
  explicit InputNames(const CompareOptions& options) : options_(options) {
    for (std::size_t i = 0; i < options.inputs.size(); ++i)
      for (std::size_t other = 0; other < i; ++other)
        if (are_one_file(other, i) && chain_of(other) == chain_of(i))
          throw InputError(fmt::format(
              "{} is listed twice; expected different files, or other chains of one file ({} A/B)", name(i),
              "--chain"_arg));
  }

  [[nodiscard]] std::string name(std::size_t input) const {
    return input_name(options_, input) + chain_if_shared(input);
  }
  [[nodiscard]] std::string short_name(std::size_t input) const {
    const std::filesystem::path file = options_.inputs[input].filename();
    for (std::size_t other = 0; other < options_.inputs.size(); ++other)
      if (options_.inputs[other].filename() == file && !are_one_file(other, input)) return name(input);
    return file.string() + chain_if_shared(input);
  }

 private:
  [[nodiscard]] bool are_one_file(std::size_t a, std::size_t b) const {
    std::error_code ignored;  // inputs in memory have no file
    return options_.inputs[a] == options_.inputs[b] ||
           std::filesystem::equivalent(options_.inputs[a], options_.inputs[b], ignored);
  }
  [[nodiscard]] std::optional<std::string> chain_of(std::size_t input) const {
    return reading_of(options_, input).chain;
  }
  [[nodiscard]] std::string chain_if_shared(std::size_t input) const {
    const std::optional<std::string> chain = chain_of(input);
    for (std::size_t other = 0; other < options_.inputs.size(); ++other)
      if (chain && other != input && are_one_file(other, input)) return fmt::format(" (chain {})", *chain);
    return "";
  }

  const CompareOptions& options_;
};

ComparedInput described(const RunOptions& run, const Scene& scene, const InputNames& names,
                        std::size_t input) {
  const auto [least, most] = std::minmax_element(scene.radii().begin(), scene.radii().end());
  ComparedInput found{input_name(run, 0),
                      names.name(input),
                      names.short_name(input),
                      scene.bead_count(),
                      scene.frame_count(),
                      scene.dimension(),
                      scene.is_truncated(),
                      *least,
                      *most};
  const auto from = scene.stamp(0).picoseconds, to = scene.stamp(scene.frame_count() - 1).picoseconds;
  if (from && to && scene.step_count() > 0)
    found.frame_picoseconds = (*to - *from) / static_cast<double>(scene.step_count());
  for (BeadId bead = 0; bead < scene.bead_count(); ++bead) found.bead_names.push_back(scene.bead_name(bead));
  return found;
}

// Reads an input. Throws InputError for an unsuitable input before anything runs.
ComparedInput look_at(const CompareOptions& options, std::size_t input, const InputNames& names,
                      const Warn& warn) {
  ComparedInput found;
  std::vector<std::string> said;
  const Warn once = [&](const std::string& line) {
    if (std::ranges::count(said, line) == 0) warn(said.emplace_back(line));
  };
  for (const FrameMotion motion : options.motions) {
    const RunOptions run = run_of(options, input, motion);
    const Scene scene = load_scene(run, once);
    try {
      static_cast<void>(open_run(run, scene, AuditMode::none));
    } catch (const InputError& error) {
      if (options.inputs.size() == 1) throw;
      throw InputError(fmt::format("{}: {}", input_name(run, 0), error.what()));
    }
    if (motion == options.motions.front()) found = described(run, scene, names, input);
    if (scene.velocities()) found.velocities = scene.velocities();
  }
  if (strided(found.frames, options.strides.back()) < 2)
    throw InputError("--strides", fmt::format("{} leaves one of the {} frames of {}; expected two or more",
                                              options.strides.back(), found.frames, found.file));
  hint_at_threads(options.threads, strided(found.frames, options.strides.front()) - 1, found.beads, warn,
                  options.inputs.size() > 1 ? found.short_name + ": " : "");
  return found;
}

// Collects the beads of the events of each structure.
class ChangedBeads final : public EventListener {
 public:
  explicit ChangedBeads(std::size_t structures) : beads_(structures) {}
  void on_event(const Event& event) override {
    const auto ids = event.ids();
    beads_[event.structure_index].insert(beads_[event.structure_index].end(), ids.begin(), ids.end());
  }
  [[nodiscard]] std::vector<BeadId>& of(std::size_t structure) { return beads_[structure]; }

 private:
  std::vector<std::vector<BeadId>> beads_;
};

// The counts of a structure up to now.
struct Done {
  std::uint64_t events = 0, created = 0, alive = 0;
  double seconds = 0;
};

Done done_by(const KineticRun& run, double seconds, std::size_t s) {
  const KineticStructure& structure = *run.structures()[s];
  const StructureStatistics& statistics = structure.statistics;
  Done done{0, statistics.certificates.created, statistics.certificates.alive, seconds};
  for (std::size_t k = 0; k < structure.kinds().size(); ++k)
    if (!structure.kinds()[k].counted_apart) done.events += statistics.events_by_kind[k];
  return done;
}

void add_difference(const Done& before, const Done& after, EventCosts& costs) {
  const std::uint64_t created = after.created - before.created;
  const std::uint64_t touched = created + (before.alive + created - after.alive);
  const double seconds = after.seconds - before.seconds;
  costs.events += after.events - before.events;
  costs.created += created;
  costs.touched += touched;
  costs.touched_most = std::max(costs.touched_most, touched);
  costs.seconds += seconds;
  costs.seconds_most = std::max(costs.seconds_most, seconds);
}

// Runs once without looking at single events.
std::vector<CompareRow> run_once(const Scene& scene, const RunOptions& options,
                                 const std::function<void()>& step_done) {
  ParallelOptions parallel;
  parallel.elements = true;
  const auto run = open_parallel_run(options, scene, AuditMode::none, parallel, [](const std::string&) {});
  KineticRun& whole = run->whole();
  StepCounts counts(whole, scene);
  EventDistributions distributions(whole, scene);
  run->listen(distributions);
  std::vector<NetChanges> net(whole.structures().size());
  std::vector<CompareRow> rows(net.size());
  run_steps(*run, options, [&](std::size_t frame) {
    for (std::size_t s = 0; s < net.size(); ++s) {
      const std::uint64_t before = net[s].count().value_or(0);
      net[s].add(whole.elements(s, frame));
      if (frame == 0) continue;
      rows[s].events_of_steps.push_back(
          static_cast<double>(whole.structures()[s]->statistics.events_per_step.back()));
      if (const auto count = net[s].count())
        rows[s].net_changes_of_steps.push_back(static_cast<double>(*count - before));
    }
    if (frame == 0) return;
    counts.end_step(frame - 1, nullptr);
    step_done();
  });
  const RunReport report = report_of(whole, scene, options, counts);
  for (std::size_t s = 0; s < net.size(); ++s) {
    CompareRow& row = rows[s];
    const bool has_own_motion = !options.inputs.empty() && is_instance_file(options.inputs.front());
    if (!has_own_motion) row.motion = options.motion;
    row.beads = scene.bead_count();
    row.steps = scene.step_count();
    if (report.first_frame && report.first_frame->picoseconds && report.last_frame->picoseconds)
      row.picoseconds = *report.last_frame->picoseconds - *report.first_frame->picoseconds;
    row.structure = report.structures[s];
    row.net_changes = net[s].count();
    row.structure.distribution = distributions.distributions()[s];
  }
  return rows;
}

std::optional<double> per(double count, std::uint64_t of) {
  return of == 0 ? std::nullopt : std::optional(count / static_cast<double>(of));
}

double mean_of_steps(std::span<const double> steps) {
  return std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size());
}

std::size_t quarter(std::size_t steps) { return std::max<std::size_t>(1, steps / 4); }

}  // namespace

std::string CompareRow::motion_name() const { return motion ? std::string(name_of(*motion)) : "own"; }

std::vector<EventCosts> costs_of_events(KineticRun& run, const std::function<void()>& step_done) {
  const std::size_t structures = run.structures().size();
  std::vector<EventCosts> costs(structures);
  ChangedBeads changed(structures);
  run.listen(changed);
  run.follow_certificates();
  std::vector<Done> before(structures);
  const auto now = [&](std::size_t s) { return done_by(run, run.simulator().seconds_of(s), s); };
  while (run.enter_step()) {
    for (std::size_t s = 0; s < structures; ++s) {
      changed.of(s).clear();
      run.count_certificates(s, {});
      before[s] = now(s);
    }
    while (run.simulator().run_next()) {
      for (std::size_t s = 0; s < structures; ++s) {
        const Done after = now(s);
        if (after.events == before[s].events && after.created == before[s].created) continue;
        add_difference(before[s], after, costs[s]);
        run.count_certificates(s, changed.of(s));
        changed.of(s).clear();
        before[s] = now(s);
      }
    }
    static_cast<void>(run.run_step());
    step_done();
  }
  run.finish();
  for (std::size_t s = 0; s < structures; ++s)
    costs[s].per_bead_most = run.structures()[s]->statistics.certificates.per_bead_max;
  return costs;
}

namespace {

// The rows of the first round, with the times of all rounds.
class RowsOfRounds {
 public:
  void add(std::vector<CompareRow> plain, const std::vector<EventCosts>& costs) {
    for (auto* const times : {&seconds_, &at_events_, &worst_}) times->resize(plain.size());
    for (std::size_t s = 0; s < plain.size(); ++s) {
      seconds_[s].push_back(plain[s].structure.seconds);
      at_events_[s].push_back(costs[s].seconds);
      worst_[s].push_back(costs[s].seconds_most);
      plain[s].costs = costs[s];
    }
    if (rows_.empty()) rows_ = std::move(plain);
  }
  [[nodiscard]] std::vector<CompareRow> rows() && {
    for (std::size_t s = 0; s < rows_.size(); ++s) {
      rows_[s].seconds = spread_of(seconds_[s]);
      rows_[s].costs.seconds = median_of(at_events_[s]);
      rows_[s].costs.seconds_most = *std::ranges::min_element(worst_[s]);
    }
    return std::move(rows_);
  }

 private:
  std::vector<CompareRow> rows_;
  std::vector<std::vector<double>> seconds_, at_events_, worst_;
};

}  // namespace

std::vector<CompareRow> measure_runs(const Scene& scene, const RunOptions& options, std::size_t rounds,
                                     const std::function<void()>& step_done) {
  RowsOfRounds all;
  for (std::size_t round = 0; round < rounds; ++round) {
    std::vector<CompareRow> plain = run_once(scene, options, step_done);
    all.add(std::move(plain), costs_of_events(*open_run(options, scene, AuditMode::none), step_done));
  }
  return std::move(all).rows();
}

std::uint64_t CompareRow::internal() const {
  std::uint64_t all = 0;
  for (const auto& [kind, count] : structure.events_by_kind) all += count;
  return all - events();
}

std::optional<double> CompareRow::efficiency() const {
  return per(static_cast<double>(events() + internal()), events());
}

std::optional<double> CompareRow::events_per_net_change() const {
  return per(static_cast<double>(events()), net_changes.value_or(0));
}

double CompareRow::events_per_step() const { return ratio(events(), static_cast<double>(steps)); }

std::optional<MeanInterval> CompareRow::events_per_step_interval() const {
  return above_zero(mean_over_time(events_of_steps));
}

std::optional<MeanInterval> CompareRow::events_per_net_change_interval() const {
  return above_zero(ratio_over_time(events_of_steps, net_changes_of_steps));
}

double CompareRow::events_per_step_in_first_quarter() const {
  return mean_of_steps(std::span(events_of_steps).first(quarter(steps)));
}

double CompareRow::events_per_step_in_last_quarter() const {
  return mean_of_steps(std::span(events_of_steps).last(quarter(steps)));
}

std::optional<double> CompareRow::events_per_picosecond() const {
  if (!(picoseconds.value_or(0) > 0)) return std::nullopt;
  return ratio(events(), *picoseconds);
}

double CompareRow::events_per_bead_and_step() const { return events_per_step() / static_cast<double>(beads); }

std::optional<double> CompareRow::events_per_bead_and_picosecond() const {
  const auto all = events_per_picosecond();
  return all ? std::optional(*all / static_cast<double>(beads)) : std::nullopt;
}

std::optional<double> CompareRow::created_per_event() const {
  return per(static_cast<double>(costs.created), costs.events);
}

std::optional<double> CompareRow::touched_per_event() const {
  return per(static_cast<double>(costs.touched), costs.events);
}

std::optional<double> CompareRow::responsiveness() const { return per(costs.seconds, costs.events); }

std::string size_text(const ComparedInput& input) {
  return fmt::format("{} beads, {} frames {}", with_thousands(input.beads), with_thousands(input.frames),
                     input.frame_picoseconds
                         ? fmt::format("{:.4g} ps apart", *input.frame_picoseconds)
                         : fmt::format("at times that the file does not tell ({} gives them)", "--dt"_arg));
}

namespace {

// Returns nothing for fewer than two values, and no interval for two.
std::optional<PooledMean> pooled_mean(std::span<const double> values) {
  const auto interval = mean_of_independent(values);
  if (!interval) return std::nullopt;
  return PooledMean{interval->mean, values.size() < least_pooled ? std::nullopt : above_zero(interval)};
}

}  // namespace

std::vector<PooledRow> pooled_rows(const Comparison& comparison) {
  std::vector<PooledRow> pooled;
  if (comparison.inputs.size() < 2) return pooled;
  const auto is_pooled_in = [](const CompareRow& row) {
    return [&row](const PooledRow& one) {
      return one.structure == row.structure.name && one.stride == row.stride &&
             one.motion == row.motion_name();
    };
  };
  for (const CompareRow& first : comparison.rows) {
    if (std::ranges::any_of(pooled, is_pooled_in(first))) continue;
    PooledRow& one = pooled.emplace_back(PooledRow{first.structure.name, first.stride, first.motion_name()});
    std::vector<double> steps, bead_steps, bead_picoseconds, net;
    for (const CompareRow& row : comparison.rows) {
      if (!is_pooled_in(row)(one)) continue;
      ++one.inputs;
      steps.push_back(row.events_per_step());
      bead_steps.push_back(row.events_per_bead_and_step());
      if (const auto value = row.events_per_bead_and_picosecond()) bead_picoseconds.push_back(*value);
      if (const auto value = row.events_per_net_change()) net.push_back(*value);
    }
    one.events_per_step = pooled_mean(steps);
    one.events_per_bead_and_step = pooled_mean(bead_steps);
    one.events_per_bead_and_picosecond = pooled_mean(bead_picoseconds);
    one.events_per_net_change = pooled_mean(net);
  }
  return pooled;
}

namespace {

/// Returns the options of one of the runs.
RunOptions strided_run(const CompareOptions& options, const Comparison& comparison, std::size_t input,
                       FrameMotion motion, std::size_t stride) {
  RunOptions run = run_of(options, input, motion);
  run.reading.frames.stride *= stride;
  if (motion == FrameMotion::hermite) run.velocities = comparison.inputs[input].velocities;
  if (run.radius == "auto" && !is_instance_file(options.inputs[input]))
    run.radius = fmt::format("{}", comparison.inputs[input].radius_min);
  return run;
}

}  // namespace

RunOptions first_run(const CompareOptions& options, const Comparison& comparison) {
  RunOptions run = strided_run(options, comparison, 0, options.motions.front(), options.strides.front());
  run.threads.reset();
  return run;
}

namespace {

// Runs all motions and strides at once over a running simulation. Each has two runs, each on its own thread:
// one counts events, the other measures event by event.
Comparison compare_live(const CompareOptions& options, const Warn& warn) {
  if (options.inputs.size() > 1)
    throw InputError(fmt::format("{}: a running simulation is compared alone; expected no other input",
                                 file_names(options)));
  struct OneRun {
    RunOptions options;
    std::size_t stride = 1;
    bool event_by_event = false;
    std::unique_ptr<FrameSource> frames;
    std::unique_ptr<Scene> scene;
    std::vector<CompareRow> rows;   // unless event by event
    std::vector<EventCosts> costs;  // if event by event
    std::vector<std::string> warnings;
  };
  RunOptions first = run_of(options, 0, options.motions.front());
  first.velocities = options.velocities;
  first.takes_live = true;
  warn_of_threads(options.threads, warn);
  LiveInput live = open_live(first, warn);
  const LiveClock clock(live.frames->live());
  FrameFan fan(*live.frames);
  std::vector<OneRun> runs;
  for (const FrameMotion motion : options.motions)
    for (const std::size_t stride : options.strides)
      for (const bool event_by_event : {false, true}) {
        OneRun& run = runs.emplace_back();
        run.options = run_of(options, 0, motion);
        run.options.threads = 1;
        run.stride = stride;
        run.event_by_event = event_by_event;
        run.frames = fan.branch(stride);
      }
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&](OneRun& run) {
    try {
      try {
        run.scene = std::make_unique<Scene>(
            scene_of_run(run.options, std::move(run.frames), live.survey, live.radii,
                         [&run](const std::string& line) { run.warnings.push_back(line); }));
      } catch (const InputError&) {
        if (run.stride == options.strides.front()) throw;
        return;  // fewer than two frames; any other fault also befalls the smallest stride
      }
      if (run.event_by_event) {
        run.costs = costs_of_events(*open_run(run.options, *run.scene, AuditMode::none), [] {});
      } else {
        run.rows = run_once(*run.scene, run.options, [] {});
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
      fan.stop();
    }
  };
  warn(fmt::format("times are those of {} runs at once on {}; to compare times, compare a file", runs.size(),
                   counted(all_threads(), "core")));
  std::vector<std::thread> threads;
  std::exception_ptr interrupted;
  std::size_t frames = 0;
  try {
    for (OneRun& run : runs) threads.emplace_back([&work, &run] { work(run); });
    frames = fan.pump();
  } catch (...) {
    interrupted = std::current_exception();
    fan.stop();
  }
  for (std::thread& thread : threads) thread.join();
  if (error) std::rethrow_exception(error);
  if (interrupted) std::rethrow_exception(interrupted);

  Comparison comparison;
  comparison.inputs.push_back(described(first, *runs.front().scene, InputNames(options), 0));
  ComparedInput& input = comparison.inputs.front();
  input.truncated = live.frames->is_truncated();
  input.frames = frames;
  if (input.frame_picoseconds) *input.frame_picoseconds /= static_cast<double>(options.strides.front());
  comparison.live = clock.run(true, live.frames->live());
  for (std::size_t i = 0; i < runs.size(); i += 2) {
    if (!runs[i].scene || !runs[i + 1].scene) {
      warn(fmt::format("{} {}: sees fewer than two frames and is left out", "--strides"_arg, runs[i].stride));
      continue;
    }
    RowsOfRounds rounds;
    rounds.add(std::move(runs[i].rows), runs[i + 1].costs);
    for (CompareRow& row : std::move(rounds).rows()) {
      row.input = input.name;
      row.stride = runs[i].stride;
      comparison.rows.push_back(std::move(row));
    }
    if (runs[i].scene->velocities()) input.velocities = runs[i].scene->velocities();
  }
  for (const std::string& line : runs.front().warnings) warn(line);
  for (const std::string& line : live.frames->warnings()) warn(line);
  return comparison;
}

}  // namespace

Comparison compare_runs(const CompareOptions& options,
                        const std::function<void(std::size_t, std::size_t)>& progress, const Warn& warn) {
  if (is_live(options)) return compare_live(options, warn);
  for (const auto& input : options.inputs)
    if (is_instance_file(input) && options.motions != std::vector{FrameMotion::linear})
      throw InputError(input.string() +
                       fmt::format(": an instance file has its own motion; expected no {}", "--motions"_arg));
  const InputNames names(options);
  Comparison comparison;
  std::size_t done = 0, total = 0;
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    const ComparedInput& input = comparison.inputs.emplace_back(look_at(options, i, names, warn));
    for (const std::size_t stride : options.strides)
      total += 2 * options.rounds * options.motions.size() * (strided(input.frames, stride) - 1);
  }
  for (std::size_t i = 0; i < options.inputs.size(); ++i)
    for (const FrameMotion motion : options.motions)
      for (const std::size_t stride : options.strides) {
        const RunOptions run = strided_run(options, comparison, i, motion, stride);
        const Scene scene = load_scene(run, [](const std::string&) {});
        for (CompareRow& row : measure_runs(scene, run, options.rounds, [&] { progress(++done, total); })) {
          row.input = comparison.inputs[i].name;
          row.stride = stride;
          comparison.rows.push_back(std::move(row));
        }
      }
  return comparison;
}

}  // namespace kds
