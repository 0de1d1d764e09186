#include "experiments/events/dumped_frames.h"

#include <fmt/format.h>

#include <charconv>
#include <utility>

#include "experiments/events/contacts_csv.h"

namespace kds {

DumpedFrames::DumpedFrames(std::filesystem::path directory) : files_(std::move(directory), "--dump") {
  files_.replace([this](std::string_view name) { return is_stale(name); });
}

std::ostream& DumpedFrames::open_contacts() {
  has_contacts_ = true;
  return files_.open(std::string(contacts_file));
}

void DumpedFrames::write(std::size_t frame, const std::vector<DumpFile>& files) {
  for (const DumpFile& file : files) {
    files_.write(fmt::format("frame-{}.{}", frame, file.ending), file.text);
    endings_.insert(file.ending);
  }
  frames_ = frame + 1;
  files_.check();
}

// frame-NUMBER.WORD.csv or contacts.csv, and not one that has just been written.
bool DumpedFrames::is_stale(std::string_view name) const {
  if (name == contacts_file) return !has_contacts_;
  constexpr std::string_view start = "frame-", end = ".csv";
  if (!name.starts_with(start) || !name.ends_with(end)) return false;
  name.remove_prefix(start.size());
  std::size_t frame = 0;
  const auto [after, error] = std::from_chars(name.data(), name.data() + name.size(), frame);
  const auto digits = static_cast<std::size_t>(after - name.data());
  if (error != std::errc() || name.substr(0, digits) != std::to_string(frame)) return false;
  if (digits == name.size() || name[digits] != '.') return false;
  const std::string_view ending = name.substr(digits + 1);
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz_";
  if (ending.find_first_not_of(letters) != ending.size() - end.size()) return false;
  return frame >= frames_ || !endings_.contains(ending);
}

}  // namespace kds
