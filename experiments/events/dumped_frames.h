#pragma once
// The files of --dump: those of all frames of a run, or none, and no others of an earlier dump.

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <vector>

#include "experiments/output/staged_files.h"
#include "structures/session/structure_spec.h"

namespace kds {

class DumpedFrames {
 public:
  /// Throws InputError or OutputError naming option and path, also where the directory has frames that no
  /// earlier dump has written.
  explicit DumpedFrames(std::filesystem::path directory);
  DumpedFrames(const DumpedFrames&) = delete;
  DumpedFrames& operator=(const DumpedFrames&) = delete;

  /// The file of contacts, that of the whole run.
  [[nodiscard]] std::ostream& open_contacts();
  /// In the order of the frames, from 0.
  void write(std::size_t frame, const std::vector<DumpFile>& files);
  /// When these files take their places, those of an earlier dump that none of them replaces go.
  [[nodiscard]] Staged& staged() { return files_; }

 private:
  StagedFiles files_;
};

}  // namespace kds
