#pragma once
// A reader of someone else: a file of numbers, a line a bead and a blank line between frames.

#include <fstream>
#include <sstream>
#include <string>

#include "motions/base/input_error.h"
#include "motions/readers/read_trajectory.h"
#include "motions/readers/reader_registry.h"

namespace extension {

inline kds::FramesRead read_table(const std::filesystem::path& path, const kds::ReadOptions&) {
  std::ifstream file(path);
  if (!file) throw kds::InputError(path.string() + ": cannot be read");
  kds::FramesRead read;
  read.trajectory.file = path.string();
  std::vector<Eigen::Vector3d> beads;
  const auto end_frame = [&] {
    if (beads.empty()) return;
    Eigen::Matrix3Xd frame(3, static_cast<Eigen::Index>(beads.size()));
    for (std::size_t b = 0; b < beads.size(); ++b) frame.col(static_cast<Eigen::Index>(b)) = beads[b];
    read.trajectory.frame_numbers.push_back(read.trajectory.frames.size());
    read.trajectory.frames.push_back(frame);
    beads.clear();
  };
  for (std::string line; std::getline(file, line);) {
    Eigen::Vector3d bead;
    std::istringstream numbers(line);
    if (numbers >> bead.x() >> bead.y() >> bead.z()) {
      beads.push_back(bead);
    } else {
      end_frame();
    }
  }
  end_frame();
  read.cells.resize(read.trajectory.frames.size());
  return read;
}

inline kds::ReaderSpec table_reader() { return {"table", {".table"}, false, read_table}; }

}  // namespace extension
