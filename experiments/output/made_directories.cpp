#include "experiments/output/made_directories.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "experiments/output/output_error.h"
#include "experiments/output/part.h"

namespace kds {

namespace fs = std::filesystem;

MadeDirectories::MadeDirectories(const fs::path& path, std::string_view option) {
  fs::path current;
  std::error_code ignored;
  for (const fs::path& name : path) {
    current /= name;
    if (name.empty() || fs::is_directory(current, ignored)) continue;
    made_.emplace_back(current);
    if (::mkdir(current.c_str(), 0777) == 0) continue;
    const int error = errno;
    made_.pop_back();
    if (error == EEXIST && fs::is_directory(current, ignored)) continue;  // another program made it first
    remove_empty();
    fail_to_write(fmt::format("{} {}: cannot make the directory", option, path.string()), error);
  }
  clear_stale_parts(path);
}

MadeDirectories::~MadeDirectories() { remove_empty(); }

void MadeDirectories::remove_empty() {
  while (!made_.empty()) {
    ::rmdir(made_.back().path.c_str());
    made_.pop_back();
  }
}

}  // namespace kds
