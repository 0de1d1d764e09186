#pragma once
// The options of `kds missed`.

#include <cstddef>
#include <vector>

#include "experiments/program/command_line.h"
#include "experiments/program/contact_options.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option.h"
#include "motions/base/bead.h"
#include "motions/scene/scene.h"

namespace kds {

struct MissedTask : InputOptions {
  FrameMotion motion = FrameMotion::linear;
  std::vector<double> factors{1};  ///< factors of the radii; each is a run unless there are cutoffs
  ContactDistances distances;      ///< --cutoff and --surface; each is a run
  /// Ascending. If empty, the strides are 1, 2, 4 ... 64, as far as at least two frames are examined.
  std::vector<std::size_t> strides;
  BeadId apart = 2;
};

struct MissedOptions {
  MissedTask task;
  Destinations destinations;
};

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] MissedOptions parse_missed_options(const Arguments& arguments);

}  // namespace kds
