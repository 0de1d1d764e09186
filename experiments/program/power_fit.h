#pragma once
// A power law fitted to measurements: by which exponent one quantity grows with another.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace kds {

/// y = factor x^exponent.
struct PowerFit {
  std::size_t points = 0;
  double exponent = 0, lower = 0, upper = 0;  ///< at 95 percent, errors of log y taken to be normal
  double factor = 0;
};

/// By least squares of logarithms, of the points both of whose coordinates are above 0. None where these are
/// fewer than three, or have one x only.
[[nodiscard]] std::optional<PowerFit> fit_power(std::span<const std::pair<double, double>> points);

/// "1.334 (95%: 1.331 to 1.337)".
[[nodiscard]] std::string exponent_text(const PowerFit& fit);

}  // namespace kds
