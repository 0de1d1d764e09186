#include "experiments/trade/trade_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/text.h"
#include "experiments/program/option_names.h"
#include "experiments/program/option_values.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"
#include "experiments/program/warnings.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/radius_hint.h"
#include "experiments/trade/recommend.h"
#include "experiments/trade/trade_report.h"
#include "kds/seconds.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

constexpr const char* kTradeName = "trade";

constexpr CommandSpec kTradeCommand{
    "kds trade",
    "Measures what speed can be had for what accuracy: every lever on this trajectory, beside the exact run.",
    kInputOperand,
    kTrajectoryHelp,
    {},
    "kds trade villin.dcd --topology villin.pdb --frames 0:200 --out report\n"
    "kds trade villin.dcd --topology villin.pdb --want contacts --radius 2 --apart 5\n"
    "kds trade models.pdb --chain A,B --want scenes",
};

std::vector<Want> parse_wants(const std::string& list) {
  std::vector<Want> wants;
  for (const std::string& word : split(list, ',')) {
    wants.push_back(choice_of<Want>("--want", word, want_names));
    if (std::count(wants.begin(), wants.end(), wants.back()) > 1)
      throw InputError(fmt::format("--want: {} is listed twice", word));
  }
  std::sort(wants.begin(), wants.end());
  return wants;
}

Option<TradeTask> without_exact_option() {
  Option<TradeTask> option(
      {"--without-exact", "",
       "leave out the exact kernel, which has the same events at a hundred to thousands of times the cost"},
      [](TradeTask& task, const std::string&) { task.exact_kernel = false; },
      [](const TradeTask& task) { return task.exact_kernel ? "" : "yes"; }, nullptr,
      [](const TradeTask& task) { return Json(task.exact_kernel); });
  option.setting = "exact_kernel";
  return option;
}

/// What is measured. --cutoff is no setting of the JSON.
const OptionList<TradeTask>& task_options() {
  using O = TradeTask;
  static const auto list =
      OptionList<O>()
          .with(
              {list_option({"--want", "LIST",
                            "comma list of contacts, cages, diagram, events, and scenes, which is what each "
                            "part of the scene costs (default: contacts,cages,diagram)"},
                           &O::wants, parse_wants),
               apart_option("contacts: of beads of one chain, those at least K apart along it (default: 2)",
                            &O::apart),
               of_output(real_option({"--cutoff", "LENGTH",
                                      "diagram: edges shorter than this are counted where they are missed "
                                      "(default: 4 times the largest radius)"},
                                     &O::cutoff, {0, 1e300, true})),
               without_exact_option(),
               whole_option(
                   {"--rounds", "N", "runs of each setting in turn, of which the median counts (default: 5)"},
                   &O::rounds, 1, 1000)})
          .with(&O::sampling,
                {{whole_option({"--times", "N",
                                "random times at which errors are taken, and as many frames (default: 200)"},
                               &SamplingOfTimes::times, 1, 1'000'000),
                  whole_option({"--seed", "N", "of the random times (default: 1)"}, &SamplingOfTimes::seed, 0,
                               ~std::uint64_t{0})}});
  return list;
}

const OptionList<TradeOptions>& trade_options() {
  using O = TradeOptions;
  static const auto list =
      OptionList<O>()
          .with(input_options())
          .with(&O::task, task_options())
          .with(destination_options(
              "write trade.json, trade.csv and report.html there (default: none)",
              "write the rows there; - is standard output (default: none)",
              "no table, no progress bar, which counts runs: of each setting one for its errors, then the "
              "rounds"));
  return list;
}

Json input_json(const TradeOptions& options, const FinestData& finest) {
  Json files = Json::array();
  for (const auto& input : options.inputs) files.push_back(input.string());
  const auto [least, most] = std::minmax_element(finest.radii().begin(), finest.radii().end());
  return {{"files", files},
          {"beads", finest.radii().size()},
          {"frames", finest.frame_count()},
          {"dimension", finest.scene().dimension()},
          {"radius_min", *least},
          {"radius_max", *most}};
}

// By beads and frames alone, so that the rows are the same on every machine.
bool leave_out_exact_kernel(const FinestData& finest, const TradeTask& task,
                            const std::function<void(const std::string&)>& warn) {
  constexpr std::size_t most_beads = 500, most = 50'000;
  const bool asked_for = task.exact_kernel;
  if (task.wants == std::vector{Want::scenes}) return true;  // which have no kernels
  const std::size_t beads = finest.radii().size(), frames = finest.frame_count();
  if (beads <= most_beads && beads * frames <= most) return !asked_for;
  if (!asked_for) return true;
  warn(fmt::format(
      "`--kernel exact` is left out: {} beads in {} frames take it long; expected no more than {} beads, and "
      "no more than {} times frames",
      beads, frames, most_beads, most));
  return true;
}

