#pragma once
// The properties of all frames together. The properties are found by reading a source of frames once, before
// the run.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "motions/frames/frame_source.h"

namespace kds {

/// A plane x, y or z = constant.
struct AxisPlane {
  std::array<Eigen::Index, 3> axes{0, 1, 2};  ///< the two axes in the plane, then the one across it
  double height = 0;                          ///< coordinate along the last axis

  /// Converts a frame from the input's coordinates to those in the plane. The third coordinate becomes zero.
  void lay(Eigen::Matrix3Xd& frame) const;
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

/// Finds the longest bond of all frames, which are added one after the other.
class LongestBond {
 public:
  /// Adds a frame of one necklace. A chain break does not count as a bond; `breaks` are in ascending order.
  void add(const Eigen::Ref<const Eigen::Matrix3Xd>& frame, const std::vector<std::size_t>& breaks);
  /// Returns half the length of the longest bond, rounded up to the smallest double with which all
  /// consecutive beads meet. Throws InputError if there is no such number above 0.
  [[nodiscard]] double radius() const;

 private:
  bool any_ = false;    ///< a bond was added
  double longest_ = 0;  ///< rounded
  double radius_ = 0;
};

struct FrameSurvey {
  std::size_t frame_count = 0;
  FrameStamp first, last;
  bool truncated = false;  ///< as FrameSource::is_truncated
  Eigen::Matrix3Xd first_positions;
  std::optional<AxisPlane> plane;
  LongestBond bonds;  ///< empty unless requested
};

/// Reads all frames and starts again at the first. Passes the source's warnings to `warn`. Throws InputError
/// if a frame has an error.
[[nodiscard]] FrameSurvey survey_frames(FrameSource& frames, bool with_bonds,
                                        const std::function<void(const std::string&)>& warn = {});

}  // namespace kds
