#include "experiments/scenes/info_options.h"

#include <limits>

#include "experiments/program/option_values.h"

namespace kds {

namespace {

constexpr CommandSpec kInfoCommand{
    "kds info",
    "Describes trajectories, and tells which conditions of a proper necklace they violate, exactly.",
    kInputOperand,
    kInputHelp,
    {},
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
                       "the largest ratio of two radii, and of two bonds, that is uniform (default: any)"},
                      &ValidateOptions::rho, {1, std::numeric_limits<double>::max()}),
                  of_output(
                      whole_option({"--list", "N", "how many violations of a condition to list (default: 5)"},
                                   &ValidateOptions::most_listed, 0, 1'000'000))}})
          .with({of_output(flag_option(
              "--beads", "a row a bead instead: its necklace, chain, residue, atom and radius", &O::beads))})
          .with(destination_options("write info.json and info.csv there (default: none)",
                                    "write all of it there; - is standard output (default: none)"));
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
