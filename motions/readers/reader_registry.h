#pragma once
// Readers of trajectories by format, told by the file's ending.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"

namespace kds {

struct ReadOptions;

struct ReaderSpec {
  std::string name;
  std::vector<std::string> endings;  ///< in lower case, with their dots; ".pdb.gz" is one too
  bool takes_topology = false;       ///< another file names its atoms
  std::function<FramesOpened(const std::filesystem::path&, const ReadOptions&)> open;
};

class ReaderRegistry {
 public:
  /// Throws std::logic_error where another reader has one of its endings.
  void add(ReaderSpec reader);
  /// Null where no reader knows the ending.
  [[nodiscard]] const ReaderSpec* find(const std::filesystem::path& path) const;
  /// ".pdb, .ent, ... or .xyz", for messages.
  [[nodiscard]] std::string endings() const;

 private:
  std::vector<ReaderSpec> readers_;
};

/// Of the process: the framework's own readers, and whatever is added before the first file is read.
[[nodiscard]] ReaderRegistry& reader_registry();

}  // namespace kds
