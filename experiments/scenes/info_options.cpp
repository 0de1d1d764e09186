#include "experiments/scenes/info_options.h"

#include <limits>

#include "experiments/program/option_values.h"

namespace kds {

namespace {

constexpr std::array kInfoOptions{
    OptionSpec{"--rho", "NUMBER",
               "the largest ratio of two radii, and of two bonds, that is uniform (default: any)"},
    OptionSpec{"--list", "N", "how many violations of a condition to list (default: 5)"},
    OptionSpec{"--beads", "", "a row a bead instead: its necklace, chain, residue, atom and radius"},
    OptionSpec{"--out", "DIR", "write info.json and info.csv there (default: none)"},
    OptionSpec{"--json", "FILE", "write all of it there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr auto kAllInfoOptions = joined(kInputOptions, kInfoOptions);

constexpr CommandSpec kInfoCommand{
    "kds info",
    "Describes trajectories, and tells which conditions of a proper necklace they violate, exactly.",
    kInputOperand,
    kInputHelp,
    kAllInfoOptions,
    "kds info villin.dcd --topology villin.pdb --frames ::10\n"
    "kds info 1a4y.pdb --radius element:fit --rho 2 --json -\n"
    "kds info 1a4y.pdb --beads",
};

}  // namespace

InfoOptions parse_info_options(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(kInfoCommand, arguments);
  InfoOptions options;
  options.input = parse_input_options(parsed, kInfoCommand.name);
  if (const auto text = parsed.value("--rho"))
    options.validate.rho = parse_real("--rho", *text, {1, std::numeric_limits<double>::max()});
  if (const auto text = parsed.value("--list"))
    options.validate.most_listed = parse_whole_number("--list", *text, 0, 1'000'000);
  options.beads = parsed.has("--beads");
  if (options.beads && (parsed.has("--rho") || parsed.has("--list")))
    throw InputError("--beads: it judges no conditions, which --rho and --list are about");
  options.out = path_of(parsed, "--out");
  options.json = parsed.value("--json");
  options.quiet = parsed.has("--quiet");
  return options;
}

}  // namespace kds
