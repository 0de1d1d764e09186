#pragma once
// Event times for printing: decimal numbers whose digits are all certain.

#include <optional>

#include "certificates/exact/instant.h"
#include "motions/frames/frame_stamp.h"

namespace kds {

/// A time on a scale that runs from one frame to the next, rounded to twelve significant digits (half to
/// even). A number printed with `{:.12g}` shows these digits.
struct RoundedTime {
  double frame = 0;                   ///< counted in frames, with a fraction between two frames
  std::optional<double> picoseconds;  ///< empty if a frame has no time
};

/// Rounds `now`, a time in the step between two frames. Narrows a copy of the exact root behind `now` until
/// all digits are certain. Ties of the rounding are decided exactly, so the function always ends. Returns
/// fewer digits if only a bracket is known (a replayed time).
[[nodiscard]] RoundedTime rounded_time(const Instant& now, const FrameStamp& from, const FrameStamp& to);

}  // namespace kds
