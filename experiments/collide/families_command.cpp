#include "experiments/collide/families_command.h"

#include <fmt/format.h>

#include <array>

#include "experiments/collide/family_sizes.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"

namespace kds {

namespace {

constexpr const char* kName = "families";

constexpr std::array kOptions{
    OptionSpec{"--beads", "N", "of the largest grids, from 1000 to 10000000 (default: 100000)"},
    OptionSpec{"--dimension", "D", "2 or 3 (default: both)"},
    OptionSpec{"--hierarchy", "NAME", "wrapped or layered (default: both)"},
    OptionSpec{"--gap", "X", "between rows, in diameters (default: 0.05)"},
    OptionSpec{"--out", "DIR", "write families.json and families.csv there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr CommandSpec kCommand{
    "kds families",
    "Measures separating families of packed grids beside the theorem: n log n in the plane, n^(4/3) in "
    "space.",
    "",
    "",
    kOptions,
    "kds families --beads 1000000 --hierarchy wrapped\n"
    "kds families --dimension 2 --json -",
};

struct Families {
  std::vector<FamilySize> rows;
  std::vector<FittedExponent> fits;
};

struct FamiliesOptions {
  std::size_t most_beads = 100'000;
  std::vector<int> dimensions{2, 3};
  std::vector<Hierarchy> hierarchies{Hierarchy::wrapped, Hierarchy::layered};
  double gap = 0.05;
  Destinations destinations;
};

std::string_view name_of(Hierarchy hierarchy) { return hierarchy_names[static_cast<std::size_t>(hierarchy)]; }

FamiliesOptions parse(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kCommand, arguments);
  FamiliesOptions options;
  if (const auto text = parsed.value("--beads"))
    options.most_beads = parse_whole_number("--beads", *text, 1000, 10'000'000);
  if (const auto text = parsed.value("--dimension"))
    options.dimensions = {static_cast<int>(parse_whole_number("--dimension", *text, 2, 3))};
  if (const auto hierarchy = chosen<Hierarchy>(parsed, "--hierarchy", hierarchy_names))
    options.hierarchies = {*hierarchy};
  if (const auto text = parsed.value("--gap")) options.gap = parse_real("--gap", *text, {0.001, 0.9});
  options.destinations = {path_of(parsed, "--out"), parsed.value("--json"), parsed.has("--quiet")};
  return options;
}

Families measure(const FamiliesOptions& options) {
  Families families;
  ProgressBar bar(!options.destinations.quiet);
  std::size_t done = 0, total = 0;
  for (const int dimension : options.dimensions)
    total += options.hierarchies.size() * sides_of_grids(dimension, options.most_beads).size();
  for (const int dimension : options.dimensions) {
    for (const Hierarchy hierarchy : options.hierarchies) {
      const std::size_t first = families.rows.size();
      for (const std::size_t side : sides_of_grids(dimension, options.most_beads)) {
        families.rows.push_back(measure_family(dimension, hierarchy, side, options.gap));
        bar.update(++done, total);
      }
      const auto fit = fit_exponent(std::span(families.rows).subspan(first));
      if (fit) families.fits.push_back(*fit);
    }
  }
  return families;
}

Json json_of(const FamiliesOptions& options, const Families& families) {
  Json rows = Json::array(), fits = Json::array();
  for (const FamilySize& row : families.rows)
    rows.push_back({{"dimension", row.dimension},
                    {"hierarchy", name_of(row.hierarchy)},
                    {"side", row.side},
                    {"n", row.beads},
                    {"family", row.family},
                    {"ratio", row.ratio()},
                    {"seconds", row.seconds},
                    {"build_seconds", row.build_seconds}});
  for (const FittedExponent& fit : families.fits)
    fits.push_back({{"dimension", fit.dimension},
                    {"hierarchy", name_of(fit.hierarchy)},
                    {"sizes", fit.sizes},
                    {"exponent", fit.exponent},
                    {"lower", fit.lower},
                    {"upper", fit.upper},
                    {"expected", fit.expected}});
  Json json{
      {"settings", {{"beads", options.most_beads}, {"gap", options.gap}}}, {"rows", rows}, {"fits", fits}};
  add_provenance(json);
  return json;
}

std::string csv_of(const Families& families) {
  std::string text = "dimension,hierarchy,side,n,family,ratio,seconds,build_seconds\n";
  for (const FamilySize& row : families.rows)
    text += fmt::format("{},{},{},{},{},{},{},{}\n", row.dimension, name_of(row.hierarchy), row.side,
                        row.beads, row.family, row.ratio(), row.seconds, row.build_seconds);
  return text;
}

std::string table_of(const Families& families) {
  std::string text = fmt::format("{:<10}{:<10}{:>6}{:>12}{:>14}{:>10}{:>10}\n", "dimension", "hierarchy",
                                 "side", "n", "family", "ratio", "seconds");
  for (const FamilySize& row : families.rows)
    text += fmt::format("{:<10}{:<10}{:>6}{:>12}{:>14}{:>10.3f}{:>10.3f}\n", row.dimension,
                        name_of(row.hierarchy), row.side, with_thousands(row.beads),
                        with_thousands(row.family), row.ratio(), row.seconds);
  text += "\nratio: to n log2 n in the plane, to n^(4/3) in space\n";
  for (const FittedExponent& fit : families.fits)
    text += fmt::format("{} {}: {} grows as n^{:.3f}, 95% {:.3f} to {:.3f}, theorem {:.3f}\n",
                        fit.dimension == 2 ? "plane" : "space", name_of(fit.hierarchy),
                        fit.dimension == 2 ? "family / log2 n" : "family", fit.exponent, fit.lower, fit.upper,
                        fit.expected);
  return text;
}

}  // namespace

int families_command(const Arguments& arguments) {
  const FamiliesOptions options = parse(arguments);
  check_table_destinations(options.destinations, kName);
  const Families families = measure(options);
  deliver_table(options.destinations, kName,
                {text_of(json_of(options, families)), csv_of(families), table_of(families)});
  return 0;
}

}  // namespace kds
