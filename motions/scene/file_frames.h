#pragma once
// The frames of several files, which are read frame by frame. A frame holds the necklaces of all files, one
// after the other. One frame of each file is in memory.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "motions/frames/frame_source.h"
#include "motions/readers/necklace_stream.h"

namespace kds {

class FileFrames final : public FrameSource {
 public:
  /// The last file is an obstacle if the caller says so. Otherwise files of one frame are at rest beside
  /// files of more frames. One of the files may be live (NecklaceStream::is_live); throws InputError if
  /// another one moves beside it.
  explicit FileFrames(std::vector<NecklaceStream> files, bool last_is_obstacle = false);

  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return necklaces_; }
  /// Reads the next frame of each file that has one. After the last frame, returns false, or throws
  /// InputError unless all files have the same number of frames, or one (at rest). The last frame of a
  /// truncated or damaged file is the last one of all files.
  [[nodiscard]] bool next(FrameRead& frame) override;
  /// Reads the files again from the start to go back.
  void seek(std::size_t k) override;
  [[nodiscard]] bool is_open() const override { return live_.has_value(); }
  void close() override {
    if (live_) files_[*live_].close();
  }
  [[nodiscard]] std::optional<LiveState> live() const override {
    return live_ ? files_[*live_].live() : std::nullopt;
  }
  /// Includes a line about frames that are left out because another file is truncated, a line about times
  /// that differ between files, and lines about necklaces whose periodic image in the first frame is much
  /// nearer to necklaces of earlier files.
  [[nodiscard]] std::vector<std::string> warnings() const override;

  [[nodiscard]] bool is_truncated() const override;
  /// Returns the line about frames that are left out because another file is truncated. Empty if there are
  /// none; complete once all frames have been read.
  [[nodiscard]] const std::string& early_end() const { return early_end_; }

  /// Returns one trajectory per necklace: its names, radii and warnings, and only its first frame. Complete
  /// once all frames have been read.
  [[nodiscard]] std::vector<Trajectory> heads() const;
  /// Returns the number of frames of each necklace. Known once all frames have been read.
  [[nodiscard]] std::vector<std::size_t> frame_counts() const;

 private:
  void check_frame_counts() const;
  void add_nearer_images(std::vector<std::string>& lines) const;
  /// Returns the number and the time of the present frame: those of the first file that moves. If this file
  /// has no time, another moving file gives the time. Notes times that differ.
  [[nodiscard]] FrameStamp stamp();
  /// Returns the cell that all files that move have in the present frame. If only some files have a cell, or
  /// cells differ, returns nothing and notes it.
  [[nodiscard]] std::optional<Cell> common_cell();

  std::vector<NecklaceStream> files_;
  std::optional<std::size_t> live_ = {};  ///< index of the file that is live, if one is
  std::vector<NecklaceBeads> necklaces_;
  std::vector<bool> at_rest_;                     ///< whether a file has only one frame, one per file
  std::vector<FrameRead> present_;                ///< the present frame of each file
  std::vector<std::optional<Cell>> first_cells_;  ///< the cell of each file in the first frame
  std::vector<std::size_t> read_;                 ///< number of frames read from each file
  std::vector<std::size_t> all_;                  ///< number of frames of each file, once all have been read
  std::size_t next_ = 0;                          ///< number of the next frame
  std::size_t last_number_ = 0;                   ///< number in the file of the last frame read
  std::string early_end_;                         ///< about frames left out after a truncated file's last one
  std::size_t times_differ_ = 0;                  ///< frames with different times in two files
  std::string first_difference_;                  ///< about the first of these
  std::string cells_differ_;                      ///< about the first frame whose cells differ
};

}  // namespace kds
