#pragma once
// Sources of frames: each gives the frames of all beads of a run, one after the other. A frame holds all
// necklaces, one after the other. The discrete-step adapter (motions/scene/discrete_step_adapter.h) turns the
// frames into motion steps.
//
// | source | frames come from |
// |---|---|
// | FileFrames (motions/scene/file_frames.h) | files, which are read frame by frame |
// | MemoryFrames | trajectories, or an array of the caller |
// | FrameQueue | the caller, who pushes them one by one |
// | LiveFrames (motions/scene/live_frames.h) | a simulation that runs |
// | StraightenedFrames (motions/scene/straightened_frames.h) | another source |

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motions/base/bead.h"
#include "motions/frames/frame_reader.h"
#include "motions/frames/live_state.h"
#include "motions/frames/periodic.h"
#include "motions/frames/trajectory.h"

namespace kds {

/// The beads of one necklace, without their frames.
struct NecklaceBeads {
  std::string file = {};  ///< where the necklace comes from, for messages
  std::size_t count = 0;
  std::vector<std::string> names = {};     ///< empty if the beads have no names
  std::vector<double> element_radii = {};  ///< van der Waals radii; empty if elements are unknown
  std::string element_lack = {};           ///< a message that says why elements are unknown, if any are
  /// b: beads b and b+1 are joined across a chain break or are not bonded at all; in ascending order.
  std::vector<std::size_t> breaks = {};
  bool chain_like = true;  ///< consecutive beads are meant to be bonded
  BeadGroups groups = {};  ///< empty unless asked for
  bool at_rest = false;    ///< an obstacle, or a necklace of one frame beside others that move
};
[[nodiscard]] NecklaceBeads beads_of(const Trajectory& necklace);

[[nodiscard]] std::size_t count_beads(std::span<const NecklaceBeads> necklaces);
/// Returns the beads of each necklace, which are numbered necklace after necklace.
[[nodiscard]] std::vector<BeadRange> bead_ranges(std::span<const NecklaceBeads> necklaces);
/// Returns the first bead of each bond, ascending: a bond joins two consecutive beads of a chain without a
/// break.
[[nodiscard]] std::vector<BeadId> bonds_of(std::span<const NecklaceBeads> necklaces);
/// Returns a name for each bead, or nothing if no bead has a name.
[[nodiscard]] std::vector<std::string> names_of_beads(std::span<const NecklaceBeads> necklaces);
/// Returns the groups of each bead, or nothing if a necklace has none.
[[nodiscard]] BeadGroups bead_groups(std::span<const NecklaceBeads> necklaces);

/// Returns whether each necklace is at rest, or nothing if none is.
[[nodiscard]] std::vector<bool> necklaces_at_rest(std::span<const NecklaceBeads> necklaces);

class FrameSource {
 public:
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;
  virtual ~FrameSource() = default;

  [[nodiscard]] virtual const std::vector<NecklaceBeads>& necklaces() const = 0;
  /// Reads the next frame. Returns false if no frame is there. Throws InputError if the frame has an error.
  [[nodiscard]] virtual bool next(FrameRead& frame) = 0;
  /// Makes frame k the next one, counted from 0. Throws InputError if the source has passed this frame and
  /// keeps no frames.
  virtual void seek(std::size_t k) = 0;
  /// Returns whether more frames may come, and their number is not known. `next` then waits for a frame, or
  /// returns false if the caller has to push one.
  [[nodiscard]] virtual bool is_open() const { return false; }
  /// Returns whether frames are missing at the end, because a file ends inside a frame or --until-damage has
  /// left out damaged ones. Known once all frames have been read.
  [[nodiscard]] virtual bool is_truncated() const { return false; }
  /// Returns lines about the frames. The lines are complete once all frames have been read.
  [[nodiscard]] virtual std::vector<std::string> warnings() const { return {}; }
  /// Ends the reading of a running simulation before its end. Other sources do nothing.
  virtual void close() {}
  /// Returns how long the run and the simulation waited for each other, or nothing unless the frames come
  /// from a running simulation.
  [[nodiscard]] virtual std::optional<LiveState> live() const { return std::nullopt; }
};

/// Frames in memory. Seeking takes constant time.
class MemoryFrames final : public FrameSource {
 public:
  /// Copies the frames of the necklaces. A necklace with a single frame is at rest. Throws InputError naming
  /// file, frame and bead if frame counts or bead counts differ, or if a number is not finite.
  explicit MemoryFrames(std::span<const Trajectory> necklaces);
  /// Reads an array of the caller, which must outlive the source: x, y and z of each bead, frame after frame.
  /// Throws InputError if the array does not have three numbers per bead and stamp, or if a number is not
  /// finite.
  MemoryFrames(std::vector<NecklaceBeads> necklaces, std::span<const double> coordinates,
               std::vector<FrameStamp> stamps);

  [[nodiscard]] std::size_t frame_count() const { return stamps_.size(); }
  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return necklaces_; }
  [[nodiscard]] bool next(FrameRead& frame) override;
  void seek(std::size_t k) override { next_ = k; }
  [[nodiscard]] bool is_truncated() const override { return truncated_; }

 private:
  void check_finite() const;

  std::vector<NecklaceBeads> necklaces_;
  Eigen::Index beads_ = 0;
  std::vector<double> own_;              // empty if the caller owns the array
  std::span<const double> coordinates_;  // `own_` or the caller's array
  std::vector<FrameStamp> stamps_;
  std::vector<Cell> cells_;  // one per frame, or none
  std::size_t next_ = 0;
  bool truncated_ = false;
};

/// Frames that the caller pushes. Each frame is handed out once and not kept. In a periodic cell, necklaces
/// that are no fluid are made whole in the first frame. From then on, each bead is moved to the image nearest
/// to its place in the frame before (UnwrappedBeads).
class FrameQueue final : public FrameSource {
 public:
  /// Frames have `dimension` coordinates per bead, 1 to 3. The others are zero. `cell` is the cell of the
  /// first frame, if beads are in one.
  FrameQueue(std::vector<NecklaceBeads> necklaces, int dimension, std::optional<Cell> cell = std::nullopt);

  /// Appends a frame: the coordinates of bead 0, then those of bead 1 and so on. Its cell is that of the
  /// frame before, unless another is given. Throws InputError, and ignores the frame, if the number of
  /// coordinates is wrong, if one is not finite or more than 100,000 cells away, or if the cell is periodic
  /// along other vectors than before or changes by more than half of its shortest vector.
  /// Throws std::logic_error after end().
  void push(std::span<const double> coordinates, std::optional<double> picoseconds = std::nullopt,
            const std::optional<Cell>& cell = std::nullopt);
  /// Declares that no further frame follows.
  void end() { open_ = false; }

  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return necklaces_; }
  [[nodiscard]] bool next(FrameRead& frame) override;
  void seek(std::size_t k) override;
  [[nodiscard]] bool is_open() const override { return open_; }

 private:
  /// Returns for each bead whether it is bonded to the bead before it, judged by distances in the cell.
  [[nodiscard]] std::vector<bool> bonded_in_cell(const Eigen::Matrix3Xd& positions) const;

  std::vector<NecklaceBeads> necklaces_;
  std::size_t beads_, columns_;
  std::optional<Cell> cell_;  // of the last frame
  UnwrappedBeads paths_;
  std::deque<FrameRead> waiting_;  // pushed and not handed out
  std::size_t pushed_ = 0;         // number of frames
  Eigen::Matrix3Xd spare_;         // memory for the next frame
  bool open_ = true;
};

}  // namespace kds
