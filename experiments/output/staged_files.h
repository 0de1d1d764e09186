#pragma once
// Files of a directory that appear together or not at all: they wait in a hidden folder of it.

#include <deque>
#include <filesystem>
#include <string>
#include <string_view>

#include "experiments/output/made_directories.h"
#include "experiments/output/part.h"

namespace kds {

class StagedFiles {
 public:
  /// Makes the directory if it is not there. Throws InputError or OutputError naming option and path.
  StagedFiles(std::filesystem::path directory, std::string_view option);

  /// Throws likewise.
  void write(const std::string& name, std::string_view text);
  /// All files take their places. Without it nothing is left, and a directory made goes too.
  void commit();

 private:
  struct File {
    File(std::string file, const std::filesystem::path& folder)
        : name(std::move(file)), unfinished((folder / name).string()) {}
    std::string name;
    UnfinishedFile unfinished;
  };

  std::string subject_;
  std::filesystem::path directory_;
  MadeDirectories made_;
  Part folder_;
  std::deque<File> files_;
};

}  // namespace kds
