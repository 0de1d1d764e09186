#include "motions/base/line_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "motions/base/input_error.h"

namespace kds {

bool LineReader::next(std::string_view& line) {
  for (std::size_t searched = 0;;) {
    const std::string_view left(buffer_.data() + begin_, end_ - begin_);
    const std::size_t length = left.find('\n', searched);
    if (std::min(length, left.size()) > longest)
      throw InputError(
          fmt::format("{}:{}: this line is longer than {} characters, which none of this format is", name(),
                      number_ + 1, longest));
    if (length != std::string_view::npos) {
      line = left.substr(0, length);
      begin_ += length + 1;
      cut_ = false;
      break;
    }
    searched = left.size();
    if (fill()) continue;
    if (left.empty()) return false;
    line = {buffer_.data() + begin_, end_ - begin_};
    begin_ = end_;
    cut_ = true;
    break;
  }
  ++number_;
  if (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

// Moves the unread text to the front of the buffer and reads more. Returns false at the end of the file.
bool LineReader::fill() {
  constexpr std::size_t piece = std::size_t{1} << 16U;
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() < end_ + piece) buffer_.resize(end_ + piece);
  const std::size_t got = file_.read(buffer_.data() + end_, piece);
  end_ += got;
  if (at_start_ && end_ >= 3) {
    begin_ = byte_order_mark({buffer_.data(), end_}, name());
    at_start_ = false;
  }
  return got > 0;
}

void LineReader::rewind() {
  file_.rewind();
  begin_ = end_ = number_ = 0;
  at_start_ = true;
  cut_ = false;
}

void LineReader::seek(std::uint64_t place, std::size_t number) {
  if (place == 0) return rewind();
  const std::uint64_t in_memory = file_.place() - end_;
  if (in_memory <= place && place <= file_.place()) {
    begin_ = static_cast<std::size_t>(place - in_memory);
  } else {
    file_.seek(place);
    begin_ = end_ = 0;
  }
  number_ = number - 1;
  at_start_ = false;
  cut_ = false;
}

}  // namespace kds
