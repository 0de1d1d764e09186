#pragma once
// The properties of all frames together. The properties are found by reading a source of frames once, before
// the run.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "motions/frames/frame_source.h"
#include "motions/frames/periodic.h"

namespace kds {

/// A plane x, y or z = constant.
struct AxisPlane {
  std::array<Eigen::Index, 3> axes{0, 1, 2};  ///< the two axes in the plane, then the one across it
  double height = 0;                          ///< coordinate along the last axis

  /// Converts a frame from the input's coordinates to those in the plane. The third coordinate becomes zero.
  void lay(Eigen::Matrix3Xd& frame) const;
  /// Converts a cell. Its vectors in the plane come first; a vector across the plane is left out. Returns
  /// nothing if a vector is neither in the plane nor across it, or if none is in it.
  [[nodiscard]] std::optional<Cell> laid(const Cell& cell) const;
};

/// Finds a plane that contains all beads of all frames.
class PlaneSearch {
 public:
  /// Adds a frame, or its positions alone. A bead whose velocity leaves a plane rules it out.
  void add(const FrameRead& frame, bool with_velocities);
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

/// Moves of single beads, from one frame of the file to the next, that are longer than half of the shortest
/// vector of the cell's lattice. Another image of the bead may be as near, so the path between the frames is
/// a guess. With a stride there are none, because images follow through the frames between.
struct FarMoves {
  std::size_t count = 0;
  std::size_t first_frame = 0;  ///< number in the file of the frame after the first of them
  std::size_t first_bead = 0;   ///< in the scene
  double length = 0;            ///< of the first of them
  double half_cell = 0;         ///< half of the shortest vector there
};

/// Changes of the cell, from one frame of the file to the next, by more than half of the shortest vector of
/// its lattice: other vectors of the new lattice may be as near, so the paths of images are a guess.
struct CellJumps {
  std::size_t count = 0;
  std::size_t first_frame = 0;  ///< number in the file of the frame after the first of them
  double change = 0;            ///< of the first of them, the norm of the difference
  double half_cell = 0;         ///< half of the shortest vector before it
};

/// Collects what the cells of all frames have in common, and moves and changes that are far for them.
class CellSurvey {
 public:
  void add(const FrameRead& frame);
  /// Returns whether all frames are periodic along the same vectors, and, for a planar scene, in its plane.
  [[nodiscard]] bool is_periodic(const std::optional<AxisPlane>& plane) const;
  /// Returns why not, or an empty text if no frame has a cell.
  [[nodiscard]] std::string why_not() const;
  /// Returns lines about moves and changes of cells for which paths are a guess.
  [[nodiscard]] std::vector<std::string> guesses(const std::vector<NecklaceBeads>& necklaces) const;

 private:
  std::size_t with_cell_ = 0, without_cell_ = 0;
  std::optional<std::array<bool, 3>> spans_;        // the vectors of the first cell that are not zero
  bool alike_ = true;                               // all cells have these
  std::array<bool, 3> in_plane_{true, true, true};  // for each axis: cells lie in the plane across it
  Eigen::Matrix3Xd last_;                           // positions of the frame before
  std::size_t last_number_ = 0;                     // number of that frame in the file
  std::optional<Cell> last_cell_;
  FarMoves far_;
  CellJumps jumps_;
};

/// Checks whether all frames have velocities and ascending times, and compares these velocities with central
/// differences.
class VelocitySurvey {
 public:
  void add(const FrameRead& frame);
  /// Returns whether there are two frames or more, all with velocities and with times that ascend.
  [[nodiscard]] bool all() const { return frames_ > 1 && lacks_.empty(); }
  /// Returns why not, or an empty text if no frame has velocities.
  [[nodiscard]] std::string why_not() const {
    return !any_ ? "" : frames_ < 2 ? "there is only one frame" : lacks_;
  }
  /// Returns the root mean square error of predicted frames with velocities, divided by that with central
  /// differences in time. Every other frame is left out and predicted by a Hermite curve. The differences are
  /// those of a run if frames are equally spaced. Returns 1 for fewer than seven frames.
  [[nodiscard]] double relative_error() const;

 private:
  std::deque<FrameRead> recent_;  // the last seven frames, while none is unfit
  std::optional<double> last_time_;
  std::size_t frames_ = 0;
  bool any_ = false;
  std::string lacks_;                                  // about the first frame that is unfit
  double with_velocities_ = 0, with_differences_ = 0;  // sums of squares of errors
};

struct FrameSurvey {
  std::size_t frame_count = 0;
  FrameStamp first, last;
  bool truncated = false;  ///< as FrameSource::is_truncated
  Eigen::Matrix3Xd first_positions;
  std::optional<AxisPlane> plane;
  LongestBond bonds;  ///< empty unless requested
  /// All frames have a cell that the scene can use, so beads have images.
  bool periodic = false;
  std::string lacks_images = {};  ///< why beads have no images, if any frame has a cell; for messages
  std::optional<AxisPlane> plane_of_positions = {};  ///< also if velocities leave it
  bool periodic_in_that_plane = false;
  bool velocities = false;            ///< VelocitySurvey::all
  std::string lacks_velocities = {};  ///< why not, for messages; empty if they are used or not asked for
  double error_with_velocities = 1;   ///< VelocitySurvey::relative_error

  /// Does without the velocities of the frames.
  void leave_velocities(const std::string& why) {
    velocities = false;
    lacks_velocities = why;
    plane = plane_of_positions;
    periodic = periodic_in_that_plane;
  }
};

/// Reads all frames and starts again at the first. Passes the source's warnings to `warn`. Throws InputError
/// if a frame has an error.
[[nodiscard]] FrameSurvey survey_frames(FrameSource& frames, bool with_bonds,
                                        const std::function<void(const std::string&)>& warn = {});

}  // namespace kds
