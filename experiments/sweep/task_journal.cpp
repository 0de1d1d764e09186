#include "experiments/sweep/task_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 6> kKinds{"made", "try", "drop", "died", "fail", "done"};
constexpr std::size_t kHex = 16;
constexpr std::string_view kSeconds = R"({"seconds":)";  // the records of results begin with it

std::optional<std::uint64_t> hex_number(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, 16);
  if (text.size() != kHex || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

// A directory lists its files in any order. Journals are read in the order in which they were last written,
// so that of two results the first counts, and of two failures the last.
TaskStates::TaskStates(const fs::path& folder) {
  std::error_code error;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  for (fs::directory_iterator file(folder, error), end; file != end && !error; file.increment(error)) {
    std::error_code gone;
    files.emplace_back(file->last_write_time(gone), file->path());
  }
  std::ranges::sort(files);
  for (const auto& [written, path] : files) {
    journals_.push_back({path, {0, "unknown"}});
    std::ifstream stream(path, std::ios::binary);
    std::uint64_t offset = 0;
    for (std::string line; std::getline(stream, line) && !stream.eof(); offset += line.size() + 1)
      take(line, offset);
  }
}

// A line is HASH KIND TASK JSON.
void TaskStates::take(std::string_view line, std::uint64_t offset) {
  ++damaged_;
  const auto hash = hex_number(line.substr(0, kHex));
  if (!hash || line.size() < kHex + 1 || line[kHex] != ' ' || TextHash::of(line.substr(kHex + 1)) != *hash)
    return;
  const std::size_t kind_end = std::min(line.find(' ', kHex + 1), line.size());
  const std::size_t json = kind_end + kHex + 2;
  const auto kind = std::ranges::find(kKinds, line.substr(kHex + 1, kind_end - kHex - 1));
  const auto name = line.size() < json ? std::nullopt : hex_number(line.substr(kind_end + 1, kHex));
  if (kind == kKinds.end() || !name) return;
  --damaged_;
  const auto record = static_cast<RecordKind>(kind - kKinds.begin());
  const std::string_view text = line.substr(json);
  if (record == RecordKind::made) {
    const Json made = parse_json(text);
    const Json* const version = made.find("version");
    journals_.back().maker = {*name,
                              version != nullptr && version->text() != nullptr ? *version->text() : ""};
    return;
  }
  const auto journal = static_cast<std::uint32_t>(journals_.size() - 1);
  count(record, *name, text, {journal, static_cast<std::uint32_t>(text.size()), offset + json});
}

void TaskStates::count(RecordKind kind, TaskName name, std::string_view json, const RecordSpan& span) {
  TaskState& task = tasks_[name];
  task.attempts += kind == RecordKind::attempt ? 1U : 0U;
  task.died += kind == RecordKind::died ? 1U : 0U;
  if (kind == RecordKind::drop || kind == RecordKind::fail || kind == RecordKind::done) ++task.closed;
  if (kind < RecordKind::died || task.settled == TaskStatus::done) return;
  if (kind == RecordKind::died && task.settled == TaskStatus::failed) return;
  task.span = span;
  if (kind == RecordKind::fail) task.settled = TaskStatus::failed;
  if (kind != RecordKind::done) return;
  task.settled = TaskStatus::done;
  constexpr std::size_t times = 100;  // characters that hold the two times at the start of the record
  task.warned = json.substr(0, times).find(R"("warnings":)") != std::string_view::npos;
  if (json.starts_with(kSeconds))
    task.seconds = std::strtof(std::string(json.substr(kSeconds.size(), times)).c_str(), nullptr);
}

const TaskState& TaskStates::of(TaskName task) const {
  static const TaskState untouched;
  const auto found = tasks_.find(task);
  return found == tasks_.end() ? untouched : found->second;
}

void TaskStates::forgive() {
  std::erase_if(tasks_, [](const auto& task) { return task.second.settled != TaskStatus::done; });
}

Json TaskStates::read(const RecordSpan& span) const {
  if (span.length == 0) return {};
  const fs::path& file = journals_[span.journal].file;
  std::ifstream stream(file, std::ios::binary);
  std::string text(span.length, '\0');
  stream.seekg(static_cast<std::streamoff>(span.offset));
  if (!stream.read(text.data(), static_cast<std::streamsize>(text.size())))
    throw OutputError(fmt::format("{}: a journal was removed while it was read", file.string()));
  return parse_json(text);
}

std::map<std::string, std::size_t> TaskStates::of_other_versions() const {
  std::map<std::string, std::size_t> versions;
  for (const auto& [name, task] : tasks_) {
    if (task.settled != TaskStatus::done) continue;
    const JournalMaker& maker = journals_[task.span.journal].maker;
    if (maker.sources != results_version()) ++versions[maker.version];
  }
  return versions;
}

JournalWriter::~JournalWriter() {
  if (file_ >= 0) ::close(file_);
}

bool JournalWriter::add(RecordKind kind, TaskName task, std::string_view json) {
  if (file_ < 0) {
    std::random_device random;
    path_ = folder_ / (hex_digits(std::uint64_t{random()} << 32U | random()) + ".results");
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (file_ < 0) fail_to_write(path_.string(), errno);
    size_ = 0;
    const bool fits =
        add(RecordKind::made, maker_.sources, line_of({{"version", maker_.version}}).value_or("{}"));
    if (!fits) {
      ::close(file_);
      ::unlink(path_.c_str());
      file_ = -1;
      return false;
    }
    const int folder = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
      ::fsync(folder);
      ::close(folder);
    }
  }
  const std::string rest =
      fmt::format("{} {} {}", kKinds[static_cast<std::size_t>(kind)], hex_digits(task), json);
  const std::string line = fmt::format("{} {}\n", hex_digits(TextHash::of(rest)), rest);
  for (std::size_t written = 0; written < line.size();) {
    const ssize_t count = ::write(file_, line.data() + written, line.size() - written);
    if (count >= 0) {
      written += static_cast<std::size_t>(count);
    } else if (const int error = errno; error != EINTR) {
      if (::ftruncate(file_, static_cast<off_t>(size_)) != 0) fail_to_write(path_.string(), errno);
      if (error == ENOSPC || error == EDQUOT || error == EFBIG) return false;
      fail_to_write(path_.string(), error);
    }
  }
  size_ += line.size();
  if (!waits_) since_ = Clock::now();
  waits_ = true;
  return true;
}

void JournalWriter::sync(double seconds) {
  if (!waits_ || std::chrono::duration<double>(Clock::now() - since_).count() < seconds) return;
  if (::fdatasync(file_) != 0) fail_to_write(path_.string(), errno);
  waits_ = false;
}

}  // namespace kds
