#include "experiments/theorems/theorems_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"
#include "experiments/theorems/plan_theorems.h"
#include "experiments/theorems/theorems_report.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr const char* kTheoremsName = "theorems";

constexpr std::array kTheoremsOptions{
    OptionSpec{"--beads", "N",
               "of the largest necklaces, to 4000000; from 64 for 2.3, 4096 for others, three sizes "
               "(default: 100000)"},
    OptionSpec{"--gap", "X", "between rows of grids, in diameters (default: 0.05)"},
    OptionSpec{"--seed", "N", "of what is random: chains, and how grids are disturbed (default: 1)"},
    OptionSpec{"--rounds", "N",
               "of each measurement of time (3.2, 3.5), of which the median counts (default: 3)"},
    OptionSpec{"--out", "DIR", "write theorems.json, theorems.csv and report.html there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr CommandSpec kTheoremsCommand{
    "kds theorems",
    "What the theorems of Agarwal et al. (2004) bound, measured over sizes, with fitted exponents.\n\n"
    "  2.3  the layered hierarchy's root beside the wrapped one's: at most sqrt(h + 1) times, h the height\n"
    "  3.1  separating families of packed grids: n log n pairs in the plane, n^(4/3) in space\n"
    "  3.2  the time to find them\n"
    "  3.5  the closest pair is among those that the power diagram and the chain name: how many they are",
    "[THEOREM]...",
    "2.3, 3.1, 3.2, 3.5 (default: all)",
    kTheoremsOptions,
    "kds theorems --out report\n"
    "kds theorems 3.1 --beads 1000000 --json -",
};

struct TheoremsAsked {
  TheoremOptions measured;
  Destinations destinations;
};

TheoremsAsked parse_theorems(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kTheoremsCommand, arguments);
  TheoremsAsked asked;
  TheoremOptions& options = asked.measured;
  for (const std::string& name : parsed.operands()) {
    const auto theorem = choice_of<Theorem>("THEOREM", name, theorem_names);
    if (std::ranges::find(options.theorems, theorem) != options.theorems.end())
      throw InputError(fmt::format("THEOREM: {} is listed twice", name));
    options.theorems.push_back(theorem);
  }
  if (options.theorems.empty())
    options.theorems = {Theorem::tightness, Theorem::family, Theorem::search, Theorem::closest_pair};
  std::ranges::sort(options.theorems);
  if (const auto text = parsed.value("--beads"))
    options.most_beads = parse_whole_number("--beads", *text, least_beads_for(options.theorems), 4'000'000);
  if (const auto text = parsed.value("--gap")) options.gap = parse_real("--gap", *text, {0.001, 0.9});
  if (const auto text = parsed.value("--seed"))
    options.seed = parse_whole_number("--seed", *text, 0, UINT64_MAX);
  if (const auto text = parsed.value("--rounds")) {
    options.rounds = parse_whole_number("--rounds", *text, 1, 1000);
    if (!measures_time(options.theorems))
      throw InputError("--rounds: no theorem asked for measures time; 3.2 and 3.5 do");
  }
  asked.destinations = {path_of(parsed, "--out"), parsed.value("--json"), parsed.has("--quiet")};
  return asked;
}

std::vector<TheoremSeries> measure(const TheoremsAsked& asked) {
  TheoremPlan plan = plan_theorems(asked.measured);
  ProgressBar bar(!asked.destinations.quiet, "measurement");
  std::size_t done = 0;
  for (const auto& work : plan.work) {
    work(plan.series);
    bar.update(++done, plan.work.size());
  }
  std::ranges::stable_sort(plan.series, {}, &TheoremSeries::theorem);
  return std::move(plan.series);
}

Json settings_json(const TheoremOptions& options) {
  std::vector<std::string_view> theorems;
  for (const Theorem theorem : options.theorems) theorems.push_back(name_of(theorem));
  return {{"theorems", theorems},
          {"beads", options.most_beads},
          {"gap", options.gap},
          {"seed", options.seed},
          {"rounds", options.rounds}};
}

}  // namespace

int theorems_command(const Arguments& arguments) {
  const TheoremsAsked asked = parse_theorems(arguments);
  const Destinations& destinations = asked.destinations;
  TakenPaths taken;
  if (destinations.out) taken.write_into("--out", *destinations.out, {"report.html"});
  check_table_destinations(destinations, kTheoremsName, taken);
  if (destinations.out) {
    check_page(*destinations.out, "theorems");
  }
  const std::vector<TheoremSeries> series = measure(asked);

  const std::string command_line = "kds theorems " + shell_words(arguments);
  Json json;
  json["settings"] = settings_json(asked.measured);
  json["rows"] = theorem_rows_json(series);
  json["fits"] = theorem_fits_json(series);
  add_provenance(json, command_line);
  deliver_table(destinations, kTheoremsName,
                {text_of(json), theorems_csv(series), theorems_table(series), [&] {
                   return theorems_page(series,
                                        made_by(kTheoremsName, command_line, settings_json(asked.measured)));
                 }});
  return 0;
}

}  // namespace kds
