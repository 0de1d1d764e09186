#include "experiments/collide/missed_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "experiments/contacts/follow_contacts.h"
#include "experiments/output/table.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/mean_interval.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/radius_hint.h"
#include "experiments/run/run_scene.h"
#include "motions/base/input_error.h"
#include "structures/contacts/contact_intervals.h"
#include "structures/contacts/frame_contacts.h"

namespace kds {

namespace {

/// The rule by which two beads are in contact in one run: their balls meet, with radii times `factor`, or
/// their distance is at most `cutoff`.
struct MissedRule {
  double factor = 1;
  std::optional<double> cutoff = {};
};

/// The result of one stride of one run.
struct MissedRow {
  MissedRule rule;
  std::size_t stride = 1;
  std::size_t frames = 0;  ///< number of frames examined
  std::uint64_t contacts = 0, found = 0;
  /// The interval of the share that is missed, from ratio_over_time over the steps in which contacts begin.
  /// Empty for fewer than 50 steps, and if no contact or every contact is missed.
  std::optional<MeanInterval> interval = {};

  [[nodiscard]] std::uint64_t missed() const { return contacts - found; }
};

/// Returns the interval of sum(missed) / sum(contacts). A share is at most 1.
std::optional<MeanInterval> interval_of_share(std::span<const double> missed,
                                              std::span<const double> contacts) {
  auto interval = above_zero(ratio_over_time(missed, contacts));
  if (interval) interval->upper = std::min(interval->upper, 1.0);
  return interval;
}

struct MissedReport {
  InputSize input;
  double radius_min = 0, radius_max = 0;  ///< of the radius policy, without the factor
  std::vector<MissedRow> rows;            ///< ordered by factor or cutoff, then by stride
};

/// Returns the rows of one rule, by stride.
std::vector<MissedRow> rows_of(const MissedTask& task, const Scene& scene, const MissedRule& rule,
                               std::span<const std::size_t> strides,
                               const std::function<void(std::size_t)>& at_frame) {
  RunOptions options;
  options.inputs = task.inputs;
  options.structures = {"contacts"};
  options.motion = task.motion;
  options.apart = task.apart;
  if (rule.cutoff) options.distances = {{*rule.cutoff}, task.distances.between_surfaces};
  const auto run = open_run(options, scene, AuditMode::none);
  std::vector<std::size_t> spacings;
  for (const std::size_t stride : strides) spacings.push_back(stride * ticks_per_frame);
  FrameContacts frames(spacings, 0);
  // Contacts by the step in which they begin. `missed` has such counts for each stride.
  std::vector<double> contacts(scene.step_count());
  std::vector<std::vector<double>> missed(strides.size(), contacts);
  ContactIntervals intervals(run->simulator(), {.rounds_times = false}, [&](const ContactInterval& interval) {
    std::vector<std::uint64_t> found;
    for (const FrameContacts::Row& row : frames.rows()) found.push_back(row.found);
    frames.add_inner(interval);
    const std::size_t step = std::min(interval.begin.step, scene.step_count() - 1);
    contacts[step] += 1;
    for (std::size_t k = 0; k < strides.size(); ++k)
      missed[k][step] += frames.rows()[k].found == found[k] ? 1 : 0;
  });
  run->listen(intervals);
  run_steps(*run, options, [&](std::size_t frame) {
    if (frame == 0) {
      std::vector<BeadPair> at_start;
      for (const Event& event : run->built(0)) at_start.push_back({event.ids()[0], event.ids()[1]});
      intervals.add_built(at_start, at_start, scene.stamp(0), scene.stamp(1));
    }
    at_frame(frame);
  });
  intervals.finish(scene.step_count() - 1, scene.stamp(scene.step_count() - 1),
                   scene.stamp(scene.step_count()));
  frames.finish(scene.step_count());
  std::vector<MissedRow> rows;
  for (std::size_t k = 0; k < strides.size(); ++k) {
    const FrameContacts::Row& row = frames.rows()[k];
    rows.push_back({rule, strides[k], row.sampling.samples, frames.exact(FrameContacts::plain).contacts,
                    row.found, interval_of_share(missed[k], contacts)});
  }
  return rows;
}

std::vector<MissedRule> rules_of(const MissedTask& task) {
  std::vector<MissedRule> rules;
  for (const double cutoff : task.distances.lengths) rules.push_back({1, cutoff});
  if (rules.empty())
    for (const double factor : task.factors) rules.push_back({factor});
  return rules;
}

/// Returns a hint for a run without contacts.
std::optional<std::string> hint_of(const MissedTask& task, const Scene& scene, const MissedRule& rule) {
  if (!task.reading.groups.empty()) return std::nullopt;  // the hint counts pairs of all beads
  if (!rule.cutoff) return task.radius == "auto" ? factor_hint(scene, rule.factor, task.apart) : std::nullopt;
  const auto hint = cutoff_hint(scene, task.distances.between_surfaces, task.apart);
  return hint
             ? std::optional(fmt::format("there are no contacts within --cutoff {}; {}", *rule.cutoff, *hint))
             : std::nullopt;
}

// Counts the missed contacts. Each warning about the input goes to `warn` as one line. Throws InputError for
// any fault of the input, and if a requested stride examines only one frame.
MissedReport count_missed(const MissedTask& task, const std::function<void(const std::string&)>& warn,
                          const std::function<void(std::size_t, std::size_t)>& progress) {
  MissedReport report;
  const Scene all = load_necklaces(task, task.motion, 1, warn);
  warn_of_cells("contacts", all.lacks_images(), task, warn);
  report.input = size_of(all);
  const auto [least, most] = std::ranges::minmax(all.radii());
  report.radius_min = least;
  report.radius_max = most;
  const std::vector<std::size_t> strides = strides_that_fit(task.strides, report.input.frames, task);
  const std::vector<MissedRule> rules = rules_of(task);
  for (std::size_t run = 0; run < rules.size(); ++run) {
    const MissedRule& rule = rules[run];
    const Scene scene = load_necklaces(task, task.motion, rule.factor, [](const std::string&) {});
    const auto rows = rows_of(task, scene, rule, strides, [&](std::size_t frame) {
      progress(run * scene.step_count() + frame, rules.size() * scene.step_count());
    });
    report.rows.insert(report.rows.end(), rows.begin(), rows.end());
    const bool none = std::ranges::all_of(report.rows, [](const auto& row) { return row.contacts == 0; });
    if (none && run + 1 == rules.size())
      if (const auto hint = hint_of(task, scene, rule)) warn(*hint);
  }
  return report;
}

constexpr CommandSpec kMissedCommand{
    "kds missed",
    "Measures which share of all contacts you miss if you look only at the frames, or only at every second, "
    "fourth ... frame.",
    {},
    {},
    "kds missed villin.dcd --topology villin.pdb --factors 2.2,2.5 --apart 5 --out report\n"
    "kds missed villin.dcd --topology villin.pdb --select ca --cutoff 6.5,8 --apart 3\n"
    "kds missed a.xyz b.xyz --radius 1.9 --strides 1,10,100 --json -"};

// Returns the options that appear as settings in the JSON.
const OptionList<MissedTask>& missed_task_options() {
  using O = MissedTask;
  static const auto list =
      OptionList<O>()
          .with(input_options().with({obstacle_option(), velocities_option()}))
          .with({
              of_output(list_option({"--strides", "LIST",
                                     "examine every frame, every second, ... (default: 1,2,4,8,16,32,64, "
                                     "as far as at least two frames remain)"},
                                    &O::strides, parse_strides)),
              list_option({"--factors", "LIST",
                           "multiply the radii by each factor, one run each. With --radius auto, contacts "
                           "appear from 2.2 to 2.5 on (default: 1)"},
                          &O::factors,
                          [](const std::string& text) {
                            return parse_reals("--factors", text, {0, 1e6, true});
                          }),
          })
          .with(
              &O::distances,
              contact_options("two beads are in contact while their centres are at most this far apart; each "
                              "length is one run (default: while their balls meet)",
                              ','))
          .with({apart_option("pairs of beads of one chain must be at least K apart along it; with factors "
                              "above 2 take 5, or near neighbours are always in contact (default: 2)",
                              &O::apart)})
          .with(OptionList<InputOptions>({groups_option()}))
          .with({// Lifted motion is excluded because it has no radii between frames.
                 choice_option(
                     {"--motion", "NAME",
                      "motion of beads between frames: linear or hermite (default: linear)"},
                     &O::motion,
                     std::span(frame_motion_names).first(static_cast<std::size_t>(FrameMotion::lifted)))});
  return list;
}

}  // namespace

MissedOptions parse_missed_options(const Arguments& arguments) {
  using O = MissedOptions;
  static const auto list =
      OptionList<O>()
          .with(&O::task, missed_task_options())
          .with(&O::destinations,
                destination_options("write missed.json, missed.csv and report.html to DIR (default: none)"));
  O options;
  const ParsedArguments parsed = read_arguments(with_inputs(kMissedCommand), list, arguments, options);
  take_inputs(parsed, kMissedCommand.name, options.task);
  const MissedTask& task = options.task;
  if (task.distances.lengths.empty() && !parsed.has("--factors"))
    throw InputError(
        "kds missed needs --cutoff LENGTH, the distance within which two beads are in contact, such as "
        "--cutoff 8 between C-alpha atoms, or --factors LIST for balls that meet");
  if (!task.distances.lengths.empty() && parsed.has("--factors"))
    throw InputError(
        "--factors and --cutoff: each says when two beads are in contact; expected one of the two options");
  task.distances.check();
  return options;
}

namespace {

/// Returns no value if there are no contacts.
std::optional<double> missed_fraction(const MissedRow& row) {
  if (row.contacts == 0) return std::nullopt;
  return static_cast<double>(row.missed()) / static_cast<double>(row.contacts);
}

std::string percent_text(const MissedRow& row) {
  const auto fraction = missed_fraction(row);
  return fraction ? fmt::format("{:.1f}%", 100 * *fraction) : "-";
}

std::string percent_with_interval(const MissedRow& row) {
  return percent_text(row) + (row.interval ? fmt::format(" ({:.1f} to {:.1f})", 100 * row.interval->lower,
                                                         100 * row.interval->upper)
                                           : "");
}

// Returns the columns of missed.json and missed.csv and of the terminal.
Table<MissedRow> missed_columns(const MissedTask& task) {
  using Row = MissedRow;
  Table<Row> table({{"factor", "radii times", [](const Row& r) { return Field(r.rule.factor); }}});
  if (!task.distances.lengths.empty())
    table = Table<Row>({{"cutoff", "cutoff", [](const Row& r) { return Field(r.rule.cutoff); }}});
  table.add({
      {"stride", "stride", [](const Row& r) { return Field(r.stride); }},
      {"frames", "frames", [](const Row& r) { return Field(r.frames); }},
      {"contacts", "contacts", [](const Row& r) { return Field(r.contacts); }},
      {"found", "found", [](const Row& r) { return Field(r.found); }},
      {"missed", "missed", [](const Row& r) { return Field(r.missed()); }},
      {.key = "missed_fraction",
       .heading = "missed % (95%)",
       .value = [](const Row& r) { return Field(missed_fraction(r)); },
       .words = percent_with_interval},
      {.key = "missed_fraction_lower",
       .value = [](const Row& r) { return r.interval ? Field(r.interval->lower) : Field(); }},
      {.key = "missed_fraction_upper",
       .value = [](const Row& r) { return r.interval ? Field(r.interval->upper) : Field(); }},
  });
  return table;
}

}  // namespace

int missed_command(const Arguments& arguments) {
  const MissedOptions options = parse_missed_options(arguments);
  const MissedTask& task = options.task;
  TableCommand command("missed", arguments, options.destinations, "step");
  command.check_inputs_and_destinations(task);

  refuse_instance(task, "points, no balls");
  const MissedReport report = count_missed(task, command.warn(), command.progress());

  Json json;
  json["input"] = input_json(task, report.input, report.radius_min, report.radius_max);
  json["settings"] = missed_task_options().settings_json(task);
  json["rows"] = missed_columns(task).json(report.rows);
  json["warnings"] = command.warnings();
  const auto columns = missed_columns(task);
  command.deliver(json, columns.csv(report.rows), columns.text(report.rows));
  return 0;
}

}  // namespace kds
