#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/program/option.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/theorems/plan_theorems.h"
#include "experiments/theorems/theorems_report.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr CommandSpec kTheoremsCommand{
    "kds theorems",
    "Measures, for growing sizes, what the theorems of Agarwal et al. (2004) bound, and fits exponents.\n\n"
    "  2.3  radius of the layered root / radius of the wrapped root: at most sqrt(h + 1), h the tree's "
    "height\n"
    "  3.1  pairs in separating families of packed grids: n log n in the plane, n^(4/3) in space\n"
    "  3.2  time to find these families\n"
    "  3.5  pairs that have to be looked at to find the closest one",
    "[THEOREM]...",
    "2.3, 3.1, 3.2 or 3.5 (default: all)",
    "kds theorems --out report\n"
    "kds theorems 3.1 --beads 1000000 --json -",
};

struct TheoremsAsked : Destinations {
  TheoremOptions measured;
};

const OptionList<TheoremsAsked>& theorems_options() {
  using O = TheoremsAsked;
  using M = TheoremOptions;
  Option<M> beads = whole_option({"--beads", "N",
                                  "beads of the largest necklaces: at least 64 for 2.3 and 4096 for the "
                                  "others, so that there are three sizes, and at most 4000000 (default: "
                                  "100000)"},
                                 &M::most_beads, 0, 0);
  beads.read = [](M& m, const std::string& text) {
    m.most_beads = parse_whole_number("--beads", text, least_beads_for(m.theorems), 4'000'000);
  };
  static const auto list =
      OptionList<O>()
          .with(&O::measured,
                {{beads,
                  real_option({"--gap", "X", "gap between the rows of grids, in diameters (default: 0.05)"},
                              &M::gap, {0.001, 0.9}),
                  whole_option({"--seed", "N", "seed of random chains and of disturbed grids (default: 1)"},
                               &M::seed, 0, UINT64_MAX),
                  whole_option({"--rounds", "N",
                                "repeat each measurement of time (3.2 and 3.5) N times and report the median "
                                "(default: 3)"},
                               &M::rounds, 1, 1000)}})
          .with(destination_options(
              "write theorems.json, theorems.csv and report.html to DIR (default: none)"));
  return list;
}

std::vector<Theorem> theorems_of(const std::vector<std::string>& operands) {
  std::vector<Theorem> theorems;
  for (const std::string& name : operands) {
    const auto theorem = choice_of<Theorem>("THEOREM", name, theorem_names);
    if (std::ranges::find(theorems, theorem) != theorems.end())
      throw InputError(fmt::format("THEOREM: {} is listed twice", name));
    theorems.push_back(theorem);
  }
  if (theorems.empty())
    theorems = {Theorem::tightness, Theorem::family, Theorem::search, Theorem::closest_pair};
  std::ranges::sort(theorems);
  return theorems;
}

TheoremsAsked parse_theorems(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kTheoremsCommand, theorems_options().specs(), arguments);
  TheoremsAsked asked;
  asked.measured.theorems = theorems_of(parsed.operands());  // the theorems bound --beads
  theorems_options().read(parsed, asked);
  if (parsed.has("--rounds") && !measures_time(asked.measured.theorems))
    throw InputError("--rounds applies only to theorems 3.2 and 3.5, which measure time");
  return asked;
}

std::vector<TheoremSeries> measure(const TheoremOptions& options, const TableCommand::Progress& progress) {
  TheoremPlan plan = plan_theorems(options);
  std::size_t done = 0;
  for (const auto& work : plan.work) {
    work(plan.series);
    progress(++done, plan.work.size());
  }
  std::ranges::stable_sort(plan.series, {}, &TheoremSeries::theorem);
  return std::move(plan.series);
}

Json settings_json(const TheoremsAsked& asked) {
  std::vector<std::string_view> theorems;
  for (const Theorem theorem : asked.measured.theorems) theorems.push_back(name_of(theorem));
  return theorems_options().settings_json(asked, {{"theorems", theorems}});
}

}  // namespace

int theorems_command(const Arguments& arguments) {
  const TheoremsAsked asked = parse_theorems(arguments);
  TableCommand command("theorems", arguments, asked, "measurement");
  command.check_destinations();
  const std::vector<TheoremSeries> series = measure(asked.measured, command.progress());
  command.bar().erase();

  Json json;
  json["settings"] = settings_json(asked);
  json["rows"] = theorem_rows_json(series);
  json["fits"] = theorem_fits_json(series);
  command.deliver(json, theorems_csv(series), theorems_table(series),
                  [&](Page page) { return theorems_page(series, std::move(page)); });
  return 0;
}

}  // namespace kds
