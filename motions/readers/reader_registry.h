#pragma once
// The readers of file formats. A reader is found by the first bytes of a file, otherwise by the file's
// ending.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motions/frames/frame_reader.h"

namespace kds {

struct ReadOptions;
struct Topology;

/// One file format. A format has frames (`open`), names atoms (`topology`), or both.
struct ReaderSpec {
  std::string name;  ///< as --format takes it
  std::vector<std::string>
      endings;                  ///< in lower case, each with its dot; endings with .gz follow by themselves
  bool takes_topology = false;  ///< another file names the atoms
  std::function<FramesOpened(const std::filesystem::path&, const ReadOptions&)> open = {};
  /// Returns whether a file of this format begins with these bytes (at most `bytes_seen`, unpacked). Must be
  /// false in doubt. If empty, only the ending leads to this reader.
  std::function<bool(std::string_view start)> recognises = {};
  /// Reads the names of the atoms, for --topology. Empty if the format does not name atoms.
  std::function<Topology(const std::filesystem::path&, const ReadOptions&)> topology = {};
};

class ReaderRegistry {
 public:
  /// Adds a reader. Throws std::logic_error if another reader has its name or one of its endings.
  void add(ReaderSpec reader);
  /// Returns the reader called `format`; without it, the one that recognises the file's first bytes, else the
  /// one with the file's ending, else null. The address of a running simulation has the reader imd. Throws
  /// InputError if the file cannot be opened, if no reader is called `format`, or if a format of files is
  /// given for an address.
  [[nodiscard]] const ReaderSpec* find(const std::filesystem::path& path,
                                       const std::optional<std::string>& format = {}) const;
  /// Returns the reader with the file's ending, or null.
  [[nodiscard]] const ReaderSpec* find_by_ending(const std::filesystem::path& path) const;
  /// Returns the names of all formats.
  [[nodiscard]] std::vector<std::string> names() const;
  /// Returns the names of the formats that have frames.
  [[nodiscard]] std::vector<std::string> names_with_frames() const;
  /// Returns ".pdb, .ent, ... or .xyz" of the formats that have frames, for messages.
  [[nodiscard]] std::string endings() const;
  /// Like `endings`, for the formats that take a topology.
  [[nodiscard]] std::string trajectory_endings() const;
  /// Like `endings`, for the formats that name atoms.
  [[nodiscard]] std::string topology_endings() const;

  static constexpr std::size_t bytes_seen = 4096;
  /// Returns the first bytes of the file, at most `bytes_seen`, unpacked and without a byte order mark.
  /// Throws InputError if the file cannot be opened.
  [[nodiscard]] static std::string first_bytes(const std::filesystem::path& path);

 private:
  std::vector<ReaderSpec> readers_;
};

/// Returns the registry of the process. The registry holds the framework's own readers and those added before
/// the first file is read.
[[nodiscard]] ReaderRegistry& reader_registry();

}  // namespace kds
