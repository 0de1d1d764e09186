#pragma once
// The guard of a facet of a kinetic power diagram, stored in the 32 bits that its cell keeps for it.

#include <cstdint>

#include "kds/certificate_table.h"

namespace kds {

struct FacetGuard {
  /// The function of the certificate: a power test, an orientation on the hull, or the orientation of a cell.
  /// If a power test is zero for the whole step (all its beads stay on one sphere), it would not notice that
  /// the facet's cells turn over. Each side then guards the orientation of its own cell.
  enum class About : std::uint8_t { power, hull, cell };

  CertificateHandle guard = CertificateHandle::violated;
  About about = About::power;

  /// Returns the guard as the cell stores it. A new cell stores 0, which means `violated`.
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
