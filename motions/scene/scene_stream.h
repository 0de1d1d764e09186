#pragma once
// Reads the files of a scene frame by frame, all beads side by side. The files are read once to survey the
// properties of all frames, and again by the run.

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
  std::array<Eigen::Index, 3> axes{0, 1, 2};  ///< the two axes in the plane, then the one across it
  double height = 0;                          ///< coordinate along the last axis
};

/// Finds a plane that contains all beads of all frames.
class PlaneSearch {
 public:
  void add(const Eigen::Matrix3Xd& frame);
  /// Returns the plane, or nothing if there is none or if there are fewer than four beads, which always lie
  /// in some plane.
  [[nodiscard]] std::optional<AxisPlane> plane() const;

 private:
  std::vector<AxisPlane> left_;  ///< planes that contain all frames so far
  bool begun_ = false;
};

/// The properties of a scene that are found by reading all its frames.
struct SceneSurvey {
  std::vector<Trajectory> necklaces;  ///< only with their first frames
  std::size_t frame_count = 0;
  std::vector<std::size_t> frames_of_necklaces;  ///< `frame_count`, or 1 for a necklace at rest
  FrameStamp first, last;
  std::optional<AxisPlane> plane;
  LongestBond bonds;  ///< empty unless requested
};

class SceneStream final : public FrameReader {
 public:
  /// Frames are combined side by side. survey() throws unless all files have the same number of frames, or
  /// one (at rest).
  explicit SceneStream(std::vector<NecklaceStream> files) : files_(std::move(files)) {}

  /// Reads all frames and starts again at the first. Throws InputError if a file or frame has an error, or if
  /// the numbers of frames differ. Passes each necklace's warnings to `warn`.
  [[nodiscard]] SceneSurvey survey(bool with_bonds, const std::function<void(const std::string&)>& warn);

  /// Straightens the frames from now on, and after a rewind: beads go straight on within a tolerance
  /// (straightened_frames.h).
  void straighten(double tolerance) { straight_.emplace(tolerance); }

  [[nodiscard]] bool next(FrameRead& frame) override;
  void rewind() override;

 private:
  /// Reads the next frame as the files have it.
  [[nodiscard]] bool read(FrameRead& frame);
  /// Warns of necklaces that have images much nearer to those before them in the same periodic cell, in the
  /// first frame.
  void tell_of_nearer_images(const std::function<void(const std::string&)>& warn) const;

  std::vector<NecklaceStream> files_;
  std::vector<FrameRead> present_;   ///< one per file
  std::vector<std::size_t> frames_;  ///< number of frames read from each file
  std::optional<StraightenedFrames> straight_;
};

}  // namespace kds
