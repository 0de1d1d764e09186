#pragma once
// `kds info`: what it was asked to do, and how that is parsed.

#include "experiments/output/destinations.h"
#include "experiments/program/input_options.h"
#include "structures/necklace/necklace.h"

namespace kds {

struct InfoOptions : InputOptions, Destinations {  // info.json and info.csv
  ValidateOptions validate{.most_listed = 5};
  bool beads = false;  ///< which residue each bead is, and nothing else
};

[[nodiscard]] const OptionList<InfoOptions>& info_options();

/// Throws InputError naming the option and what it takes, HelpRequest for --help. Opens no file.
[[nodiscard]] InfoOptions parse_info_options(const Arguments& arguments);

}  // namespace kds
