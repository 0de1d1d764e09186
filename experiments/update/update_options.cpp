#include "experiments/update/update_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"

namespace kds {

namespace {

constexpr CommandSpec kUpdateCommand{
    "kds update",
    "Compares techniques that update the power diagram from frame to frame: their work and their time.\n\n"
    "  rebuild   builds the diagram anew with CGAL; the others are compared with it\n"
    "  reinsert  takes out one bead of each certificate (sign condition) that fails in the next frame, and "
    "inserts\n"
    "            these beads again at their new positions\n"
    "  greedy    like reinsert, but takes out the beads of the most failed certificates first\n"
    "  kinetic   moves all beads on straight lines and makes every change in order\n"
    "  hermite   like kinetic, on cubic curves\n"
    "  lifted    like kinetic, with radii that change between frames so that certificates have a lower "
    "degree\n"
    "  activate  moves only the beads of failed certificates, until no certificate fails\n"
    "  auto      rebuilds, or moves all or some beads, by the share of certificates that fail in a sample",
    kInputOperand,
    kTrajectoryHelp,
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

const OptionList<UpdateOptions>& update_options() {
  using O = UpdateOptions;
  static const auto list =
      OptionList<O>()
          .with(input_options())
          .with({list_option({"--techniques", "LIST",
                              "comma list of rebuild, reinsert, greedy, kinetic, hermite, lifted, activate, "
                              "auto; rebuild always runs (default: all)"},
                             &O::techniques, parse_techniques),
                 list_option({"--strides", "LIST",
                              "update the diagram at every frame, every second, ...: 1,2 (default: 1)"},
                             &O::strides, parse_strides),
                 whole_option(
                     {"--rounds", "N",
                      "run each technique N times, alternating, and report the median time (default: 3)"},
                     &O::rounds, 1, 1000),
                 choice_option({"--audit", "WHEN",
                                "when to compare with the static diagram: none or frames (default: none)"},
                               &O::audit, std::span(audit_mode_names).first(2))})
          .with(destination_options("write update.json, update.csv and report.html to DIR (default: none)"));
  return list;
}

UpdateOptions parse_update_options(const Arguments& arguments) {
  UpdateOptions options;
  const ParsedArguments parsed = read_arguments(kUpdateCommand, update_options(), arguments, options);
  take_inputs(parsed, kUpdateCommand.name, options);
  return options;
}

}  // namespace kds
