#pragma once
// Van der Waals radii in angstrom, as tabulated in gemmi (Mantina et al. 2009; Bondi 1964).

#include <cstddef>
#include <optional>
#include <string_view>

namespace kds {

/// None for what is no element symbol (case does not matter) or has no measured radius.
[[nodiscard]] std::optional<double> van_der_waals_radius(std::string_view symbol);
[[nodiscard]] std::optional<double> van_der_waals_radius(std::size_t atomic_number);

}  // namespace kds
