#include "experiments/output/staged_files.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "experiments/output/replace_file.h"

namespace kds {

namespace fs = std::filesystem;

StagedFiles::StagedFiles(fs::path directory, std::string_view option)
    : subject_(fmt::format("{} {}: cannot write", option, directory.string())),
      directory_(std::move(directory)),
      made_(directory_, option),
      folder_(directory_, Part::Kind::folder, subject_) {
  names_.emplace(folder_.add_file(), subject_);
}

fs::path StagedFiles::place_for(const std::string& name) {
  if (name.empty() || name.find_first_of("/\n") != std::string::npos)
    throw std::logic_error("'" + name + "' is no name for a file of a result");
  names_->stream() << name << '\n';
  names_->check();
  return folder_.add_file();
}

void StagedFiles::write(const std::string& name, std::string_view text) {
  WrittenFile file(place_for(name), subject_);
  file.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
}

std::ostream& StagedFiles::open(const std::string& name) {
  return open_.emplace_back(place_for(name), subject_).stream();
}

void StagedFiles::check() const {
  for (const WrittenFile& file : open_) file.check();
}

// Calls visit(where a file waits, where its place is) for all.
template <class Visit>
void StagedFiles::for_each(const Visit& visit) const {
  std::ifstream names(folder_.file(0), std::ios::binary);
  std::uint64_t number = 1;
  for (std::string name; std::getline(names, name); ++number) visit(folder_.file(number), directory_ / name);
}

void StagedFiles::finish() {
  for (WrittenFile& file : open_) file.close();
  names_->close();
  for_each([&](const fs::path&, const fs::path& place) { check_replaceable(place); });
}

void StagedFiles::take_place() {
  for_each([&](const fs::path& waiting, const fs::path& place) {
    replace_file(waiting, place, place.string() + ": cannot write");
  });
  if (!is_stale_) return;
  std::vector<fs::path> stale;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_, ignored))
    if (!entry.is_directory(ignored) && is_stale_(entry.path().filename().string()))
      stale.push_back(entry.path());
  for (const fs::path& path : stale) fs::remove(path, ignored);
}

}  // namespace kds
