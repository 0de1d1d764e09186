#pragma once
// Makes the directory of a result together with its missing parents. The destructor removes the new
// directories that are still empty, so a failed run leaves no trace.

#include <deque>
#include <filesystem>
#include <string_view>

#include "experiments/output/unfinished_file.h"

namespace kds {

class MadeDirectories {
 public:
  /// Also removes the files that killed programs left in the directory. Throws an InputError or OutputError
  /// that names the option and the path.
  MadeDirectories(const std::filesystem::path& path, std::string_view option);
  ~MadeDirectories();
  MadeDirectories(const MadeDirectories&) = delete;
  MadeDirectories& operator=(const MadeDirectories&) = delete;

 private:
  struct Made {
    explicit Made(const std::filesystem::path& directory) : path(directory), unfinished(directory.string()) {}
    std::filesystem::path path;
    UnfinishedFile unfinished;
  };
  void remove_empty();

  std::deque<Made> made_;  ///< parents first
};

}  // namespace kds
