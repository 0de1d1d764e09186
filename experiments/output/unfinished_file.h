#pragma once
// Removes an unfinished file or folder if the user stops the program.

#include <atomic>
#include <cstdint>
#include <string>

namespace kds {

/// During the lifetime of this object, every catchable signal that would end the program first removes the
/// file, or the folder if it is empty by then. Construct it before the file is made.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(std::string path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// For a folder: the files 0, 1, ..., count - 1 in it are removed too.
  void hold_files(std::uint64_t count);

  struct Entry;  ///< element of the list that the signal handler walks

 private:
  std::string path_;
  Entry* entry_;
};

}  // namespace kds
