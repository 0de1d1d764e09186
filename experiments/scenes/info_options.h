#pragma once
// The options of `kds info` and their parser.

#include "experiments/output/output_files.h"
#include "experiments/program/input_options.h"
#include "structures/necklace/necklace.h"

namespace kds {

struct InfoOptions : InputOptions, Destinations {  // results: info.json and info.csv
  ValidateOptions validate{.most_listed = 5};
  bool beads = false;  ///< report only which residue each bead is
};

[[nodiscard]] const OptionList<InfoOptions>& info_options();

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] InfoOptions parse_info_options(const Arguments& arguments);

}  // namespace kds
