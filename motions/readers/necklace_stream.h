#pragma once
// Reads the necklaces of one file frame by frame. Coordinates are checked to be finite, chains are made whole
// across a periodic cell, and chain breaks are found. Two frames are in memory, whatever the length of the
// file.
//
// In the first frame, chains of one file are placed beside each other: a chain moves to the periodic image
// nearest to the chains before it if that image is much nearer than the chain itself. After the first frame,
// each chain moves continuously. A warning is given if another chain has a nearer image.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"
#include "motions/frames/trajectory.h"
#include "motions/readers/read_options.h"

namespace kds {

class NecklaceStream {
 public:
  /// Opens the file and reads its first frame. Throws InputError as read_trajectories does.
  NecklaceStream(const std::filesystem::path& path, const ReadOptions& options);

  /// Returns the data of each necklace known from the start: its name, radii by element, breaks and first
  /// frame.
  [[nodiscard]] const std::vector<Trajectory>& heads() const { return heads_; }
  /// Reads the next frame of all necklaces, side by side. Returns false after the last frame. Throws
  /// InputError as the constructor does.
  [[nodiscard]] bool next(FrameRead& frame);
  void rewind();
  /// Returns whether the file has only one frame. Starts again with the first frame.
  [[nodiscard]] bool holds_one_frame();
  /// Returns the warnings about a necklace. They are complete once all frames have been read.
  [[nodiscard]] std::vector<std::string> warnings(std::size_t necklace) const;

 private:
  /// Findings about one necklace, for its warnings.
  struct Notes {
    Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< shift of the first frame, in cell vectors
    std::string placed;                               ///< a message about that shift
    std::size_t frames_moved = 0;
    std::size_t frames_doubtful = 0, first_doubtful = 0;  ///< frames whose cell does not suit the bonds
    /// The shift, in the first frame, from the centroid to its image nearest to the first necklace's
    /// centroid.
    std::optional<Eigen::Vector3d> apart_at_first;
    std::size_t frames_apart = 0, first_apart = 0;  ///< frames in which that shift differs
  };
  void place_beside_earlier(std::size_t n, const ImageBeside& beside);

  FramesOpened opened_;
  std::vector<Trajectory> heads_;
  std::vector<WholeChain> whole_;  ///< one per necklace
  std::vector<Notes> notes_;       ///< one per necklace
  std::size_t cells_unused_ = 0;   ///< number of frames whose cell is not used
  std::string first_doubt_;        ///< about the first such frame
  std::size_t frames_noted_ = 0;   ///< number of frames whose reader has a warning
  std::string first_note_;         ///< about the first such frame
};

}  // namespace kds
