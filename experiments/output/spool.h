#pragma once
// Text that waits on disk in an unnamed temporary file, so that memory does not grow with the text.

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <string_view>
#include <type_traits>

#include "experiments/output/output_files.h"

namespace kds {

/// Receives a text piece by piece.
using TextSink = std::function<void(std::string_view)>;

class Spool {
 public:
  /// Throws OutputError if the system provides no temporary file.
  Spool() : file_(std::tmpfile()) {
    if (!file_) fail();
  }

  /// Throws OutputError if the disk is full.
  void add(std::string_view text) {
    if (text.empty()) return;
    empty_ = false;
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
  }
  [[nodiscard]] bool empty() const { return empty_; }
  /// Passes the whole text to `sink` in order. More text can be added afterwards.
  void read(const TextSink& sink) const {
    if (std::fflush(file_.get()) != 0) fail();
    std::rewind(file_.get());
    std::array<char, 1 << 16> bytes;
    for (std::size_t count = 0; (count = std::fread(bytes.data(), 1, bytes.size(), file_.get())) > 0;)
      sink({bytes.data(), count});
    if (std::ferror(file_.get()) != 0) throw OutputError("a temporary file: cannot read");
    std::fseek(file_.get(), 0, SEEK_END);
  }

 private:
  [[noreturn]] static void fail() { fail_to_write("a temporary file: cannot write", errno); }

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  bool empty_ = true;
};

/// Records that wait on disk in an unnamed temporary file.
template <class Record>
class SpooledRecords {
  static_assert(std::is_trivially_copyable_v<Record>);

 public:
  void add(const Record& record) { spool_.add({reinterpret_cast<const char*>(&record), sizeof record}); }
  /// Calls `visit(record)` for all records in order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    std::array<char, sizeof(Record)> bytes{};
    std::size_t filled = 0;
    spool_.read([&](std::string_view text) {
      while (!text.empty()) {
        const std::size_t count = std::min(text.size(), bytes.size() - filled);
        std::memcpy(bytes.data() + filled, text.data(), count);
        text.remove_prefix(count);
        filled += count;
        if (filled < bytes.size()) continue;
        filled = 0;
        visit(std::bit_cast<Record>(bytes));
      }
    });
  }

 private:
  Spool spool_;
};

}  // namespace kds
