#pragma once
// Records that are sorted on disk (external merge sort): memory holds a bounded number of them, however many
// there are.

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <queue>
#include <type_traits>
#include <vector>

#include "experiments/output/output_files.h"

namespace kds {

/// Sorts by operator<. Sorted runs of records wait in an unnamed temporary file until they are merged. The
/// file is made when the first run is full.
template <class Record>
class SortedRecords {
  static_assert(std::is_trivially_copyable_v<Record>);

 public:
  /// `most` is the number of records in a run.
  explicit SortedRecords(std::size_t most = std::size_t{1} << 18U) : most_(most) {}

  /// Throws OutputError if the disk is full.
  void add(const Record& record) {
    if (last_.size() == most_) spill();
    last_.push_back(record);
  }

  /// Calls `visit(record)` for all records in ascending order. Equal records come in any order. More records
  /// can be added afterwards.
  template <class Visit>
  void visit_sorted(const Visit& visit) {
    std::sort(last_.begin(), last_.end());
    std::vector<Run> runs;
    for (std::size_t run = 0; run < spilled_; ++run) runs.push_back({run * most_, (run + 1) * most_, {}, 0});
    const auto is_later = [&](std::size_t a, std::size_t b) { return runs[b].top() < runs[a].top(); };
    std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(is_later)> next(is_later);
    for (std::size_t run = 0; run < runs.size(); ++run)
      if (fill(runs[run])) next.push(run);
    for (auto own = last_.begin(); own != last_.end() || !next.empty();) {
      if (next.empty() || (own != last_.end() && *own < runs[next.top()].top())) {
        visit(*own++);
        continue;
      }
      const std::size_t run = next.top();
      next.pop();
      visit(runs[run].top());
      ++runs[run].at;
      if (fill(runs[run])) next.push(run);
    }
  }

 private:
  /// The part of a run from `place` to `end` is not read yet.
  struct Run {
    std::size_t place, end;
    std::vector<Record> records;
    std::size_t at;
    [[nodiscard]] const Record& top() const { return records[at]; }
  };

  [[noreturn]] static void fail() { fail_to_write("a temporary file: cannot write", errno); }

  void spill() {
    if (!file_) file_.reset(std::tmpfile());
    std::sort(last_.begin(), last_.end());
    if (!file_ || std::fseek(file_.get(), 0, SEEK_END) != 0 ||
        std::fwrite(last_.data(), sizeof(Record), last_.size(), file_.get()) != last_.size())
      fail();
    last_.clear();
    ++spilled_;
  }

  /// Reads on if all records in memory are used. Returns whether there is a record.
  bool fill(Run& run) const {
    constexpr std::size_t block = 2048;
    if (run.at < run.records.size()) return true;
    run.records.resize(std::min(block, run.end - run.place));
    run.at = 0;
    if (run.records.empty()) return false;
    if (std::fseek(file_.get(), static_cast<long>(run.place * sizeof(Record)), SEEK_SET) != 0 ||
        std::fread(run.records.data(), sizeof(Record), run.records.size(), file_.get()) != run.records.size())
      throw OutputError("a temporary file: cannot read");
    run.place += run.records.size();
    return true;
  }

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::size_t most_, spilled_ = 0;
  std::vector<Record> last_;  // the run that is not full
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace kds
