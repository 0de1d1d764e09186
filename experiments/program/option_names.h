#pragma once
// Values of options as users give them.

#include <string>

#include "motions/readers/read_trajectory.h"

namespace kds {

/// FIRST:LAST:STRIDE
[[nodiscard]] std::string name_of(const FrameRange& frames);

}  // namespace kds
