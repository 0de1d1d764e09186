#pragma once
// The readers of trajectory formats. The file's ending selects the reader.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"

namespace kds {

struct ReadOptions;

struct ReaderSpec {
  std::string name;
  std::vector<std::string> endings;  ///< in lower case, each with its dot; ".pdb.gz" is an ending of its own
  bool takes_topology = false;       ///< another file names the atoms
  std::function<FramesOpened(const std::filesystem::path&, const ReadOptions&)> open;
};

class ReaderRegistry {
 public:
  /// Adds a reader. Throws std::logic_error if another reader has one of its endings.
  void add(ReaderSpec reader);
  /// Returns the reader for the file's ending, or null.
  [[nodiscard]] const ReaderSpec* find(const std::filesystem::path& path) const;
  /// Returns ".pdb, .ent, ... or .xyz", for messages.
  [[nodiscard]] std::string endings() const;

 private:
  std::vector<ReaderSpec> readers_;
};

/// Returns the registry of the process. It holds the framework's own readers and those added before the first
/// file is read.
[[nodiscard]] ReaderRegistry& reader_registry();

}  // namespace kds
