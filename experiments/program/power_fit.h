#pragma once
// A power law fitted to measurements: by which exponent one quantity grows with another.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace kds {

/// y = factor x^exponent.
struct PowerFit {
  std::size_t points = 0;
  std::size_t left_out = 0;                   ///< points that have no logarithm
  double exponent = 0, lower = 0, upper = 0;  ///< at 95 percent, errors of log y taken to be normal
  double factor = 0;
};

/// By least squares of logarithms, of the points both of whose coordinates are above 0. None where these are
/// fewer than three, or have one x only.
[[nodiscard]] std::optional<PowerFit> fit_power(std::span<const std::pair<double, double>> points);

/// The same line, its interval by jackknife: from the exponents of the points as they are without one of
/// several equal shares of the measurements. It tells how the exponent wanders when these are repeated, also
/// where points are no lines or not equally sure. None where one of the lines is none.
[[nodiscard]] std::optional<PowerFit> fit_power(
    std::span<const std::pair<double, double>> points,
    std::span<const std::vector<std::pair<double, double>>> without_a_share);

/// "1.334 (95%: 1.331 to 1.337)", and how many points were left out if any.
[[nodiscard]] std::string exponent_text(const PowerFit& fit);

}  // namespace kds
