#pragma once
// Selection of the frames of a file for a run.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motions/base/input_error.h"

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

/// A frame whose bytes are not what its format allows. The message names file, frame and byte.
class DamagedFrame : public InputError {
 public:
  DamagedFrame(const std::string& file, std::size_t frame, std::uint64_t byte, const std::string& what);
  [[nodiscard]] std::size_t frame() const { return frame_; }

 private:
  std::size_t frame_;
};

/// Returns the warning that only the frames before the damaged one are read.
[[nodiscard]] std::string warning_of(const DamagedFrame& damage);

/// The frames that a file contains, or that a running simulation makes.
struct FramesHeld {
  std::size_t whole = 0;
  bool ends_inside = false;                 ///< the file ends inside the frame after the whole ones
  std::uint64_t end = 0;                    ///< if it does: the file's length in bytes, unpacked
  std::optional<DamagedFrame> damage = {};  ///< damage in the frame after the whole ones
  bool lacks_line_end = false;              ///< if it ends inside: its last number may be cut off
  bool open = false;  ///< a simulation makes the frames: their number is unknown, all else is unset
};

/// The numbers of the requested frames, ascending: first, first + stride, ...
struct FramesAsked {
  std::size_t first = 0, stride = 1, count = 0;
  bool truncated = false;  ///< the file ends inside a frame, or frames asked for are damaged and left out
  bool at_rest = false;    ///< the file holds only one frame

  [[nodiscard]] std::size_t operator[](std::size_t i) const { return first + i * stride; }
};

/// Walks through a file from the first frame asked for to the last: through those asked for, or all.
class FrameWalk {
 public:
  FrameWalk(const FramesAsked& asked, bool all) : asked_(asked), step_(all ? 1 : asked.stride) {}

  /// Goes to the next frame; returns false after the last one asked for.
  [[nodiscard]] bool next() {
    const std::size_t frame = begun_ ? frame_ + step_ : asked_.first;
    if (asked_.count == 0 || frame > asked_[asked_.count - 1]) return false;
    begun_ = true;
    frame_ = frame;
    return true;
  }
  void rewind() { begun_ = false; }
  [[nodiscard]] std::size_t frame() const { return frame_; }
  [[nodiscard]] bool is_asked() const { return (frame_ - asked_.first) % asked_.stride == 0; }

 private:
  FramesAsked asked_;
  std::size_t step_;
  std::size_t frame_ = 0;
  bool begun_ = false;
};

/// Returns the frames asked for. Throws InputError if one of these frames is missing.
///
/// A file that ends inside its last frame gives the whole frames before it, with a warning. Throws
/// DamagedFrame if a frame asked for, or any frame of an open range, is damaged; `until_damage` reads the
/// frames before it instead, with a warning. Warns of frames after the last one that a stride meets. If a
/// file has one frame, the frame is taken whatever the range is, and the necklace is at rest. If the frames
/// are open, returns all of the range; a range without an end goes up to the largest std::size_t.
[[nodiscard]] FramesAsked select_frames(const std::string& file, const FrameRange& range,
                                        const FramesHeld& held, bool until_damage,
                                        std::vector<std::string>& warnings);

}  // namespace kds
