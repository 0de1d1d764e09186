#pragma once
// Which frame of a file, and when.

#include <cstddef>
#include <optional>

namespace kds {

/// A frame's place in its file and its time.
struct FrameStamp {
  std::size_t number = 0;             ///< 0-based place in the file
  std::optional<double> picoseconds;  ///< none where the file has no times
};

}  // namespace kds
