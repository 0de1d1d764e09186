#pragma once
// A file being written, which must not stay behind if the user stops the program.

#include <cstddef>
#include <string>

namespace kds {

/// While it lives, SIGINT, SIGTERM and SIGHUP remove the file of that name before they end the program.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(std::string path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

 private:
  std::string path_;
  std::size_t slot_;
};

}  // namespace kds
