#pragma once
// The directory of a result, made with its parents. Those made go again with the object if nothing was put
// into them, so that a run that fails leaves no trace.

#include <deque>
#include <filesystem>
#include <string_view>

#include "experiments/output/unfinished_file.h"

namespace kds {

class MadeDirectories {
 public:
  /// Also clears what killed programs left there. Throws InputError or OutputError naming option and path.
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
