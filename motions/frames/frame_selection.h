#pragma once
// Which frames of a file a run asks for.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

/// 0-based frames first, first+stride, ... below last.
struct FrameRange {
  std::size_t first = 0;
  std::optional<std::size_t> last = {};  ///< excluded; none: to the end
  std::size_t stride = 1;                ///< at least 1
};

/// From the text of --frames, FIRST:LAST:STRIDE; parts may be left empty (":100", "10:", "::2"), a lone
/// number has no meaning. Throws InputError naming the option.
[[nodiscard]] FrameRange parse_frame_range(std::string_view text);

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
