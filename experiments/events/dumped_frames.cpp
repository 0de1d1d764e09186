#include "experiments/events/dumped_frames.h"

#include <fmt/format.h>

#include <charconv>
#include <utility>

#include "experiments/events/contacts_csv.h"

namespace kds {

namespace {

// Returns whether the name has the form frame-NUMBER.WORD.csv.
bool is_frame(std::string_view name) {
  constexpr std::string_view start = "frame-", end = ".csv";
  if (!name.starts_with(start) || !name.ends_with(end)) return false;
  name.remove_prefix(start.size());
  std::size_t frame = 0;
  const auto [after, error] = std::from_chars(name.data(), name.data() + name.size(), frame);
  const auto digits = static_cast<std::size_t>(after - name.data());
  if (error != std::errc() || name.substr(0, digits) != std::to_string(frame)) return false;
  if (digits == name.size() || name[digits] != '.') return false;
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz_";
  name.remove_prefix(digits + 1);
  return name.find_first_not_of(letters) == name.size() - end.size();
}

}  // namespace

DumpedFrames::DumpedFrames(std::filesystem::path directory) : files_(std::move(directory), "run", "--dump") {
  files_.refuse_others(is_frame);  // frames of two dumps would look like one dump
}

std::ostream& DumpedFrames::open_contacts() { return files_.open(std::string(contacts_file)); }

void DumpedFrames::write(std::size_t frame, const std::vector<DumpFile>& files) {
  for (const DumpFile& file : files) files_.write(fmt::format("frame-{}.{}", frame, file.ending), file.text);
  files_.check();
}

}  // namespace kds
