#pragma once
// The experiment behind `kds missed`. It computes all contacts of a run with their exact times, and counts
// the contacts that are seen if only frames are examined: every frame, every second frame, every fourth
// frame, and so on. A contact that begins and ends between two examined frames is missed.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/table.h"
#include "experiments/program/command_line.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option.h"
#include "motions/base/bead.h"
#include "motions/scene/scene.h"

namespace kds {

struct MissedTask : InputOptions {
  FrameMotion motion = FrameMotion::linear;
  std::vector<double> factors{1};  ///< factors of the radii; each is a run
  /// Ascending; empty for those of 1, 2, 4 ... 64 that examine at least two frames.
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
