#pragma once
// Frames with fewer turns: each bead moves along one straight line for as many frames as it stays within a
// tolerance of its sampled positions.
//
// Frames are processed in blocks of 16 steps. A bead moves along a chord from one end of a block to the other
// if at every frame in between it is within the tolerance of its sample. Otherwise the block is halved for
// this bead, and so on. Because blocks are halved, many beads turn at the same frames. The ends of a chord
// are not samples but means of the samples around them, as far as the means are within the tolerance. Such a
// chord stays closer to vibrating beads and can be longer. At the first and last frame the means are the
// samples themselves, and so are the means of a coordinate at rest.
//
// Between frames, both the files' motion and this one are linear, so a bead is never farther from its sampled
// motion than at a frame. The bound is exact for the resulting doubles: a chord that is not certainly within
// the tolerance is rejected. Ends of chords lie on a grid, 2^-20 of the tolerance or finer, so all steps of a
// chord are the same double. A structure can therefore see from two consecutive steps that a bead goes
// straight on. (Coordinates at rest, and those too large for the grid, are unchanged; steps of a chord that
// begins or ends there may differ by rounding.)

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "motions/frames/frame_source.h"

namespace kds {

class StraightenedFrames final : public FrameSource {
 public:
  static constexpr std::size_t block = 16;
  /// The number of frames before and after a sample over which means are taken.
  static constexpr std::size_t reach = 5;

  /// Straightens all frames of `samples`. Throws std::logic_error if frames may still be added to them.
  StraightenedFrames(std::unique_ptr<FrameSource> samples, double tolerance);

  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return source_->necklaces(); }
  [[nodiscard]] bool next(FrameRead& frame) override;
  /// Straightens the frames again from the start to go back.
  void seek(std::size_t k) override;

 private:
  void fill();
  void go_to_next_block();
  void straighten_block();
  void straighten_bead(Eigen::Index bead, std::size_t first, std::size_t length);
  /// Returns whether the point is certainly within the tolerance of the sample, rounding included.
  [[nodiscard]] bool is_within(const Eigen::Vector3d& point, const Eigen::Vector3d& sample) const;
  [[nodiscard]] Eigen::Vector3d on_grid(const Eigen::Vector3d& point) const;
  /// Returns a possible end of a chord: near the mean of the samples around this one, and within the
  /// tolerance of the sample.
  [[nodiscard]] Eigen::Vector3d knot(std::size_t sample, Eigen::Index bead) const;

  std::unique_ptr<FrameSource> source_;
  double tolerance_;
  double most_square_;  ///< largest squared distance within the tolerance; 0: squares may not be doubles
  double grid_ = 0;     ///< 0: not yet known
  std::vector<FrameRead> samples_;  ///< samples of the present block and around it
  std::size_t begin_ = 0;           ///< first sample of the block
  std::vector<FrameRead> ready_;    ///< straightened frames of the present block
  std::size_t next_ready_ = 0;      ///< index of the next frame in `ready_`
  std::size_t next_ = 0;            ///< number of the next frame
};

/// Straightens all frames at once.
[[nodiscard]] std::vector<Eigen::Matrix3Xd> straightened(std::vector<Eigen::Matrix3Xd> frames,
                                                         double tolerance);

}  // namespace kds
