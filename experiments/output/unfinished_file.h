#pragma once
// A file or folder in the making, which must not stay behind if the user stops the program.

#include <atomic>
#include <string>

namespace kds {

/// While it lives, SIGINT, SIGTERM and SIGHUP remove the file of that name before they end the program; a
/// folder too, if it is empty then.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(std::string path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  struct Entry;  ///< of the list that the signal handler walks

 private:
  std::string path_;
  Entry* entry_;
};

}  // namespace kds
