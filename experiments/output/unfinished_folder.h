#pragma once
// A temporary folder. The folder is removed when the program ends, also if a catchable signal ends it.

#include <cstdint>
#include <string>

namespace kds {

/// Makes a folder. When this object is destroyed, or when a catchable signal ends the program, the numbered
/// files in the folder are removed, and the folder too unless it contains anything else.
class UnfinishedFolder {
 public:
  /// Throws std::system_error.
  UnfinishedFolder(std::string path, unsigned permissions);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string file(std::uint64_t number) const { return path_ + '/' + std::to_string(number); }
  /// Returns the path for the next file: file(0), file(1), ...
  [[nodiscard]] std::string add_file();

  struct Entry;  ///< element of the list that the signal handler walks

 private:
  void release();

  std::string path_;
  std::uint64_t files_ = 0;
  Entry* entry_;
};

}  // namespace kds
