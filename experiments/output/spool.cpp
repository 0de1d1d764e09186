#include "experiments/output/spool.h"

#include <array>
#include <cerrno>

#include "experiments/output/output_error.h"

namespace kds {

namespace {

constexpr const char* kSpoolSubject = "a temporary file: cannot write";

}  // namespace

Spool::Spool() : file_(std::tmpfile()) {
  if (!file_) fail_to_write(kSpoolSubject, errno);
}

void Spool::add(std::string_view text) {
  if (text.empty()) return;
  empty_ = false;
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size())
    fail_to_write(kSpoolSubject, errno);
}

void Spool::read(const TextSink& sink) const {
  if (std::fflush(file_.get()) != 0) fail_to_write(kSpoolSubject, errno);
  std::rewind(file_.get());
  std::array<char, 1 << 16> bytes;
  for (std::size_t count = 0; (count = std::fread(bytes.data(), 1, bytes.size(), file_.get())) > 0;)
    sink({bytes.data(), count});
  if (std::ferror(file_.get()) != 0) throw OutputError("a temporary file: cannot read");
  std::fseek(file_.get(), 0, SEEK_END);
}

}  // namespace kds
