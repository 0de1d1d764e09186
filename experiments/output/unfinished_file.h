#pragma once
// A file or folder in the making, which must not stay behind if the user stops the program.

#include <atomic>
#include <cstdint>
#include <string>

namespace kds {

/// While it lives, every signal that would end the program and can be caught removes the file of that name
/// first; a folder too, if it is empty then. It is to be there before the file is.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(std::string path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// Of a folder: the files 0, 1, ... in it, so many, go as well.
  void hold_files(std::uint64_t count);

  struct Entry;  ///< of the list that the signal handler walks

 private:
  std::string path_;
  Entry* entry_;
};

}  // namespace kds
