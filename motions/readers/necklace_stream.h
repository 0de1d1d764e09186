#pragma once
// The necklaces of one file, frame by frame: of finite coordinates, made whole across a periodic cell, and
// searched for chain breaks. Two frames are in memory, whatever the file holds.

#include <cstddef>
#include <filesystem>
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

  /// What is known of each necklace from the start: its name, radii by element and breaks, and its first
  /// frame.
  [[nodiscard]] const std::vector<Trajectory>& heads() const { return heads_; }
  /// The next frame, all necklaces side by side; false behind the last. Throws InputError likewise.
  [[nodiscard]] bool next(FrameRead& frame);
  void rewind();
  /// About a necklace; complete once all frames have been read.
  [[nodiscard]] std::vector<std::string> warnings(std::size_t necklace) const;

 private:
  FramesOpened opened_;
  std::vector<Trajectory> heads_;
  std::vector<WholeChain> whole_;          ///< of each necklace
  std::vector<std::size_t> frames_moved_;  ///< likewise
};

}  // namespace kds
