#pragma once
// The three number kernels, which decide signs and times. The kernel is chosen when a run starts.

#include <array>
#include <cstdint>
#include <string_view>

namespace kds {

enum class Kernel : std::uint8_t {
  /// Plain double, with the lanes and first filters of `filtered`, but without error bounds, proofs or
  /// integers. The work is bounded; results may be wrong.
  fast,
  /// Exact answers: double with proved error bounds first, then integers for undecided cases. The default.
  filtered,
  /// Integers only. Exact and slow; serves as the oracle for the other two.
  exact,
};

/// Whether filters charge for rounding. With `ignored`, used by the kernel `fast`, error bounds are zero and
/// signs are taken as computed.
enum class Rounding : std::uint8_t { charged, ignored };
[[nodiscard]] constexpr Rounding rounding_of(Kernel kernel) {
  return kernel == Kernel::fast ? Rounding::ignored : Rounding::charged;
}
/// Returns the factor applied to all error bounds.
[[nodiscard]] constexpr double charge_of(Rounding rounding) { return rounding == Rounding::charged ? 1 : 0; }

/// Names, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> kernel_names{"fast", "filtered", "exact"};
[[nodiscard]] constexpr std::string_view name_of(Kernel kernel) {
  return kernel_names[static_cast<std::size_t>(kernel)];
}

}  // namespace kds
