#include "experiments/compare/compare_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <compare>
#include <utility>

#include "experiments/events/event_places.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_scene.h"
#include "motions/base/input_error.h"

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
  run.apart = options.apart;
  run.directions = options.directions;
  return run;
}

// Returns the number of frames that remain at this stride.
std::size_t strided(std::size_t frames, std::size_t stride) { return (frames + stride - 1) / stride; }

// Reads an input. Throws InputError for an unsuitable input before anything runs.
ComparedInput look_at(const CompareOptions& options, std::size_t input, const Warn& warn) {
  ComparedInput found;
  for (const FrameMotion motion : options.motions) {
    const RunOptions run = run_of(options, input, motion);
    const Scene scene = load_scene(
        run, motion == options.motions.front() ? warn : [](const std::string&) {});
    static_cast<void>(open_run(run, scene, AuditMode::none));
    if (motion != options.motions.front()) continue;
    const auto [least, most] = std::minmax_element(scene.radii().begin(), scene.radii().end());
    found = {run.inputs.front().string(),
             scene.bead_count(),
             scene.frame_count(),
             scene.dimension(),
             scene.is_truncated(),
             *least,
             *most,
             {}};
    for (BeadId bead = 0; bead < scene.bead_count(); ++bead)
      found.bead_names.push_back(scene.bead_name(bead));
  }
  if (strided(found.frames, options.strides.back()) < 2)
    throw InputError(fmt::format("--strides: {} leaves one of the {} frames of {}; expected two or more",
                                 options.strides.back(), found.frames, found.file));
  return found;
}

std::vector<CompareRow> run_once(const RunOptions& options, std::size_t stride,
                                 const std::function<void()>& step_done) {
  const Scene scene = load_scene(options, [](const std::string&) {});
  const auto run = open_run(options, scene, AuditMode::none);
  StepCounts counts(run->session(), scene);
  EventPlaces places(run->session(), scene);
  run->listen(places);
  std::vector<NetChanges> net(run->structures().size());
  run_steps(*run, options, [&](std::size_t frame) {
    for (std::size_t s = 0; s < net.size(); ++s) net[s].add(run->session().elements(s, frame));
    if (frame == 0) return;
    counts.end_step(frame - 1, nullptr);
    step_done();
  });
  const RunReport report = report_of(run->session(), scene, options, counts);
  std::vector<CompareRow> rows;
  for (std::size_t s = 0; s < net.size(); ++s) {
    CompareRow& row = rows.emplace_back();
    row.input = report.files.front();
    row.stride = stride;
    row.motion = options.motion;
    row.steps = scene.step_count();
    if (report.first_frame->picoseconds && report.last_frame->picoseconds)
      row.picoseconds = *report.last_frame->picoseconds - *report.first_frame->picoseconds;
    row.structure = report.structures[s];
    row.net_changes = net[s].count();
    row.structure.places = places.places()[s];
  }
  return rows;
}

}  // namespace

std::uint64_t CompareRow::internal() const {
  std::uint64_t all = 0;
  for (const auto& [kind, count] : structure.events_by_kind) all += count;
  return all - events();
}

std::optional<double> CompareRow::efficiency() const {
  if (net_changes.value_or(0) == 0) return std::nullopt;
  return ratio(events(), static_cast<double>(*net_changes));
}

double CompareRow::events_per_step() const { return ratio(events(), static_cast<double>(steps)); }

std::optional<double> CompareRow::events_per_picosecond() const {
  if (!(picoseconds.value_or(0) > 0)) return std::nullopt;
  return ratio(events(), *picoseconds);
}

std::optional<double> CompareRow::seconds_per_event() const {
  const std::uint64_t all = events() + internal();
  if (all == 0) return std::nullopt;
  return seconds.median / static_cast<double>(all);
}

Comparison compare_runs(const CompareOptions& options,
                        const std::function<void(std::size_t, std::size_t)>& progress, const Warn& warn) {
  for (const auto& input : options.inputs)
    if (is_instance_file(input) && options.motions != std::vector{FrameMotion::linear})
      throw InputError(input.string() + ": an instance file has its own motion; expected no --motions");
  Comparison comparison;
  std::size_t done = 0, total = 0;
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    const ComparedInput& input = comparison.inputs.emplace_back(look_at(options, i, warn));
    for (const std::size_t stride : options.strides)
      total += options.rounds * options.motions.size() * (strided(input.frames, stride) - 1);
  }
  for (std::size_t i = 0; i < options.inputs.size(); ++i)
    for (const FrameMotion motion : options.motions)
      for (const std::size_t stride : options.strides) {
        RunOptions run = run_of(options, i, motion);
        run.reading.frames.stride *= stride;
        if (run.radius == "auto" && !is_instance_file(options.inputs[i]))
          run.radius = fmt::format("{}", comparison.inputs[i].radius_min);
        const std::function<void()> step_done = [&] { progress(++done, total); };
        std::vector<CompareRow> rows = run_once(run, stride, step_done);
        std::vector<std::vector<double>> seconds(rows.size());
        for (std::size_t round = 0;; ++round) {
          for (std::size_t s = 0; s < rows.size(); ++s) seconds[s].push_back(rows[s].structure.seconds);
          if (round + 1 == options.rounds) break;
          rows = run_once(run, stride, step_done);
        }
        for (std::size_t s = 0; s < rows.size(); ++s) {
          rows[s].seconds = spread_of(seconds[s]);
          comparison.rows.push_back(std::move(rows[s]));
        }
      }
  return comparison;
}

}  // namespace kds
