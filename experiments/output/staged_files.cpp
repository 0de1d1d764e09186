#include "experiments/output/staged_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <utility>

#include "experiments/output/descriptor_buffer.h"
#include "experiments/output/output_error.h"

namespace kds {

namespace fs = std::filesystem;

StagedFiles::StagedFiles(fs::path directory, std::string_view option)
    : subject_(fmt::format("{} {}: cannot write", option, directory.string())),
      directory_(std::move(directory)),
      made_(directory_, option),
      folder_(directory_, Part::Kind::folder, subject_) {}

void StagedFiles::write(const std::string& name, std::string_view text) {
  files_.emplace_back(name, folder_.path());
  const int file = ::open((folder_.path() / name).c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) fail_to_write(subject_, errno);
  DescriptorBuffer buffer(file);
  buffer.sputn(text.data(), static_cast<std::streamsize>(text.size()));
  buffer.pubsync();
  const int closed = ::close(file);
  if (buffer.error() != 0 || closed != 0)
    fail_to_write(subject_, buffer.error() != 0 ? buffer.error() : errno);
}

void StagedFiles::commit() {
  for (; !files_.empty(); files_.pop_front()) {
    const std::string& name = files_.front().name;
    if (::rename((folder_.path() / name).c_str(), (directory_ / name).c_str()) != 0)
      fail_to_write(fmt::format("{}: cannot write", (directory_ / name).string()), errno);
  }
}

}  // namespace kds
