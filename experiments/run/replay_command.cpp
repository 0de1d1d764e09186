#include "experiments/run/replay_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "certificates/exact/exact_time.h"
#include "experiments/output/output_files.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option_values.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_command.h"
#include "experiments/run/certify_stride.h"
#include "experiments/run/event_log_file.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_results.h"
#include "kds/event_log.h"
#include "motions/base/input_error.h"
#include "structures/session/kinetic_run.h"

namespace kds {

namespace {

RunOptions options_of(const EventLogHeader& header, const std::filesystem::path& path) {
  const std::string where = path.string() + ":2: the run's arguments: ";
  try {
    return parse_run_options(header.arguments);
  } catch (const InputError& error) {
    throw InputError(where + error.what());
  } catch (const HelpRequest&) {
    throw InputError(where + "they ask for help, not for a run");
  }
}

// Listens to the events of the run and compares each with the next event of the log.
class LogComparison final : public EventListener {
 public:
  LogComparison(EventLogReader& log, const std::string& name, const Simulator& simulator)
      : log_(log), name_(name), simulator_(simulator) {}

  void on_event(const Event& event) override {
    if (difference_) return;
    const EventLogReader::Entry* const entry = log_.next();
    if (entry == nullptr) {
      part(fmt::format("{}: ends before an event of {} in step {}", name_, event.structure, event.step));
    } else if (!is_event(*entry, event)) {
      part(fmt::format("{}:{}: {}, but the run has {} {} {} in step {}", name_, entry->line, text_of(*entry),
                       event.structure, event.kind.name,
                       fmt::join(event.change.ids.begin(), event.change.ids.begin() + event.change.size, " "),
                       event.step));
    } else if (!is_time(*entry, event)) {
      part(fmt::format("{}:{}: a time between {} and {}, but the event happens between {} and {}", name_,
                       entry->line, entry->lower, entry->upper, event.lower, event.upper));
    }
  }

  // The run makes the edits of the log, so only their places among the events can differ.
  void on_edit(const Edit& edit) override {
    if (difference_) return;
    const EventLogReader::Entry* const entry = log_.next();
    if (entry == nullptr || !entry->edit || entry->edit->where != edit.where)
      part(fmt::format("{}: the run makes this edit between other events", edit.where));
  }

  // Called after the last event of the run: the log must have no further event either.
  std::optional<std::string> finish() {
    if (!difference_)
      if (const EventLogReader::Entry* const entry = log_.next())
        part(fmt::format("{}:{}: {} that does not happen", name_, entry->line, text_of(*entry)));
    return std::move(difference_);
  }

 private:
  static std::string text_of(const EventLogReader::Entry& entry) {
    return entry.edit ? fmt::format("an edit in step {}", entry.step)
                      : fmt::format("an event of {} in step {}", entry.structure, entry.step);
  }

  static bool is_event(const EventLogReader::Entry& entry, const Event& event) {
    const Change& change = event.change;
    return !entry.edit && entry.step == event.step && entry.structure == event.structure &&
           entry.kind == event.kind.name &&
           std::equal(entry.ids.begin(), entry.ids.end(), change.ids.begin(),
                      change.ids.begin() + change.size);
  }

  // Brackets of earlier versions of kds are not canonical, so they need only enclose the time.
  bool is_time(const EventLogReader::Entry& entry, const Event& event) const {
    if (entry.lower == event.lower && entry.upper == event.upper) return true;
    if (log_.header().has_edits) return false;
    ExactTime& now = simulator_.now().exact();
    ExactTime lower{Dyadic(entry.lower)}, upper{Dyadic(entry.upper)};
    const int after_lower = ExactTime::compare(lower, now), before_upper = ExactTime::compare(now, upper);
    return entry.lower == entry.upper ? after_lower == 0 : after_lower < 0 && before_upper < 0;
  }

  // Records the first difference. Reads the rest of the log, which is refused if a run did not write it.
  void part(std::string difference) {
    difference_ = std::move(difference);
    while (log_.next() != nullptr) {
    }
  }

