#include "motions/readers/vdw_radii.h"

#include <cctype>
#include <cmath>
#include <gemmi/elem.hpp>
#include <string>

namespace kds {

namespace {

std::optional<double> radius_of(gemmi::Element element) {
  // The table holds placeholders from rutherfordium on.
  if (element == gemmi::El::X || (element.ordinal() >= 104 && element != gemmi::El::D)) return std::nullopt;
  // The table stores floats, so round to the two decimals of its source.
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
