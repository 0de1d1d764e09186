#include "experiments/sweep/input_hashes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "experiments/output/output_files.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/run/load_scene.h"
#include "experiments/sweep/task_name.h"
#include "experiments/sweep/task_process.h"
#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kRemembered = "inputs.json";
constexpr std::int64_t kNanoseconds = 1'000'000'000;
constexpr int kCannotBeCut = 1;  // exit code of the child that looks at frames

std::string text_in(const fs::path& file) {
  std::string text;
  std::FILE* const stream = std::fopen(file.c_str(), "rb");
  if (stream == nullptr) return text;
  std::array<char, 65536> block{};
  for (std::size_t count = 0; (count = std::fread(block.data(), 1, block.size(), stream)) > 0;)
    text.append(block.data(), count);
  std::fclose(stream);
  return text;
}

// Returns nanoseconds, as the times of files count them.
std::int64_t now() {
  timespec time{};
  ::clock_gettime(CLOCK_REALTIME, &time);
  return time.tv_sec * kNanoseconds + time.tv_nsec;
}

// Fills the block unless the file ends. Returns the number of bytes read, or -1 on an error.
ssize_t read_block(int descriptor, std::vector<char>& block) {
  std::size_t filled = 0;
  while (filled < block.size()) {
    const ssize_t count = ::read(descriptor, block.data() + filled, block.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return count;
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  return static_cast<ssize_t>(filled);
}

// Returns 0 if the file cannot be read.
std::uint64_t hash_of_content(const std::string& file, const std::function<bool()>& stopped) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return 0;
  TextHash hash;
  std::vector<char> block(std::size_t{1} << 20U);
  std::uint64_t size = 0;
  ssize_t count = 0;
  while ((count = read_block(descriptor, block)) > 0) {
    const auto bytes = static_cast<std::size_t>(count);
    std::size_t at = 0;
    for (std::uint32_t word = 0; at + sizeof word <= bytes; at += sizeof word) {
      std::memcpy(&word, block.data() + at, sizeof word);
      hash.add_word(word);
    }
    hash.add(std::string_view(block.data() + at, bytes - at));
    size += bytes;
    if (stopped()) {
      ::close(descriptor);
      throw SweepStopped{};
    }
  }
  ::close(descriptor);
  if (count < 0) return 0;
  hash.add(std::to_string(size));
  return std::max<std::uint64_t>(hash.value(), 1);
}

// The work of the child that looks at the frames: prints JSON.
int print_frames(const Arguments& arguments) {
  try {
    const RunOptions options = parse_run_options(arguments);
    if (read_lone_instance(options)) return kCannotBeCut;
    const Scene scene = load_necklaces(options, FrameMotion::linear, 1, [](const std::string&) {});
    if (scene.necklaces().size() != 1) return kCannotBeCut;
    Json found{{"frames", scene.frame_count()}};
    if (options.radius == "auto") found["radius"] = fmt::format("{}", scene.radii().front());
    print_to_stdout(text_of(found));
    return 0;
  } catch (const InputError&) {
    return 2;
  }
}

std::optional<std::uint64_t> hex_in(const Json* json) {
  if (json == nullptr || json->text() == nullptr) return std::nullopt;
  return std::strtoull(json->text()->c_str(), nullptr, 16);
}

std::optional<std::uint64_t> whole_in(const Json& object, std::string_view name) {
  const Json* const found = object.find(name);
  if (found == nullptr || found->whole_number() == nullptr) return std::nullopt;
  return *found->whole_number();
}

std::optional<FramesFound> frames_in(const Json& json) {
  const auto frames = whole_in(json, "frames");
  const Json* const radius = json.find("radius");
  if (!frames) return std::nullopt;
  return FramesFound{*frames,
                     radius != nullptr && radius->text() != nullptr ? *radius->text() : std::string()};
}

}  // namespace

void InputHashes::load(const fs::path& folder) {
  const Json json = parse_json(text_in(folder / kRemembered));
  const Json* const files = json.find("files");
  if (files != nullptr && files->items() != nullptr)
    for (const Json& item : *files->items()) {
      const Json *const path = item.find("path"), *const bytes = item.find("bytes");
      const auto hash = hex_in(item.find("hash"));
      if (path == nullptr || path->text() == nullptr || bytes == nullptr ||
          bytes->whole_number() == nullptr || !hash)
        continue;
      File file;
      file.bytes = *bytes->whole_number();
      file.hash = *hash;
      const auto inode = whole_in(item, "inode"), modified = whole_in(item, "modified"),
                 changed = whole_in(item, "changed");
      file.trusted = inode && modified && changed;
      if (file.trusted)
        file.stamp = {*inode, static_cast<std::int64_t>(*modified), static_cast<std::int64_t>(*changed)};
      file.exists = true;
      earlier_[*path->text()] = file;
    }
  const Json* const cuts = json.find("frames");
  if (cuts != nullptr && cuts->items() != nullptr)
    for (const Json& item : *cuts->items())
      if (const auto key = hex_in(item.find("key"))) frames_[*key] = frames_in(item);
}

