#include "experiments/output/result_manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>

#include "kds/event_log.h"
#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = ".kds-", kSuffix = ".files";

}  // namespace

ResultManifest::ResultManifest(fs::path directory, std::string_view command, std::string_view option)
    : directory_(std::move(directory)),
      key_(fmt::format("{}-{}", command, option.substr(option.find_first_not_of('-')))),
      option_(option),
      writer_(fmt::format("kds {} {}", command, option)) {
  std::error_code error;
  if (!fs::exists(path(), error)) return;
  std::ifstream file(path(), std::ios::binary);
  std::string text;
  if (!std::getline(file, text) || text != heading())
    throw InputError(fmt::format("{} {}: {} is no manifest of {}; move it or give another directory", option_,
                                 directory_.string(), path().filename().string(), writer_));
  while (std::getline(file, text)) {
    const char* const end = text.data() + text.size();
    Content content;
    const auto [after, bad] = std::from_chars(text.data(), end, content.checksum, 16);
    if (bad != std::errc() || after == end || *after != ' ') continue;
    const auto [rest, wrong] = std::from_chars(after + 1, end, content.size);
    if (wrong != std::errc() || rest == end || *rest != ' ') continue;
    const std::string name(rest + 1, end);
    if (!name.empty() && name.find('/') == std::string::npos) files_.emplace(name, content);
  }
}

std::string ResultManifest::heading() const {
  return fmt::format("files that {} wrote, with checksum and size", writer_);
}

ResultManifest::Content ResultManifest::content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 1 << 16> bytes;
  WordHash checksum;
  Content content;
  while (file.read(bytes.data(), bytes.size()), file.gcount() > 0) {
    for (std::streamsize k = 0; k < file.gcount(); ++k)
      checksum.add(static_cast<unsigned char>(bytes[static_cast<std::size_t>(k)]));
    content.size += static_cast<std::uint64_t>(file.gcount());
  }
  content.checksum = checksum.value();
  return content;
}

std::string ResultManifest::line(const Content& content, std::string_view name) {
  return fmt::format("{:016x} {} {}\n", content.checksum, content.size, name);
}

std::string ResultManifest::line(const fs::path& path, std::string_view name) {
  return line(content_of(path), name);
}

std::string ResultManifest::lines() const {
  std::string text;
  for (const auto& [name, content] : files_) text += line(content, name);
  return text;
}

bool ResultManifest::is_own(const std::string& name) const {
  const auto [first, last] = files_.equal_range(name);
  std::error_code error;
  if (first == last || !fs::is_regular_file(directory_ / name, error)) return false;
  const Content content = content_of(directory_ / name);
  return std::any_of(first, last, [&](const auto& listed) { return listed.second == content; });
}

std::string ResultManifest::author_of(const std::string& name) const {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_, error)) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with(kPrefix) || !file.ends_with(kSuffix) || entry.path() == path()) continue;
    const std::string key = file.substr(kPrefix.size(), file.size() - kPrefix.size() - kSuffix.size());
    const std::size_t dash = key.rfind('-');
    if (dash == std::string::npos || dash == 0 || dash + 1 == key.size()) continue;
    try {
      const ResultManifest other(directory_, key.substr(0, dash), "--" + key.substr(dash + 1));
      if (other.is_own(name)) return other.writer_;
    } catch (const InputError&) {  // not a manifest
    }
  }
  return "";
}

void ResultManifest::require_own(const std::string& name) const {
  std::error_code error;
  if (!fs::is_regular_file(directory_ / name, error) || is_own(name)) return;
  const std::string author = author_of(name);
  const std::string what = !author.empty()         ? "was written by " + author
                           : files_.contains(name) ? "has changed since " + writer_ + " wrote it"
                                                   : "was not written by " + writer_;
  throw InputError(fmt::format("{} {}: {} there {}; move it or give another directory", option_,
                               directory_.string(), name, what));
}

}  // namespace kds
