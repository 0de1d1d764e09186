#pragma once
// The number and the time of a frame in a file.

#include <cstddef>
#include <optional>

namespace kds {

/// A frame's position in its file, and its time.
struct FrameStamp {
  std::size_t number = 0;             ///< position in the file, from 0
  std::optional<double> picoseconds;  ///< none if the file has no times
};

}  // namespace kds
