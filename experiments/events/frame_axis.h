#pragma once
// The axis of a plot over frames.

#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include "motions/frames/frame_stamp.h"

namespace kds {

/// Shows frames by their times if all of them have times in ascending order, otherwise by their numbers.
/// Times of 1e100 ps and more are not shown, because gnuplot cannot draw the largest ones.
class FrameAxis {
 public:
  /// Takes the frames of the plot in their order.
  explicit FrameAxis(std::span<const FrameStamp> frames) : timed_(!frames.empty()) {
    for (std::size_t k = 0; k < frames.size() && timed_; ++k)
      timed_ = frames[k].picoseconds && std::abs(*frames[k].picoseconds) < 1e100 &&
               (k == 0 || *frames[k - 1].picoseconds < *frames[k].picoseconds);
  }

  [[nodiscard]] std::string label() const { return timed_ ? "time in picoseconds" : "frame"; }
  [[nodiscard]] double coordinate(const FrameStamp& frame) const {
    return timed_ ? *frame.picoseconds : static_cast<double>(frame.number);
  }

 private:
  bool timed_;
};

}  // namespace kds
