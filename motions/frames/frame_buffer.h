#pragma once
// Frames that are read once and used twice: by a part of a run on another thread, and by the run itself.

#include <cstddef>
#include <deque>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motions/frames/frame_source.h"

namespace kds {

/// Consecutive frames that threads share. The frames do not change.
struct SharedFrames {
  std::size_t first = 0;                                      ///< number of the first frame
  std::vector<std::shared_ptr<const FrameRead>> frames = {};  ///< null: the source has no such frame
  std::exception_ptr error = {};  ///< thrown by the frame after the last one, if any
};

/// A source whose frames may be read ahead. Only one thread at a time may use it. Frames that were read ahead
/// stay in memory until `release`. Without `read_ahead`, the buffer only passes frames on.
class FrameBuffer final : public FrameSource {
 public:
  /// `next` is the frame that the source gives next.
  explicit FrameBuffer(std::unique_ptr<FrameSource> source, std::size_t next = 0)
      : source_(std::move(source)), next_(next), source_next_(next) {}

  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return source_->necklaces(); }
  [[nodiscard]] bool next(FrameRead& frame) override;
  void seek(std::size_t k) override;
  [[nodiscard]] bool is_open() const override { return source_->is_open(); }
  [[nodiscard]] bool is_truncated() const override { return source_->is_truncated(); }
  [[nodiscard]] std::vector<std::string> warnings() const override { return source_->warnings(); }

  /// Returns the frames from `first` to `last`, and keeps them. Ranges must be asked for in ascending order
  /// and may overlap. A range before those kept begins another pass. If a frame cannot be read, the range
  /// ends before this frame and holds the error; so does each later range that reaches the frame.
  [[nodiscard]] SharedFrames read_ahead(std::size_t first, std::size_t last);
  /// Forgets frames below this one that were read ahead.
  void release(std::size_t below);

 private:
  std::unique_ptr<FrameSource> source_;
  std::size_t next_;         ///< the frame that `next` gives
  std::size_t source_next_;  ///< the frame that the source gives
  std::deque<std::shared_ptr<const FrameRead>> kept_;
  std::size_t first_kept_ = 0;
  std::exception_ptr error_;  ///< of the frame after those kept
};

/// A source of frames in memory that are added range by range. Frames have their numbers in the whole run.
/// `next` throws std::logic_error for a frame before those held, and the error of a frame that cannot be
/// read.
class FrameRanges final : public FrameSource {
 public:
  /// The necklaces must outlive the source.
  explicit FrameRanges(const std::vector<NecklaceBeads>& necklaces) : necklaces_(necklaces) {}

  /// Adds a range, which may overlap the ranges before it. Throws std::logic_error if it leaves a gap.
  void add(const SharedFrames& range);
  /// Forgets frames below this one.
  void release(std::size_t below);

  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return necklaces_; }
  [[nodiscard]] bool next(FrameRead& frame) override;
  void seek(std::size_t k) override { next_ = k; }

 private:
  const std::vector<NecklaceBeads>& necklaces_;
  SharedFrames held_;
  std::size_t next_ = 0;
};

}  // namespace kds
