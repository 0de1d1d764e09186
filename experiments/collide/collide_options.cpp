#include "experiments/collide/collide_options.h"

#include <algorithm>
#include <limits>

#include "experiments/collide/methods.h"
#include "experiments/output/text.h"
#include "experiments/program/option_values.h"

namespace kds {

namespace {

constexpr std::array kFurtherOptions{
    OptionSpec{"--pairs", "NAME", "of beads within a necklace, between two, or all (default: all)"},
    OptionSpec{"--apart", "K", "only beads at least so many apart along their necklace (default: 2)"},
    OptionSpec{"--within", "X",
               "pairs whose surfaces are at most so far apart (default: 0, those that meet)"},
    OptionSpec{
        "--rounds", "N",
        "each method so often: times are the median, with the least and most (default: 3 where methods "
        "are compared, else 1)"},
    OptionSpec{
        "--out", "DIR",
        "write collide.json, collide.csv, pairs.csv, frames.csv and report.html there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& method : collision_methods()) names.emplace_back(method.name);
  return names;
}

std::string method_help() {
  std::vector<std::string> methods;
  for (const Method& method : collision_methods())
    methods.push_back(fmt::format("{} ({})", method.name, method.about));
  return fmt::format("comma list of {}, or all (default: all)", fmt::join(methods, ", "));
}

const CommandSpec& command() {
  static const std::string help = method_help();
  static const auto options = joined(
      kInputOptions,
      joined(kObstacleOption, joined(std::array{OptionSpec{"--method", "LIST", help}}, kFurtherOptions)));
  static const CommandSpec spec{
      "kds collide",
      "Which beads collide in each frame, exactly: closed balls, so touching counts. Methods are compared.",
      kInputOperand,
      kTrajectoryHelp,
      options,
      "kds collide 1l2y.pdb --select all --radius element --apart 4\n"
      "kds collide a.xyz b.xyz --pairs between --method wrapped,layered --json -\n"
      "kds collide 1l2y.pdb --radius 0.1 --within 4.5 --apart 9 --method auto\n"
      "kds collide villin.dcd --topology villin.pdb --radius 1.9 --apart 5 --out report"};
  return spec;
}

std::vector<std::string> parse_methods(const std::string& list) {
  const std::vector<std::string> all = method_names(), names = split(list, ',');
  for (const std::string& name : names) {
    if (std::find(all.begin(), all.end(), name) == all.end())
      refuse_unknown("--method", name, std::vector<std::string_view>(all.begin(), all.end()),
                     fmt::format("one of {} or, alone, all", fmt::join(all, ", ")));
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError(fmt::format("--method: {} is listed twice", name));
  }
  std::vector<std::string> ordered;
  for (const std::string& name : all)
    if (std::find(names.begin(), names.end(), name) != names.end()) ordered.push_back(name);
  return ordered;
}

}  // namespace

CollideOptions parse_collide_options(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(command(), arguments);
  CollideOptions options;
  options.input = parse_input_options(parsed, command().name);
  const std::string methods = parsed.value("--method").value_or("all");
  options.all_methods = methods == "all";
  options.methods = options.all_methods ? method_names() : parse_methods(methods);
  options.pairs = chosen<WhichPairs>(parsed, "--pairs", which_pairs_names).value_or(options.pairs);
  if (const auto text = parsed.value("--apart")) options.apart = parse_apart(*text);
  if (const auto text = parsed.value("--within"))
    options.within = parse_real("--within", *text, {0, std::numeric_limits<double>::max()});
  options.rounds = options.methods.size() > 1 ? 3 : 1;
  if (const auto text = parsed.value("--rounds"))
    options.rounds = parse_whole_number("--rounds", *text, 1, 1000);
  options.destinations = {path_of(parsed, "--out"), parsed.value("--json"), parsed.has("--quiet")};
  return options;
}

}  // namespace kds
