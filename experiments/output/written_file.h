#pragma once
// A file that is written as a stream and reports a failure early, with the system's reason.

#include <filesystem>
#include <ostream>
#include <string>

#include "experiments/output/descriptor_buffer.h"

namespace kds {

class WrittenFile {
 public:
  /// Makes a new file or empties an existing one. Throws as fail_to_write does. `subject` begins the message.
  WrittenFile(const std::filesystem::path& path, std::string subject);
  ~WrittenFile();
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Throws as fail_to_write does if a write failed.
  void check() const;
  /// Completes the file. Throws as fail_to_write does.
  void close();

 private:
  std::string subject_;
  int descriptor_;
  DescriptorBuffer buffer_;
  std::ostream stream_;
};

}  // namespace kds
