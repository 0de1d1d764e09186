#include "motions/readers/netcdf_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

constexpr std::uint64_t longest_header = std::uint64_t{1} << 20U;
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 50U;  // sums of a few do not overflow
// Bytes of a value of each type. Only CDF-5 has the types after double.
constexpr std::array<std::uint64_t, 12> bytes_of_type{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
constexpr int double_type = 6;

std::uint64_t padded_size(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

}  // namespace

NetcdfLayout::NetcdfLayout(InputFile& input) : file_(input.name()), file_size_(input.length().bytes) {
  header_.resize(static_cast<std::size_t>(std::min(file_size_, longest_header)));
  if (!input.read_at(0, header_.data(), header_.size()))
    throw InputError(fmt::format("{}: cannot read this file", file_));
  read_header();
  header_.clear();
}

const NetcdfVariable* NetcdfLayout::find(std::string_view name) const {
  const auto found = std::find_if(variables_.begin(), variables_.end(),
                                  [&](const NetcdfVariable& variable) { return variable.name == name; });
  return found == variables_.end() ? nullptr : &*found;
}

std::uint64_t NetcdfLayout::whole_records() const {
  std::uint64_t end = 0;  // the end of the first record
  for (const NetcdfVariable& variable : variables_)
    if (variable.has_records) end = std::max(end, variable.begin + variable.bytes);
  if (record_size_ == 0 || file_size_ < end) return 0;
  return 1 + (file_size_ - end) / record_size_;
}

std::uint64_t NetcdfLayout::room_of(const NetcdfVariable& variable) const {
  std::uint64_t end = file_size_;
  for (const NetcdfVariable& other : variables_)
    if (other.begin > variable.begin) end = std::min(end, other.begin);
  return end - std::min(end, variable.begin);
}

std::uint64_t NetcdfLayout::record_begin(std::uint64_t k) const {
  std::uint64_t begin = std::numeric_limits<std::uint64_t>::max();
  for (const NetcdfVariable& variable : variables_)
    if (variable.has_records) begin = std::min(begin, variable.begin);
  return begin + k * record_size_;
}

void NetcdfLayout::fail(const std::string& what) const {
  throw InputError(fmt::format("{}: byte {}: {}", file_, offset_, what));
}

void NetcdfLayout::fail_end() const {
  if (header_.size() < file_size_)
    fail(fmt::format("expected a NetCDF header of at most {} bytes", header_.size()));
  fail("the file ends inside its NetCDF header");
}

// Reads an unsigned number of 1 to 8 bytes, the most significant first.
std::uint64_t NetcdfLayout::number(std::size_t bytes) {
  if (header_.size() - offset_ < bytes) fail_end();
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    value = value << 8U | static_cast<unsigned char>(header_[offset_ + i]);
  offset_ += bytes;
  return value;
}

// Reads the length of a list whose items take at least 4 bytes each.
std::size_t NetcdfLayout::list(std::uint64_t tag, const char* items) {
  const auto begin = offset_;
  const std::uint64_t found = number(4);
  const std::uint64_t length = size();
  if (found != tag && (found != 0 || length != 0)) {
    offset_ = begin;
    fail(fmt::format("expected the NetCDF list of {} (tag {}), found tag {} and length {}", items, tag,
                     static_cast<std::int32_t>(found), with_sign(length)));
  }
  if (length > (header_.size() - offset_) / 4) fail_end();
  return static_cast<std::size_t>(length);
}

std::string_view NetcdfLayout::padded_bytes(std::uint64_t bytes) {
  const std::uint64_t left = header_.size() - offset_;
  if (bytes > left || padded_size(bytes) > left) fail_end();
  const std::string_view text(header_.data() + offset_, static_cast<std::size_t>(bytes));
  offset_ += static_cast<std::size_t>(padded_size(bytes));
  return text;
}

int NetcdfLayout::type() {
  const std::uint64_t found = number(4);
  const std::uint64_t last = version_ == 5 ? bytes_of_type.size() - 1 : double_type;
  if (found == 0 || found > last) {
    offset_ -= 4;
    fail(
        fmt::format("expected a NetCDF type from 1 to {}, found {}", last, static_cast<std::int32_t>(found)));
  }
  return static_cast<int>(found);
}

void NetcdfLayout::skip_attributes() {
  for (std::size_t left = list(12, "attributes"); left > 0; --left) {
    static_cast<void>(padded_bytes(size()));
    const std::uint64_t bytes = bytes_of_type[static_cast<std::size_t>(type())];
    const std::uint64_t count = size();
    if (count > header_.size()) fail_end();
    static_cast<void>(padded_bytes(bytes * count));
  }
}

void NetcdfLayout::read_header() {
  offset_ = 3;
  version_ = number(1);
  const std::uint64_t records = size();
  const std::uint64_t streamed =
      version_ == 5 ? std::numeric_limits<std::uint64_t>::max() : std::numeric_limits<std::uint32_t>::max();
  if (records != streamed) records_claimed_ = records;
  if (records_claimed_ > most_bytes) fail(fmt::format("no file has {} records", with_sign(records)));
  std::vector<std::uint64_t> dimensions;
  for (std::size_t left = list(10, "dimensions"); left > 0; --left) {
    static_cast<void>(padded_bytes(size()));
    dimensions.push_back(size());
  }
  skip_attributes();
  for (std::size_t left = list(11, "variables"); left > 0; --left) read_variable(dimensions);
  sum_records();
}

void NetcdfLayout::read_variable(const std::vector<std::uint64_t>& dimensions) {
  NetcdfVariable variable;
  variable.name = padded_bytes(size());
  variable.id = static_cast<int>(variables_.size());
  const std::uint64_t rank = size();
  if (rank > (header_.size() - offset_) / 4) fail_end();
  for (std::uint64_t i = 0; i < rank; ++i) {
    const auto begin = offset_;
    const std::uint64_t dimension = size();
    if (dimension >= dimensions.size()) {
      offset_ = begin;
      fail(fmt::format("expected the number of one of {} dimensions, counted from 0, found {}",
                       dimensions.size(), with_sign(dimension)));
    }
    const std::uint64_t length = dimensions[static_cast<std::size_t>(dimension)];
    if (length == 0 && i > 0) fail("only the first dimension of a variable can be that of the records");
    variable.has_records = variable.has_records || length == 0;
    variable.lengths.push_back(std::max<std::uint64_t>(length, 1));
  }
  skip_attributes();
  variable.type = type();
  const std::size_t size_offset = offset_;
  const std::uint64_t size_told = size();
  variable.begin = number(version_ == 1 ? 4 : 8);
  variable.bytes = bytes_of_type[static_cast<std::size_t>(variable.type)];
  for (const std::uint64_t length : variable.lengths) {
    if (length > most_bytes / variable.bytes) fail("a variable is larger than any file");
    variable.bytes *= length;
  }
  if (variable.begin > most_bytes) fail("a variable begins beyond the end of any file");
  check_size(variable, size_told, size_offset);
  variables_.push_back(std::move(variable));
}

// The bytes of a part follow from the lengths. Writers may leave out the padding, write 0 for variables
// without records, and write any number where the bytes do not fit into 31 bits.
void NetcdfLayout::check_size(const NetcdfVariable& variable, std::uint64_t told, std::size_t offset) {
  const std::uint64_t padded = padded_size(variable.bytes);
  if (told == padded || told == variable.bytes) return;
  if (version_ != 5 && padded > std::numeric_limits<std::int32_t>::max() - 3U) return;
  if (told == 0 && variable.has_records && records_claimed_.value_or(0) == 0) return;
  offset_ = offset;
  fail(fmt::format("expected a size of {} for the variable {}, as its dimensions say, found {}", padded,
                   in_quotes(variable.name), with_sign(told)));
}

// Parts are padded to whole words, except if only one variable has records.
void NetcdfLayout::sum_records() {
  std::size_t count = 0;
  std::uint64_t exact = 0;
  for (const NetcdfVariable& variable : variables_) {
    if (!variable.has_records) continue;
    ++count;
    exact = variable.bytes;
    record_size_ += padded_size(variable.bytes);
    if (record_size_ > most_bytes) fail("a record is larger than any file");
  }
  if (count == 1) record_size_ = exact;
}

}  // namespace kds
