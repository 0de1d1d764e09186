#pragma once
// Hashes of input files, and the numbers of frames of trajectories that are cut into segments. Both are
// remembered in the file inputs.json of the sweep's folder, because reading long trajectories takes time. A
// hash is taken from there if inode, size, modification time and status change time of the file are as they
// were. Programs cannot set the status change time, so other content of equal size and modification time is
// noticed. A file that is gone keeps the hash that the folder remembers.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/program/command_line.h"

namespace kds {

/// Thrown if a signal asks the program to end.
struct SweepStopped {};

/// The frames that a task would read, if it is not cut.
struct FramesFound {
  std::uint64_t frames = 0;
  /// The radius of all beads if the frames determine it (--radius auto): a segment would find another. Else
  /// empty.
  std::string radius;
};

class InputHashes {
 public:
  /// `stopped` is asked while files are read; if it returns true, SweepStopped is thrown.
  explicit InputHashes(std::function<bool()> stopped) : stopped_(std::move(stopped)) {}

  /// Reads what an earlier sweep remembered in this folder, if it did.
  void load(const std::filesystem::path& folder);
  /// Writes the file, if anything is new.
  void save(const std::filesystem::path& folder);

  /// Returns the hash of a file's content. If the file cannot be read, returns the hash that is remembered,
  /// or 0 if there is none: the task will say why.
  [[nodiscard]] std::uint64_t hash(const std::string& file);
  [[nodiscard]] std::uint64_t bytes(const std::string& file) const;
  /// Returns the files that cannot be read and have a remembered hash, in the order of their paths.
  [[nodiscard]] std::vector<std::string> gone() const;
  /// Returns whether an earlier sweep in this folder read the file.
  [[nodiscard]] bool remembers(const std::string& file) const { return earlier_.contains(file); }
  [[nodiscard]] bool is_gone(const std::string& file) const { return gone_.contains(file); }
  /// Returns whether a file has another content than when its hash was asked for, or has come or gone since.
  /// Reads a file whose inode, size or times differ.
  [[nodiscard]] bool has_changed(const std::string& file);
  /// Returns the frames that `kds run` with these arguments (inputs and options of reading) finds, or nothing
  /// if they cannot be read or if the chains of several necklaces have places that the first frame decides.
  /// `key` is a hash of everything that the answer depends on.
  [[nodiscard]] std::optional<FramesFound> frames(std::uint64_t key, const Arguments& arguments);

 private:
  struct Stamp {
    std::uint64_t inode = 0;
    std::int64_t modified = 0, changed = 0;  ///< nanoseconds
    bool operator==(const Stamp&) const = default;
  };
  struct File {
    std::uint64_t bytes = 0, hash = 0;
    Stamp stamp;
    bool exists = false;
    bool trusted = false;  ///< old enough that a later change has another time
  };
  /// Returns whether a file exists, with its size and stamp.
  [[nodiscard]] static File seen(const std::string& file);
  [[nodiscard]] static bool are_alike(const File& a, const File& b);

  std::function<bool()> stopped_;
  std::map<std::string, File, std::less<>> files_, earlier_;
  std::set<std::string> gone_;
  std::map<std::uint64_t, std::optional<FramesFound>> frames_;
  bool changed_ = false;
};

}  // namespace kds
