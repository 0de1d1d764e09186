#pragma once
// Frames with fewer turns: each bead goes on along one straight line, over as many frames as that stays
// within a tolerance of where the frames have it.
//
// Frames are taken in blocks of 16 steps. A bead moves along the chord of its positions at both ends of a
// block if none of those in between is farther from it than the tolerance; else the block is halved for this
// bead, and so on: where beads turn are frames that many have in common. Between frames the files' motion and
// this one are both linear, so that a bead is never farther from where it was than at a frame. Exact for the
// doubles that are handed on: what is not certainly within the tolerance is halved.

#include <cstddef>
#include <utility>
#include <vector>

#include "motions/readers/frame_reader.h"

namespace kds {

class StraightenedFrames {
 public:
  static constexpr std::size_t block = 16;

  explicit StraightenedFrames(double tolerance) : tolerance_(tolerance) {}

  /// The next frame of those that `read(frame)` reads, false behind the last.
  template <class Read>
  [[nodiscard]] bool next(FrameRead& frame, Read read) {
    if (place_ == ready_.size()) fill(read);
    if (place_ == ready_.size()) return false;
    frame.stamp = ready_[place_].stamp;
    frame.positions = ready_[place_++].positions;
    frame.cell.reset();
    return true;
  }
  void rewind();

 private:
  template <class Read>
  void fill(Read read) {
    std::vector<FrameRead> samples;
    if (!ready_.empty()) samples.push_back(std::move(last_));
    const std::size_t begun = samples.size();
    for (FrameRead frame; samples.size() <= block && read(frame);)
      samples.push_back({frame.stamp, std::move(frame.positions), {}});
    straighten(samples, begun);
  }
  /// Of a block, whose first frame has been handed on if `begun` is 1.
  void straighten(std::vector<FrameRead>& samples, std::size_t begun);

  double tolerance_;
  std::vector<FrameRead> ready_;  ///< of the present block
  std::size_t place_ = 0;         ///< of the next in it
  FrameRead last_;                ///< the last one, as it was read
};

}  // namespace kds
