#pragma once
// The three number kernels, chosen when a run starts: what decides a sign or a time.

#include <array>
#include <cstdint>
#include <string_view>

namespace kds {

enum class Kernel : std::uint8_t {
  /// Plain double in the same lanes and with the same first filters as `filtered`, without bounds, proofs or
  /// integers. Its work is bounded; it may be wrong.
  fast,
  /// Exact answers: double with proved error bounds first, integers for what is left. The default.
  filtered,
  /// Integers only: exact, slow, the oracle of the other two.
  exact,
};

/// What filters charge for rounding: all of it, or, with `fast`, nothing. There signs are what they seem to
/// be.
enum class Rounding : std::uint8_t { charged, ignored };
[[nodiscard]] constexpr Rounding rounding_of(Kernel kernel) {
  return kernel == Kernel::fast ? Rounding::ignored : Rounding::charged;
}
/// The factor of all errors.
[[nodiscard]] constexpr double charge_of(Rounding rounding) { return rounding == Rounding::charged ? 1 : 0; }

/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 3> kernel_names{"fast", "filtered", "exact"};
[[nodiscard]] constexpr std::string_view name_of(Kernel kernel) {
  return kernel_names[static_cast<std::size_t>(kernel)];
}

}  // namespace kds
