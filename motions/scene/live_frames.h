#pragma once
// The frames of a running simulation.
//
// A frame that is damaged, not finite, not later than the frame before, or without the cell of the frames
// before ends the reading: the frames before it stay valid, and a line says what was wrong.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "motions/frames/frame_source.h"
#include "motions/scene/frame_survey.h"

namespace kds {

class LiveFrames final : public FrameSource {
 public:
  /// Waits for the first frame. `source` must be open (FrameSource::is_open). Throws InputError if there is
  /// no first frame.
  explicit LiveFrames(std::unique_ptr<FrameSource> source);

  /// Returns what the first frame says about all frames: their cell, and whether they have velocities. The
  /// number of frames is 0, for unknown.
  [[nodiscard]] FrameSurvey survey() const;
  /// Does without the cells of the frames, which may then change in any way.
  void leave_cells() { periodic_ = false; }

  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return source_->necklaces(); }
  /// Waits for the next frame. Throws InputError if there is no second frame because of a fault.
  [[nodiscard]] bool next(FrameRead& frame) override;
  /// Throws InputError unless k is the number of the next frame.
  void seek(std::size_t k) override;
  [[nodiscard]] bool is_open() const override { return !ended_; }
  [[nodiscard]] bool is_truncated() const override { return !fault_.empty() || source_->is_truncated(); }
  /// Includes lines about beads and cells whose path is a guess.
  [[nodiscard]] std::vector<std::string> warnings() const override;
  void close() override { source_->close(); }
  [[nodiscard]] std::optional<LiveState> live() const override { return source_->live(); }

 private:
  /// Throws InputError if the frame cannot follow the one before it.
  void check(const FrameRead& frame);

  std::unique_ptr<FrameSource> source_;
  FrameRead first_;
  CellSurvey cells_;
  bool periodic_ = false;
  FrameStamp last_;  // of the frame before
  bool ended_ = false;
  std::size_t next_ = 0;  // number of the frame that `next` gives
  std::string fault_;     // about the frame that has ended the reading
};

}  // namespace kds
