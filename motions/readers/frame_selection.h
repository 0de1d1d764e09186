#pragma once
// Which frames of a file a run asks for.

#include <cstddef>
#include <string>
#include <vector>

#include "motions/readers/read_trajectory.h"

namespace kds {

/// What a file turned out to hold.
struct FramesHeld {
  std::size_t whole = 0;
  bool ends_inside = false;  ///< more of a frame follows the whole ones
};

/// The numbers of the frames asked for, ascending: first, first + stride, ...
struct FramesAsked {
  std::size_t first = 0, stride = 1, count = 0;

  [[nodiscard]] std::size_t operator[](std::size_t i) const { return first + i * stride; }
};

/// The frames asked for. Throws InputError if they are not all there; a file that
/// ends inside a frame is an error unless the range names its last frame, and is warned of then. Frames
/// behind the last one that a stride meets are told of likewise. The one frame of a file of one is taken
/// whatever the range: such a necklace is at rest.
[[nodiscard]] FramesAsked select_frames(const std::string& file, const FrameRange& range,
                                        const FramesHeld& held, std::vector<std::string>& warnings);

}  // namespace kds