// All of it over the first frames tells how long all frames will take. Throws InputError where these alone do
// not fit what is wanted.
double foretold_by_first_frames(const FinestData& finest, const TradeTask& task) {
  constexpr std::size_t few = 9;
  if (finest.frame_count() <= 2 * few) return 0;
  TradeTask pilot = task;
  pilot.rounds = 1;
  pilot.sampling.times = 4;
  const FinestData first = finest.first_frames(few);
  // Twice: what a look costs is told apart from what a run costs.
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
  const std::size_t times = task.sampling.times;  // of frames and random ones: the same number, if there are
  return a_look * 0.5 * static_cast<double>(times + std::min(times, finest.frame_count())) +
         a_round * steps * static_cast<double>(task.rounds + 1);
}

// None where it cannot be told.
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

/// What --apart and --cutoff are about must be among what is wanted.
void refuse_needless_options(const ParsedArguments& parsed, const std::vector<Want>& wants) {
  const auto wanted = [&](std::initializer_list<Want> some) {
    return std::find_first_of(wants.begin(), wants.end(), some.begin(), some.end()) != wants.end();
  };
  if (parsed.value("--apart") && !wanted({Want::contacts, Want::events, Want::scenes}))
    throw InputError("--apart: it chooses pairs of contacts; expected contacts, events or scenes in --want");
  if (parsed.has("--without-exact") && wants == std::vector{Want::scenes})
    throw InputError("--without-exact: scenes are run with one kernel; expected another word in --want");
  if (parsed.value("--cutoff") && !wanted({Want::diagram, Want::events}))
    throw InputError(
        "--cutoff: it is about edges of the power diagram; expected diagram or events in --want");
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

TradeOptions parse_trade_options(const Arguments& arguments) {
  TradeOptions options;
  const ParsedArguments parsed = read_arguments(kTradeCommand, trade_options(), arguments, options);
  take_inputs(parsed, kTradeCommand.name, options);
  refuse_needless_options(parsed, options.task.wants);
  return options;
}

int trade_command(const Arguments& arguments) {
  const TradeOptions options = parse_trade_options(arguments);
  const Destinations& destinations = options;
  check_inputs_exist(options);
  TakenPaths taken;
  taken.read(options);
  if (destinations.out) taken.write_into("--out", *destinations.out, {"report.html"});
  check_table_destinations(destinations, kTradeName, taken);
  if (destinations.out) {
    check_page(*destinations.out, "trade");
  }

  ProgressBar bar(!destinations.quiet, "run");
  if (const auto instance = read_lone_instance(options))
    throw InputError(instance->file + ": an instance file has no frames; expected a trajectory");
  HeldWarnings held;
  std::vector<Trajectory> necklaces = read_necklaces(options, held.hold());
  refuse_lone_frame(options, necklaces);
  std::vector<double> radii = bead_radii(options.radius, necklaces);
  const FinestData finest(std::move(necklaces), std::move(radii), options.radius);
  TradeTask task = options.task;
  task.exact_kernel = !leave_out_exact_kernel(finest, task, held.hold());
  if (!destinations.quiet) foretell(foretold_seconds(finest, task));
  const std::vector<TradeRow> rows = measure_trade(
      finest, task, [&bar](std::size_t done, std::size_t total) { bar.update(done, total); }, held.hold());
  bar.erase();
  const bool no_contacts = std::ranges::any_of(rows, [](const TradeRow& row) {
    return row.want == Want::contacts && row.is_exact && row.cost.events == 0;
  });
  if (no_contacts && options.radius == "auto")
    if (const auto hint = radius_hint(finest.scene(), task.apart)) held.hold()(*hint);
  Json warnings = Json::array();
  held.release([&](const std::string& warning) {
    warnings.push_back(warning);
    print_warning(bar, warning);
  });

  std::vector<std::string> names;
  for (const auto& input : options.inputs) names.push_back(input.filename().string());
  const std::string command_line = "kds trade " + shell_words(arguments);
  Json json;
  json["input"] = input_json(options, finest);
  json["settings"] = trade_options().settings_json(options);
  json["rows"] = trade_rows_json(rows);
  json["recommendation"] = recommendation(rows);
  json["warnings"] = warnings;
  add_provenance(json, command_line);
  deliver_table(destinations, kTradeName,
                {text_of(json), trade_csv(rows), trade_table(rows), [&] {
                   return trade_page(
                       rows, fmt::format("{}", fmt::join(names, ", ")),
                       made_by(kTradeName, command_line, trade_options().settings_json(options)));
                 }});
  return 0;
}

}  // namespace kds
