#pragma once
// The layout of a classic NetCDF file: where its variables begin and end, which libnetcdf does not report.
// Attributes are skipped. Each size in the header is compared with the size of the file before libnetcdf
// opens it, because libnetcdf believes the header.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motions/base/input_file.h"

namespace kds {

/// A variable as the header declares it. A variable with records has one part in each record. Any other
/// variable is one part.
struct NetcdfVariable {
  std::string name;
  int id = 0;                          ///< as libnetcdf numbers variables
  std::vector<std::uint64_t> lengths;  ///< lengths of its dimensions; 1 for the records
  bool has_records = false;
  std::uint64_t begin = 0;  ///< byte of the first part
  std::uint64_t bytes = 0;  ///< in one part
  int type = 0;             ///< as the NC_FLOAT of libnetcdf
};

class NetcdfLayout {
 public:
  /// Reads the header of a file in CDF-1, CDF-2 or CDF-5. Throws InputError naming file and byte.
  explicit NetcdfLayout(InputFile& input);

  /// Returns the variable, or null.
  [[nodiscard]] const NetcdfVariable* find(std::string_view name) const;
  [[nodiscard]] std::uint64_t file_size() const { return file_size_; }
  [[nodiscard]] std::uint64_t record_size() const { return record_size_; }
  /// Returns the number of records by the header; none if the file was written as a stream.
  [[nodiscard]] std::optional<std::uint64_t> records_claimed() const { return records_claimed_; }
  /// Returns the number of records that the file has all bytes of.
  [[nodiscard]] std::uint64_t whole_records() const;
  /// Returns the bytes from the first one of a variable to the next variable, or to the end of the file.
  [[nodiscard]] std::uint64_t room_of(const NetcdfVariable& variable) const;
  /// Returns the byte at which record k begins.
  [[nodiscard]] std::uint64_t record_begin(std::uint64_t k) const;

 private:
  void read_header();
  void read_variable(const std::vector<std::uint64_t>& dimensions);
  void check_size(const NetcdfVariable& variable, std::uint64_t told, std::size_t offset);
  void sum_records();
  void skip_attributes();
  [[nodiscard]] std::uint64_t number(std::size_t bytes);
  [[nodiscard]] std::uint64_t size() { return number(version_ == 5 ? 8 : 4); }
  [[nodiscard]] std::size_t list(std::uint64_t tag, const char* items);
  [[nodiscard]] std::string_view padded_bytes(std::uint64_t bytes);
  [[nodiscard]] int type();
  /// Returns a size in the header as messages show it: sizes of classic files have signs.
  [[nodiscard]] std::int64_t with_sign(std::uint64_t size) const {
    return version_ == 5 ? static_cast<std::int64_t>(size) : static_cast<std::int32_t>(size);
  }
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_end() const;

  std::string file_;
  std::uint64_t file_size_ = 0;
  std::string header_;
  std::size_t offset_ = 0;  // position in the header, in bytes
  std::uint64_t version_ = 0;
  std::optional<std::uint64_t> records_claimed_;
  std::uint64_t record_size_ = 0;
  std::vector<NetcdfVariable> variables_;
};

}  // namespace kds
