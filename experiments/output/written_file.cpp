#include "experiments/output/written_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <locale>
#include <utility>

#include "experiments/output/output_error.h"

namespace kds {

namespace {

int open_for_writing(const std::filesystem::path& path, const std::string& subject) {
  const int descriptor = ::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) fail_to_write(subject, errno);
  return descriptor;
}

}  // namespace

WrittenFile::WrittenFile(const std::filesystem::path& path, std::string subject)
    : subject_(std::move(subject)),
      descriptor_(open_for_writing(path, subject_)),
      buffer_(descriptor_),
      stream_(&buffer_) {
  stream_.imbue(std::locale::classic());
}

WrittenFile::~WrittenFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void WrittenFile::check() const {
  if (buffer_.error() != 0) fail_to_write(subject_, buffer_.error());
}

void WrittenFile::close() {
  buffer_.pubsync();
  check();
  if (::close(std::exchange(descriptor_, -1)) != 0) fail_to_write(subject_, errno);
}

}  // namespace kds