  EventLogReader& log_;
  const std::string& name_;
  const Simulator& simulator_;
  std::optional<std::string> difference_;
};

// Returns all edits of a log, with indices of the run's structures.
std::vector<Edit> logged_edits(const std::filesystem::path& path, const std::vector<KineticStructure*>& all) {
  std::vector<Edit> edits;
  EventLogReader log(path);
  while (const EventLogReader::Entry* const entry = log.next()) {
    if (!entry->edit) continue;
    Edit& edit = edits.emplace_back(*entry->edit);
    if (edit.kind == Edit::Kind::change) continue;
    const auto named = [&](const KineticStructure* one) { return one->name() == entry->structure; };
    const auto found = std::find_if(all.begin(), all.end(), named);
    if (found == all.end())
      throw InputError(fmt::format("{}: the run has no structure {}", edit.where, entry->structure));
    edit.structure = static_cast<std::size_t>(found - all.begin());
  }
  return edits;
}

// Returns the options of the logged run. Throws an InputError that names the file if it is not a log.
RunOptions logged_run(const std::filesystem::path& log) {
  return options_of(EventLogReader(log).header(), log);
}

}  // namespace

ReplayReport replay_log(const std::filesystem::path& path, const Progress& progress,
                        const std::function<void(const std::string&)>& warn, RunResults* results) {
  const std::string name = path.string();
  EventLogReader log(path);
  const RunOptions options = options_of(log.header(), path);
  HeldWarnings warnings;
  const Scene scene = load_scene(options, warnings.hold());
  if (scene.bead_count() != log.header().beads || scene.step_count() != log.header().steps) {
    throw InputError(fmt::format("{}: the inputs have {} beads and {} steps, the log has {} and {}", name,
                                 scene.bead_count(), scene.step_count(), log.header().beads,
                                 log.header().steps));
  }
  // Logs of earlier versions of kds have wider brackets, which are compared with exact times. Exact times are
  // known on one thread only.
  RunOptions opened = options;
  if (!log.header().has_edits || (results != nullptr && results->has_page())) opened.threads = 1;
  const auto run = open_parallel_run(opened, scene, options.audit, {}, warnings.hold());
  if (log.header().has_edits) run->repeat(logged_edits(path, run->whole().structures()));
  LogComparison comparison(log, name, run->simulator());
  run->listen(comparison);
  ProgressWithinSteps within(progress, scene.step_count());
  if (options.audit == AuditMode::events) run->listen(within);
  StepCounts counts(run->whole(), scene);
  if (results != nullptr) results->begin(scene, run->whole(), options);
  run_steps(*run, options, [&](std::size_t frame) {
    if (results != nullptr) results->add_frame(frame, run->whole());
    if (frame == 0) {
      counts.begin();
      return warnings.release(warn);
    }
    counts.end_step(frame - 1, results);
    progress(frame, 0, scene.step_count());
  });

  if (results != nullptr) results->end_run();

  ReplayReport replay;
  replay.difference = comparison.finish();
  replay.run = report_of(run->whole(), scene, options, counts);
  replay.run.threads = run->threads();
  replay.run.parts = run->parts();
  if (options.certify) {
    replay.run.stride = certify_stride(options, scene);
    if (results != nullptr) results->add_certificate(*replay.run.stride, scene);
  }
  replay.logged_fingerprint = log.fingerprint();
  replay.events = log.events();
  return replay;
}

namespace {

struct ReplayOptions : Destinations {
  std::optional<std::filesystem::path> events, view;
};

const OptionList<ReplayOptions>& replay_options() {
  using O = ReplayOptions;
  static const auto list = OptionList<O>()
                               .with({events_option(&O::events), view_option(&O::view)})
                               .with(run_destination_options());
  return list;
}

constexpr CommandSpec kReplayCommand{
    "kds replay",
    "Repeats a logged run and compares every event with the log. Exit code: 0 if all are equal, 1 otherwise.",
    "LOG",
    "an event log, as written by kds run --log",
    "kds run models.pdb --log models.kdslog\nkds replay models.kdslog",
};

std::string verdict(const ReplayReport& replay) {
  const std::string logged = hex_digits(replay.logged_fingerprint);
  std::string text = fmt::format("{} events in the log\n", with_thousands(replay.events));
  if (replay.difference) return text + "different: " + *replay.difference + "\n";
  return text + (replay.same() ? fmt::format("fingerprint same: {}\n", logged)
                               : fmt::format("fingerprint different: {} now, {} in the log\n",
                                             hex_digits(replay.run.fingerprint), logged));
}

}  // namespace

int replay_command(const Arguments& arguments) {
  ReplayOptions options;
  const ParsedArguments parsed = read_arguments(kReplayCommand, replay_options(), arguments, options);
  if (parsed.operands().size() != 1)
    throw InputError(
        fmt::format("kds replay takes one LOG, not {} (see kds replay --help)", parsed.operands().size()));
  const std::filesystem::path log = parsed.operands().front();
  check_exists(log);

  const Destinations& destinations = options;
  TakenPaths paths;
  paths.add("the log", log);
  const RunOptions run = logged_run(log);
  paths.read(run);
  paths.write(destinations);
  paths.require_directory(destinations.replace);
  const auto& events = options.events;
  if (events) paths.write("--events", *events);
  if (options.view) paths.write_page(*options.view, destinations);
  check_writable(destinations);
  if (events) ensure_writable_file(*events, "--events");

  RunResults results(destinations, events, options.view);
  ProgressBar bar(!destinations.quiet, "step");
  ReplayReport replay = replay_log(
      log, [&bar](std::size_t done, double within, std::size_t total) { bar.update(done, within, total); },
      [&bar](const std::string& warning) { print_warning(bar, warning); }, &results);
  bar.erase();
  results.add_distributions(replay.run);
  results.deliver(replay.run, replay_json(replay, log), comparison_table(replay.run) + verdict(replay));
  return replay.same() ? 0 : 1;
}

}  // namespace kds
