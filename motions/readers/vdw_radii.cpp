#include "motions/readers/vdw_radii.h"

#include <cctype>
#include <cmath>
#include <gemmi/elem.hpp>
#include <string>

namespace kds {

namespace {

std::optional<double> radius_of(gemmi::Element element) {
  // From rutherfordium on the table holds placeholders.
  if (element == gemmi::El::X || (element.ordinal() >= 104 && element != gemmi::El::D)) return std::nullopt;
  // The table is in float: back to the two decimals it was written with.
  return std::round(static_cast<double>(element.vdw_r()) * 100) / 100;
}

}  // namespace

std::optional<double> van_der_waals_radius(std::string_view symbol) {
  if (symbol.empty() || symbol.size() > 2) return std::nullopt;
  for (const char c : symbol)
    if (!std::isalpha(static_cast<unsigned char>(c))) return std::nullopt;
  return radius_of(gemmi::Element{std::string(symbol)});
}

std::optional<double> van_der_waals_radius(std::size_t atomic_number) {
  if (atomic_number == 0 || atomic_number >= 104) return std::nullopt;
  return radius_of(gemmi::Element{static_cast<int>(atomic_number)});
}

}  // namespace kds
