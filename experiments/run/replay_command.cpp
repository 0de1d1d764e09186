#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option_values.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/parse_run_options.h"
#include "experiments/run/replay_log.h"
#include "experiments/run/report_json.h"
#include "experiments/run/run_results.h"
#include "experiments/run/table.h"
#include "motions/base/input_error.h"

namespace kds {
namespace {

struct ReplayOptions : Destinations {
  std::optional<std::filesystem::path> events;
};

const OptionList<ReplayOptions>& replay_options() {
  using O = ReplayOptions;
  static const auto list = OptionList<O>().with({events_option(&O::events)}).with(run_destination_options());
  return list;
}

constexpr CommandSpec kReplayCommand{
    "kds replay",
    "Repeats a logged run and reports whether the same happens (exit code 0) or not (1).",
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
  const auto& events = options.events;
  if (events) paths.write("--events", *events);
  check_destinations(destinations, "replay", run);
  if (events) ensure_writable_file(*events, "--events");

  RunResults results("replay", destinations, events);
  ProgressBar bar(!destinations.quiet, "step");
  const ReplayReport replay = replay_log(
      log, [&bar](std::size_t done, double within, std::size_t total) { bar.update(done, within, total); },
      [&bar](const std::string& warning) { print_warning(bar, warning); }, &results);
  bar.erase();
  results.deliver(replay.run, replay_json(replay, log), comparison_table(replay.run) + verdict(replay));
  return replay.same() ? 0 : 1;
}

}  // namespace kds
