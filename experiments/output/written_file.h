#pragma once
// A file that is written as a stream and tells, soon and with the system's reason, where that fails.

#include <filesystem>
#include <ostream>
#include <string>

#include "experiments/output/descriptor_buffer.h"

namespace kds {

class WrittenFile {
 public:
  /// A new file, or an old one emptied. Throws as fail_to_write does; `subject` begins the message.
  WrittenFile(const std::filesystem::path& path, std::string subject);
  ~WrittenFile();
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// Throws likewise where something could not be written.
  void check() const;
  /// All is written. Throws likewise.
  void close();

 private:
  std::string subject_;
  int descriptor_;
  DescriptorBuffer buffer_;
  std::ostream stream_;
};

}  // namespace kds
