#include "experiments/update/update_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/text.h"
#include "experiments/program/option_lists.h"
#include "experiments/program/option_values.h"

namespace kds {

namespace {

constexpr std::array kUpdateOptions{
    OptionSpec{
        "--techniques", "LIST",
        "comma list of rebuild, reinsert, greedy, kinetic, hermite, lifted, activate, auto; rebuild is "
        "always run (default: all)"},
    OptionSpec{"--strides", "LIST", "every how many frames the diagram is asked for (default: 1)"},
    OptionSpec{"--rounds", "N", "runs of each technique in turn, of which the median counts (default: 3)"},
    OptionSpec{"--audit", "WHEN", "compare with the static diagram: none or frames (default: none)"},
    OptionSpec{"--out", "DIR", "write update.json, update.csv and report.html there (default: none)"},
    OptionSpec{"--json", "FILE", "write the rows there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr auto kAllUpdateOptions = joined(kInputOptions, kUpdateOptions);

constexpr CommandSpec kUpdateCommand{
    "kds update",
    "Compares techniques that bring the power diagram from frame to frame: what they do, and how long.",
    kInputOperand,
    kTrajectoryHelp,
    kAllUpdateOptions,
    "kds update villin.dcd --topology villin.pdb --frames 0:200 --strides 1,2,4,8 --out report\n"
    "kds update 1l2y.pdb --select all --radius element --techniques kinetic,lifted --audit frames --json -",
};

std::vector<std::string> parse_techniques(const std::string& list) {
  const std::vector<std::string> names = split(list, ',');
  for (const std::string& name : names) {
    if (std::find(kTechniques.begin(), kTechniques.end(), name) == kTechniques.end())
      refuse_unknown("--techniques", name, kTechniques);
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError(fmt::format("--techniques: {} is listed twice", name));
  }
  std::vector<std::string> ordered;
  for (const std::string_view name : kTechniques) {
    if (name == kTechniques.front() || std::find(names.begin(), names.end(), name) != names.end())
      ordered.emplace_back(name);
  }
  return ordered;
}

}  // namespace

UpdateOptions parse_update_options(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kUpdateCommand, arguments);
  UpdateOptions options;
  options.input = parse_input_options(parsed, kUpdateCommand.name);
  if (const auto list = parsed.value("--techniques")) options.techniques = parse_techniques(*list);
  if (const auto list = parsed.value("--strides")) options.strides = parse_strides(*list);
  if (const auto text = parsed.value("--rounds"))
    options.rounds = parse_whole_number("--rounds", *text, 1, 1000);
  options.audit =
      chosen<AuditMode>(parsed, "--audit", std::span(audit_mode_names).first(2)).value_or(options.audit);
  options.out = path_of(parsed, "--out");
  options.json = parsed.value("--json");
  options.quiet = parsed.has("--quiet");
  return options;
}

}  // namespace kds
