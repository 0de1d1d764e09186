#pragma once
// The files of --dump. Either the files of all frames of a run appear, or none. Files of an earlier dump are
// removed.

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <vector>

#include "experiments/output/output_files.h"
#include "structures/session/structure_spec.h"

namespace kds {

class DumpedFrames {
 public:
  /// Throws an InputError or OutputError that names the option and the path. Throws also if the directory has
  /// frames that no earlier dump wrote.
  explicit DumpedFrames(std::filesystem::path directory);
  DumpedFrames(const DumpedFrames&) = delete;
  DumpedFrames& operator=(const DumpedFrames&) = delete;

  /// Opens the file of contacts, which covers the whole run.
  [[nodiscard]] std::ostream& open_contacts();
  /// Writes the files of a frame. Call it in the order of the frames, from 0.
  void write(std::size_t frame, const std::vector<DumpFile>& files);
  /// Taking their places, the files replace an earlier dump: its remaining files are removed.
  [[nodiscard]] AtomicFiles& files() { return files_; }

 private:
  AtomicFiles files_;
};

}  // namespace kds
