#pragma once
// `kds compare`: what it was asked to do, and how that is parsed.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/output/destinations.h"
#include "experiments/program/input_options.h"
#include "motions/base/bead.h"
#include "motions/scene/scene.h"

namespace kds {

/// Each input is a run of its own. Results: compare.json, compare.csv, report.html.
struct CompareOptions : InputOptions, Destinations {
  std::vector<std::string> structures;  ///< in their order; empty: the input's default
  std::vector<std::size_t> strides{1};  ///< ascending
  std::vector<FrameMotion> motions{FrameMotion::linear};
  std::size_t rounds = 3;       ///< each run so often, for its time
  std::optional<BeadId> apart;  ///< --apart
};

[[nodiscard]] const OptionList<CompareOptions>& compare_options();

/// Throws InputError naming the option and what it takes, HelpRequest for --help. Opens no file.
[[nodiscard]] CompareOptions parse_compare_options(const Arguments& arguments);

}  // namespace kds
