#pragma once
// Options of reading by the names that users give them.

#include <string>
#include <string_view>

#include "motions/readers/read_trajectory.h"

namespace kds {

[[nodiscard]] std::string_view name_of(Selection selection);
[[nodiscard]] std::string name_of(const FrameRange& frames);  ///< FIRST:LAST:STRIDE

}  // namespace kds
