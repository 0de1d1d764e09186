#include "experiments/trade/trade_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr CommandSpec kTradeCommand{
    "kds trade",
    "Compares options that trade accuracy for speed with the exact run: time saved, errors made.\n\n"
    "The table has a row for each setting and some of these columns. A group begins with its exact run. "
    "Errors are\n"
    "measured at frames and at random times between them. The truth is straight motion between all "
    "frames.\n\n"
    "  *                           no other row of the group is as quick and as right\n"
    "  seconds                     processor time, median of the rounds, without reading and the first "
    "build\n"
    "  ratio                       seconds / seconds of the exact run for as many frames\n"
    "  tests                       tests of two spheres by a search for contacts in the hierarchy, on "
    "average\n"
    "  radius, at most, at frames  how much larger spheres are than the smallest: on average, at most, at "
    "most at frames\n"
    "  outside                     beads outside their spheres, on average\n"
    "  wrong, edges                cells that are not in the true diagram, short edges that are missed\n"
    "  missed                      true events or contacts that the run does not have\n"
    "  invented, spurious          events or contacts of the run that are not true\n"
    "  unsure                      contacts that are possible but not certain\n"
    "  time, at most               error of times, in frames: on average, at most\n"
    "  closest, moved              largest error of the closest distance; largest distance of a bead from "
    "its true place",
    kInputOperand,
    kTrajectoryHelp,
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
       "leave out --kernel exact, which is a hundred to thousands of times slower and has the same events"},
      [](TradeTask& task, const std::string&) { task.exact_kernel = false; },
      [](const TradeTask& task) { return task.exact_kernel ? "" : "yes"; }, nullptr,
      [](const TradeTask& task) { return Json(task.exact_kernel); });
  option.setting = "exact_kernel";
  return option;
}

/// The options that say what is measured. --cutoff is not a setting in the JSON.
const OptionList<TradeTask>& task_options() {
  using O = TradeTask;
  static const auto list =
      OptionList<O>()
          .with({list_option(
                     {"--want", "LIST",
                      "comma list of what you need: contacts, cages (bounding spheres), diagram, events; "
                      "scenes measures only what each structure costs (default: contacts,cages,diagram)"},
                     &O::wants, parse_wants),
                 apart_option(
                     "contacts: pairs of beads of one chain must be at least K apart along it (default: 2)",
                     &O::apart),
                 of_output(real_option({"--cutoff", "LENGTH",
                                        "diagram: count missed edges that are shorter than LENGTH (default: "
                                        "4 times the largest radius)"},
                                       &O::cutoff, {0, 1e300, true})),
                 without_exact_option(),
                 whole_option(
                     {"--rounds", "N",
                      "run each setting N times, alternating, and report the median time (default: 5)"},
                     &O::rounds, 1, 1000)})
          .with(&O::sampling,
                {{whole_option(
                      {"--times", "N",
                       "number of random times, and of frames, at which errors are measured (default: 200)"},
                      &SamplingOfTimes::times, 1, 1'000'000),
                  whole_option({"--seed", "N", "seed of the random times (default: 1)"},
                               &SamplingOfTimes::seed, 0, ~std::uint64_t{0})}});
  return list;
}

/// Throws InputError if --apart or --cutoff is given but no requested result uses it.
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

}  // namespace

const OptionList<TradeOptions>& trade_options() {
  using O = TradeOptions;
  static const auto list =
      OptionList<O>()
          .with(input_options())
          .with(&O::task, task_options())
          .with(destination_options("write trade.json, trade.csv and report.html to DIR (default: none)",
                                    "write the rows to FILE; - is standard output (default: none)",
                                    "print no table and no progress bar; the bar counts runs: one of each "
                                    "setting for its errors, then the rounds"));
  return list;
}

TradeOptions parse_trade_options(const Arguments& arguments) {
  TradeOptions options;
  const ParsedArguments parsed = read_arguments(kTradeCommand, trade_options(), arguments, options);
  take_inputs(parsed, kTradeCommand.name, options);
  refuse_needless_options(parsed, options.task.wants);
  return options;
}

}  // namespace kds
