#pragma once
// The files of a scene, read frame by frame, all beads side by side. They are read once to find out what a
// scene must know of all its frames, and again by whoever runs it.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "motions/readers/necklace_stream.h"
#include "motions/scene/radii.h"
#include "motions/scene/straightened_frames.h"

namespace kds {

/// A plane x, y or z = constant.
struct AxisPlane {
  std::array<Eigen::Index, 3> axes{0, 1, 2};  ///< the two in the plane, and the one across it
  double height = 0;                          ///< along the last of them
};

/// Finds the plane that all beads of all frames keep to.
class PlaneSearch {
 public:
  void add(const Eigen::Matrix3Xd& frame);
  /// None where there is none, and for fewer than four beads, which always keep to some plane.
  [[nodiscard]] std::optional<AxisPlane> plane() const;

 private:
  std::vector<AxisPlane> left_;  ///< those that held so far
  bool begun_ = false;
};

/// What reading all frames of a scene tells.
struct SceneSurvey {
  std::vector<Trajectory> necklaces;  ///< with their first frames only
  std::size_t frame_count = 0;
  std::vector<std::size_t> frames_of_necklaces;  ///< `frame_count`, or 1 for a necklace at rest
  FrameStamp first, last;
  std::optional<AxisPlane> plane;
  LongestBond bonds;  ///< empty unless asked for
};

class SceneStream final : public FrameReader {
 public:
  /// Frames go side by side: all files have as many, or one (at rest), or survey() throws.
  explicit SceneStream(std::vector<NecklaceStream> files) : files_(std::move(files)) {}

  /// Reads all frames and begins again. Throws InputError for whatever is wrong with one of them, and where
  /// frame counts differ. Each necklace's warnings go to `warn`.
  [[nodiscard]] SceneSurvey survey(bool with_bonds, const std::function<void(const std::string&)>& warn);

  /// From now on, and after a rewind, beads go straight on within a tolerance (straightened_frames.h).
  void straighten(double tolerance) { straight_.emplace(tolerance); }

  [[nodiscard]] bool next(FrameRead& frame) override;
  void rewind() override;

 private:
  /// The next frame as the files have it.
  [[nodiscard]] bool read(FrameRead& frame);
  /// Warns of necklaces that have images much nearer to those before them in the same periodic cell, in the
  /// first frame.
  void tell_of_nearer_images(const std::function<void(const std::string&)>& warn) const;

  std::vector<NecklaceStream> files_;
  std::vector<FrameRead> present_;   ///< of each file
  std::vector<std::size_t> frames_;  ///< read so far of each file
  std::optional<StraightenedFrames> straight_;
};

}  // namespace kds
