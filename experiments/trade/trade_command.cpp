#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/radius_hint.h"
#include "experiments/trade/recommend.h"
#include "experiments/trade/trade_options.h"
#include "experiments/trade/trade_report.h"
#include "kds/seconds.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

// The decision depends only on the numbers of beads and frames, so that every machine has the same rows.
bool leave_out_exact_kernel(const FinestData& finest, const TradeTask& task,
                            const std::function<void(const std::string&)>& warn) {
  constexpr std::size_t most_beads = 500, most = 50'000;
  const bool asked_for = task.exact_kernel;
  if (task.wants == std::vector{Want::scenes}) return true;  // scenes have no kernel variants
  const std::size_t beads = finest.radii().size(), frames = finest.frame_count();
  if (beads <= most_beads && beads * frames <= most) return !asked_for;
  if (!asked_for) return true;
  warn(fmt::format(
      "`--kernel exact` is left out: {} beads in {} frames take it long; expected no more than {} beads, and "
      "no more than {} times frames",
      beads, frames, most_beads, most));
  return true;
}

// Estimates the time for all frames from a full measurement of the first frames. Throws InputError if the
// first frames alone do not fit what is wanted.
double foretold_by_first_frames(const FinestData& finest, const TradeTask& task) {
  constexpr std::size_t few = 9;
  if (finest.frame_count() <= 2 * few) return 0;
  TradeTask pilot = task;
  pilot.rounds = 1;
  pilot.sampling.times = 4;
  const FinestData first = finest.first_frames(few);
  // Two measurements separate the cost of examining a time from the cost of a run.
  const double with_few = seconds_of([&] {
                            static_cast<void>(measure_trade(
                                first, pilot, [](auto, auto) {}, [](auto&) {}));
                          }).clock;
  pilot.sampling.times = 8;
  const double with_more = seconds_of([&] {
                             static_cast<void>(measure_trade(
                                 first, pilot, [](auto, auto) {}, [](auto&) {}));
                           }).clock;
  const double a_look = std::max(0.0, with_more - with_few) / 4;
  const double a_round = std::max(0.0, with_few - 4 * a_look) / 2;
  const double steps = static_cast<double>(finest.frame_count() - 1) / (few - 1);
  // Number of random times; also the number of frames examined, if there are as many.
  const std::size_t times = task.sampling.times;
  return a_look * 0.5 * static_cast<double>(times + std::min(times, finest.frame_count())) +
         a_round * steps * static_cast<double>(task.rounds + 1);
}

// Returns 0 if the time cannot be estimated.
double foretold_seconds(const FinestData& finest, const TradeTask& task) {
  try {
    return foretold_by_first_frames(finest, task);
  } catch (const InputError&) {
    return 0;
  }
}

void foretell(double seconds) {
  if (seconds < 5) return;
  std::fputs(seconds < 120 ? fmt::format("kds: about {:.0f} seconds\n", seconds).c_str()
                           : fmt::format("kds: about {:.0f} minutes\n", seconds / 60).c_str(),
             stderr);
}

void refuse_lone_frame(const TradeOptions& options, const std::vector<Trajectory>& necklaces) {
  const FrameRange& frames = options.reading.frames;
  const bool all = frames.first == 0 && !frames.last && frames.stride == 1;
  const bool lone = std::all_of(necklaces.begin(), necklaces.end(),
                                [](const Trajectory& necklace) { return necklace.frames.size() < 2; });
  if (!all && lone)
    throw InputError(fmt::format("--frames {}: leaves 1 frame of {}; expected a range of two or more",
                                 name_of(frames), necklaces.front().file));
}

}  // namespace

int trade_command(const Arguments& arguments) {
  const TradeOptions options = parse_trade_options(arguments);
  TableCommand command("trade", arguments, options, "run");
  command.check_inputs_and_destinations(options);

  if (const auto instance = read_lone_instance(options))
    throw InputError(instance->file + ": an instance file has no frames; expected a trajectory");
  std::vector<Trajectory> necklaces = read_necklaces(options, command.warn());
  refuse_lone_frame(options, necklaces);
  std::vector<double> radii = bead_radii(options.radius, necklaces);
  const FinestData finest(std::move(necklaces), std::move(radii), options.radius);
  TradeTask task = options.task;
  task.exact_kernel = !leave_out_exact_kernel(finest, task, command.warn());
  if (!options.quiet) foretell(foretold_seconds(finest, task));
  const std::vector<TradeRow> rows = measure_trade(finest, task, command.progress(), command.warn());
  const bool no_contacts = std::ranges::any_of(rows, [](const TradeRow& row) {
    return row.want == Want::contacts && row.is_exact && row.cost.events == 0;
  });
  if (no_contacts && options.radius == "auto")
    if (const auto hint = radius_hint(finest.scene(), task.apart)) command.warn()(*hint);

  Json json;
  json["input"] = input_json(
      options, {.frames = finest.frame_count(), .dimension = finest.scene().dimension()}, finest.radii());
  json["settings"] = trade_options().settings_json(options);
  json["rows"] = trade_rows_json(rows);
  json["recommendation"] = recommendation(rows);
  json["warnings"] = command.warnings();
  command.deliver(json, trade_csv(rows), trade_table(rows),
                  [&](Page page) { return trade_page(rows, file_names(options), std::move(page)); });
  return 0;
}

}  // namespace kds
