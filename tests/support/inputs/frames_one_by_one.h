#pragma once
// Frames that come one by one and only once, as from a running simulation.

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/frames/frame_source.h"

namespace kds::test {

class FramesOneByOne final : public FrameSource {
 public:
  /// `broken`: the connection breaks after the last frame.
  FramesOneByOne(std::vector<NecklaceBeads> necklaces, std::vector<FrameRead> frames, bool broken = false)
      : necklaces_(std::move(necklaces)), frames_(std::move(frames)), broken_(broken) {}

  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return necklaces_; }
  [[nodiscard]] bool next(FrameRead& frame) override {
    if (next_ == frames_.size()) {
      ended_ = true;
      return false;
    }
    frame = frames_[next_++];
    if (!frame.positions.allFinite()) throw InputError("a number is not finite");
    return true;
  }
  void seek(std::size_t /*k*/) override { throw std::logic_error("a frame is read twice"); }
  [[nodiscard]] bool is_open() const override { return !ended_; }
  [[nodiscard]] bool is_truncated() const override { return ended_ && broken_; }
  [[nodiscard]] std::optional<LiveState> live() const override { return LiveState{next_, next_, 0, 0}; }

 private:
  std::vector<NecklaceBeads> necklaces_;
  std::vector<FrameRead> frames_;
  bool broken_;
  std::size_t next_ = 0;
  bool ended_ = false;
};

/// Returns all frames of a source.
inline std::vector<FrameRead> all_frames(FrameSource& source) {
  std::vector<FrameRead> frames;
  for (FrameRead frame; source.next(frame);) frames.push_back(frame);
  return frames;
}

}  // namespace kds::test
