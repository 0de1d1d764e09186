#pragma once
// Selection of the frames of a file for a run.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

/// The frames first, first + stride, ... below last, counted from 0.
struct FrameRange {
  std::size_t first = 0;
  std::optional<std::size_t> last = {};  ///< exclusive; none: to the end
  std::size_t stride = 1;                ///< at least 1
};

/// Parses the text of --frames, FIRST:LAST:STRIDE. Parts may be empty (":100", "10:", "::2"), but a single
/// number is not allowed. Throws InputError naming the option.
[[nodiscard]] FrameRange parse_frame_range(std::string_view text);

/// The frames that a file contains.
struct FramesHeld {
  std::size_t whole = 0;
  bool ends_inside = false;  ///< an incomplete frame follows the whole ones
};

/// The numbers of the requested frames, ascending: first, first + stride, ...
struct FramesAsked {
  std::size_t first = 0, stride = 1, count = 0;

  [[nodiscard]] std::size_t operator[](std::size_t i) const { return first + i * stride; }
};

/// Returns the requested frames. Throws InputError if some are missing. A file that ends inside a frame is an
/// error, unless the range gives the last frame; then it only causes a warning. Another warning tells of
/// frames after the last one that the stride reaches. If a file has a single frame, it is used for any range:
/// such a necklace is at rest.
[[nodiscard]] FramesAsked select_frames(const std::string& file, const FrameRange& range,
                                        const FramesHeld& held, std::vector<std::string>& warnings);

}  // namespace kds