void InputHashes::save(const fs::path& folder) {
  if (!changed_) return;
  auto known = files_;
  known.insert(earlier_.begin(), earlier_.end());
  Json files = Json::array(), cuts = Json::array();
  for (const auto& [path, file] : known) {
    if (file.hash == 0 || !line_of(Json(path))) continue;  // JSON holds UTF-8 only
    Json item{{"path", path}, {"bytes", file.bytes}};
    if (file.trusted) {
      item["inode"] = file.stamp.inode;
      item["modified"] = static_cast<std::uint64_t>(file.stamp.modified);
      item["changed"] = static_cast<std::uint64_t>(file.stamp.changed);
    }
    item["hash"] = hex_digits(file.hash);
    files.push_back(std::move(item));
  }
  for (const auto& [key, found] : frames_) {
    Json cut{{"key", hex_digits(key)}};
    if (found) {
      cut["frames"] = found->frames;
      cut["radius"] = found->radius;
    }
    cuts.push_back(std::move(cut));
  }
  AtomicFiles written;
  written.write(folder / kRemembered, text_of({{"files", files}, {"frames", cuts}}));
  commit_together({&written});
  changed_ = false;
}

InputHashes::File InputHashes::seen(const std::string& file) {
  File found;
  struct stat status {};
  const auto nanoseconds = [](const timespec& time) { return time.tv_sec * kNanoseconds + time.tv_nsec; };
  if (::stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode)) {
    found.exists = true;
    found.bytes = static_cast<std::uint64_t>(status.st_size);
    found.stamp = {status.st_ino, nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
  }
  return found;
}

bool InputHashes::are_alike(const File& a, const File& b) {
  return a.exists == b.exists && a.bytes == b.bytes && a.stamp == b.stamp;
}

bool InputHashes::has_changed(const std::string& file) {
  const auto known = files_.find(file);
  if (known == files_.end()) return false;
  File& then = known->second;
  File found = seen(file);
  if (found.exists ? are_alike(found, then) : !then.exists) return false;
  if (!found.exists || found.bytes != then.bytes) return true;
  try {
    found.hash = hash_of_content(file, stopped_);
  } catch (const SweepStopped&) {
    return true;  // unknown; the sweep ends anyway
  }
  if (found.hash != then.hash) return true;
  then = found;
  return false;
}

// A file is looked at before it is read, so a change meanwhile gives it another time than the one noted.
std::uint64_t InputHashes::hash(const std::string& file) {
  if (const auto known = files_.find(file); known != files_.end()) return known->second.hash;
  File found = seen(file);
  const auto earlier = earlier_.find(file);
  const bool remembered = earlier != earlier_.end();
  if (found.exists) {
    const bool same = remembered && earlier->second.trusted && are_alike(earlier->second, found);
    constexpr std::int64_t settled = 2 * kNanoseconds;
    found.trusted = same || now() - found.stamp.changed > settled;
    found.hash = same ? earlier->second.hash : hash_of_content(file, stopped_);
    changed_ = changed_ || !same;
  }
  if (found.hash == 0 && remembered) {
    found.bytes = earlier->second.bytes;
    found.hash = earlier->second.hash;
    found.trusted = false;
    gone_.insert(file);
  }
  files_.emplace(file, found);
  return found.hash;
}

std::vector<std::string> InputHashes::gone() const { return {gone_.begin(), gone_.end()}; }

std::uint64_t InputHashes::bytes(const std::string& file) const {
  const auto known = files_.find(file);
  return known == files_.end() ? 0 : known->second.bytes;
}

std::optional<FramesFound> InputHashes::frames(std::uint64_t key, const Arguments& arguments) {
  if (const auto known = frames_.find(key); known != frames_.end()) return known->second;
  TaskProcess child([&] { return print_frames(arguments); }, {});
  std::optional<TaskProcess::End> end;
  while (!(end = child.ended())) {
    if (stopped_()) throw SweepStopped{};
    constexpr timespec pause{0, 1'000'000};
    ::nanosleep(&pause, nullptr);
  }
  std::optional<FramesFound> found;
  if (end->signal == 0 && end->code == 0) found = frames_in(parse_json(child.output().out()));
  if (end->signal == 0 && end->code <= kCannotBeCut) {  // else the next sweep may find more
    frames_[key] = found;
    changed_ = true;
  }
  return found;
}

}  // namespace kds
