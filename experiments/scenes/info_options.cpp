#include "experiments/scenes/info_options.h"

#include <limits>

#include "experiments/program/option_values.h"

namespace kds {

namespace {

constexpr CommandSpec kInfoCommand{
    "kds info",
    "Describes trajectories, and decides exactly which conditions of a proper necklace they violate.",
    kInputOperand,
    kInputHelp,
    "kds info villin.dcd --topology villin.pdb --frames ::10\n"
    "kds info 1a4y.pdb --radius element:fit --rho 2 --json -\n"
    "kds info 1a4y.pdb --beads",
};

}  // namespace

const OptionList<InfoOptions>& info_options() {
  using O = InfoOptions;
  static const auto list =
      OptionList<O>()
          .with(input_options())
          .with(&O::validate,
                {{real_option(
                      {"--rho", "NUMBER",
                       "largest ratio of two radii, or of two bonds, that counts as uniform (default: any)"},
                      &ValidateOptions::rho, {1, std::numeric_limits<double>::max()}),
                  of_output(whole_option(
                      {"--list", "N", "number of violations to list for each condition (default: 5)"},
                      &ValidateOptions::most_listed, 0, 1'000'000))}})
          .with({of_output(flag_option(
              "--beads", "list the beads instead, one in a row: necklace, chain, residue, atom and radius",
              &O::beads))})
          .with(destination_options("write info.json and info.csv to DIR (default: none)",
                                    "write all of it to FILE; - is standard output (default: none)"));
  return list;
}

InfoOptions parse_info_options(const Arguments& arguments) {
  InfoOptions options;
  const ParsedArguments parsed = read_arguments(kInfoCommand, info_options(), arguments, options);
  take_inputs(parsed, kInfoCommand.name, options);
  if (options.beads && (parsed.has("--rho") || parsed.has("--list")))
    throw InputError("--beads: it judges no conditions, which --rho and --list are about");
  return options;
}

}  // namespace kds
