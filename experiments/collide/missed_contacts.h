#pragma once
// The experiment behind `kds missed`: all contacts of a run, with their exact times, and which of them are
// seen by looking at frames only, every frame, every second, every fourth ... A contact that begins and ends
// between two frames looked at is missed.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/program/input_options.h"
#include "motions/base/bead.h"
#include "motions/scene/scene.h"

namespace kds {

struct MissedTask : InputOptions {
  FrameMotion motion = FrameMotion::linear;
  std::vector<double> factors{1};    ///< of radii, a run each
  std::vector<std::size_t> strides;  ///< ascending; none: 1, 2, 4 ... 64, as far as they look at two frames
  BeadId apart = 2;
};

/// One stride of one run.
struct MissedRow {
  double factor = 1;
  std::size_t stride = 1;
  std::size_t frames = 0;  ///< looked at
  std::uint64_t contacts = 0, found = 0;

  [[nodiscard]] std::uint64_t missed() const { return contacts - found; }
};

/// What the input is, radii by their rule and not multiplied.
struct MissedInput {
  std::size_t beads = 0, necklaces = 0, frames = 0;
  int dimension = 3;
  double radius_min = 0, radius_max = 0;
};

struct MissedReport {
  MissedInput input;
  std::vector<MissedRow> rows;  ///< factor by factor, of each by stride
};

/// Warnings about the input go to `warn`, one line each. Throws InputError for whatever is wrong with it, and
/// where a stride that is asked for looks at one frame only.
[[nodiscard]] MissedReport count_missed(const MissedTask& task,
                                        const std::function<void(const std::string&)>& warn,
                                        const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
