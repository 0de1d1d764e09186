#pragma once
// A user-defined reader for a file of numbers: one line per bead and a blank line between frames.

#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/readers/read_trajectory.h"
#include "motions/readers/reader_registry.h"

namespace extension {

class TableFrames final : public kds::FrameReader {
 public:
  explicit TableFrames(const std::filesystem::path& path) : file_(path) {
    if (!file_) throw kds::InputError(path.string() + ": cannot be read");
  }

  bool next(kds::FrameRead& frame) override {
    std::vector<Eigen::Vector3d> beads;
    for (std::string line; std::getline(file_, line);) {
      Eigen::Vector3d bead;
      std::istringstream numbers(line);
      if (numbers >> bead.x() >> bead.y() >> bead.z()) {
        beads.push_back(bead);
      } else if (!beads.empty()) {
        break;
      }
    }
    if (beads.empty()) return false;
    frame.stamp = {frame_++, std::nullopt};
    frame.positions.resize(3, static_cast<Eigen::Index>(beads.size()));
    for (std::size_t b = 0; b < beads.size(); ++b)
      frame.positions.col(static_cast<Eigen::Index>(b)) = beads[b];
    return true;
  }
  void rewind() override {
    file_.clear();
    file_.seekg(0);
    frame_ = 0;
  }

 private:
  std::ifstream file_;
  std::size_t frame_ = 0;
};

inline kds::FramesOpened open_table(const std::filesystem::path& path, const kds::ReadOptions&) {
  kds::FramesOpened opened;
  opened.file = path.string();
  opened.frames = std::make_unique<TableFrames>(path);
  return opened;
}

inline kds::ReaderSpec table_reader() { return {"table", {".table"}, false, open_table}; }

}  // namespace extension
