#pragma once
// Numbers, boxes and times as GROMACS writes them: big-endian (XDR), in nanometres and picoseconds.

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>

#include "motions/frames/periodic.h"
#include "motions/readers/nanometres.h"

namespace kds {

/// Converts a big-endian number of 4 or 8 bytes, which need not be aligned.
template <class Number>
[[nodiscard]] Number xdr_number(const char* bytes) {
  using Bits = std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>;
  static_assert(sizeof(Number) == sizeof(Bits));
  Bits bits;
  std::memcpy(&bits, bytes, sizeof bits);
  if constexpr (std::endian::native == std::endian::little) {
    if constexpr (sizeof bits == 4)
      bits = __builtin_bswap32(bits);
    else
      bits = __builtin_bswap64(bits);
  }
  return std::bit_cast<Number>(bits);
}

/// Returns the time in a frame: the shortest decimal number that rounds to the float, 0.2 and not
/// 0.200000003. None if the float is not finite.
[[nodiscard]] inline std::optional<double> xdr_time(float picoseconds) {
  if (!std::isfinite(picoseconds)) return std::nullopt;
  std::array<char, 32> text;
  const auto written = std::to_chars(text.data(), text.data() + text.size(), picoseconds);
  double decimal = 0;
  std::from_chars(text.data(), written.ptr, decimal);
  return decimal;
}

/// Reads a box from its three vectors, nine numbers in nanometres.
template <class Number>
[[nodiscard]] CellRead xdr_box(const char* bytes) {
  Eigen::Matrix3d vectors;
  for (Eigen::Index i = 0; i < 9; ++i)
    vectors(i % 3, i / 3) = angstrom_of_nanometres(
        static_cast<float>(xdr_number<Number>(bytes + static_cast<std::size_t>(i) * sizeof(Number))));
  return read_cell(vectors);
}

}  // namespace kds
