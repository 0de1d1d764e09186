#pragma once
// Van der Waals radii in angstrom, as tabulated in gemmi (Mantina et al. 2009; Bondi 1964).

#include <cstddef>
#include <optional>
#include <string_view>

namespace kds {

/// Return the radius, or nothing if the argument is not an element (symbols may be in either case) or if the
/// element has no measured radius.
[[nodiscard]] std::optional<double> van_der_waals_radius(std::string_view symbol);
[[nodiscard]] std::optional<double> van_der_waals_radius(std::size_t atomic_number);

}  // namespace kds
