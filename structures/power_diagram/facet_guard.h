#pragma once
// What guards a facet of a kinetic power diagram, in the 32 bits that its cell keeps for it.

#include <cstdint>

#include "kds/certificate_table.h"

namespace kds {

struct FacetGuard {
  /// Where a power test is zero for the whole step, all its beads on one sphere, it would not see the facet's
  /// cells turn over: then each side guards its own cell's orientation instead.
  enum class About : std::uint8_t { power, hull, cell };

  CertificateHandle guard = CertificateHandle::violated;
  About about = About::power;

  /// As the cell notes it: 0 is the guard of a new cell.
  [[nodiscard]] constexpr std::uint32_t packed() const {
    return static_cast<std::uint32_t>(about) << 30U |
           ((static_cast<std::uint32_t>(guard) - first_name) & mask);
  }
  [[nodiscard]] static constexpr FacetGuard of(std::uint32_t note) {
    const std::uint32_t low = note & mask;  // violated, zero, never, then the slots
    return {static_cast<CertificateHandle>(low < names ? first_name + low : low - names),
            static_cast<About>(note >> 30U)};
  }

 private:
  static constexpr std::uint32_t mask = (1U << 30U) - 1, names = 3;
  static constexpr auto first_name = static_cast<std::uint32_t>(CertificateHandle::violated);
};

}  // namespace kds
