#pragma once
// Numbers the certificates of all tables of a run: by structure, then by table, then by place in the
// structure.

#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace kds {

class PlaceAmongTables {
 public:
  /// Throws std::logic_error if the structure or the table has a number of 65536 or more.
  PlaceAmongTables(std::size_t structure, unsigned number) {
    if (structure >= most || number >= most)
      throw std::logic_error("a run has at most 65536 structures, and each as many tables of certificates");
    table_ = static_cast<std::uint32_t>(structure << 16U) | number;
  }

  [[nodiscard]] std::uint32_t table() const { return table_; }
  /// Returns a number that orders simultaneous failures of one function: they are handled in ascending order.
  [[nodiscard]] std::uint64_t of(std::uint32_t place) const { return std::uint64_t{table_} << 32U | place; }

 private:
  static constexpr std::size_t most = 65536;
  std::uint32_t table_;
};

}  // namespace kds
