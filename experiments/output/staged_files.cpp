#include "experiments/output/staged_files.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

#include "experiments/output/replace_file.h"

namespace kds {

namespace fs = std::filesystem;

StagedFiles::StagedFiles(fs::path directory, std::string_view command, std::string_view option)
    : subject_(fmt::format("{} {}: cannot write", option, directory.string())),
      directory_(std::move(directory)),
      made_(directory_, option),
      folder_(directory_, Part::Kind::folder, subject_),
      earlier_(directory_, command, option) {
  names_.emplace(folder_.add_file(), subject_);
}

fs::path StagedFiles::place_for(const std::string& name) {
  if (name.empty() || name.find_first_of("/\n") != std::string::npos)
    throw std::logic_error("'" + name + "' is no name for a file of a result");
  earlier_.require_own(name);
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

// Calls `visit(where a file waits, its final place)` for all files.
template <class Visit>
void StagedFiles::for_each(const Visit& visit) const {
  std::ifstream names(folder_.file(0), std::ios::binary);
  std::uint64_t number = 1;
  for (std::string name; std::getline(names, name); ++number) visit(folder_.file(number), directory_ / name);
}

void StagedFiles::refuse_others(const std::function<bool(std::string_view name)>& belongs) const {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_, ignored)) {
    const std::string name = entry.path().filename().string();
    if (belongs(name)) earlier_.require_own(name);
  }
}

void StagedFiles::finish() {
  for (WrittenFile& file : open_) file.close();
  names_->close();
  for_each([&](const fs::path&, const fs::path& place) {
    check_replaceable(place);
    earlier_.require_own(place.filename().string());
  });
  check_replaceable(earlier_.path());
  both_ = folder_.add_file();
  manifest_ = folder_.add_file();
  WrittenFile both(both_, subject_), manifest(manifest_, subject_);
  both.stream() << earlier_.heading() << '\n' << earlier_.lines();
  manifest.stream() << earlier_.heading() << '\n';
  for_each([&](const fs::path& waiting, const fs::path& place) {
    const std::string line = ResultManifest::line(waiting, place.filename().string());
    both.stream() << line;
    manifest.stream() << line;
  });
  both.close();
  manifest.close();
}

// The program may be killed at any moment, so a manifest must list every present file of a result at each
// moment.
void StagedFiles::take_place() {
  const std::string subject = earlier_.path().string() + ": cannot write";
  replace_file(both_, earlier_.path(), subject);
  std::set<std::string> now;
  for_each([&](const fs::path& waiting, const fs::path& place) {
    replace_file(waiting, place, place.string() + ": cannot write");
    if (!earlier_.empty()) now.insert(place.filename().string());
  });
  std::error_code ignored;
  for (const auto& [name, content] : earlier_.files())
    if (!now.contains(name) && earlier_.is_own(name)) fs::remove(directory_ / name, ignored);
  replace_file(manifest_, earlier_.path(), subject);
}

}  // namespace kds
