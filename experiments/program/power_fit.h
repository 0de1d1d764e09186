#pragma once
// Fits a power law to measurements: the exponent says how one quantity grows with another.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace kds {

/// The law y = factor * x^exponent.
struct PowerFit {
  std::size_t points = 0;
  std::size_t left_out = 0;                   ///< points without a logarithm
  double exponent = 0, lower = 0, upper = 0;  ///< 95% interval, for normal errors of log y
  double factor = 0;
};

/// Fits the law by least squares of the logarithms. Uses the points whose coordinates are both positive.
/// Returns nothing if fewer than three such points exist or if they share one x.
[[nodiscard]] std::optional<PowerFit> fit_power(std::span<const std::pair<double, double>> points);

/// Fits the same law and computes the interval by the jackknife. Each element of `without_a_share` has the
/// points as they are when one of several equal shares of the measurements is left out; the interval comes
/// from the exponents of these fits. The interval says how much the exponent varies when the measurements are
/// repeated, even if the points do not lie on a line or have unequal errors. Returns nothing if one of the
/// fits fails.
[[nodiscard]] std::optional<PowerFit> fit_power(
    std::span<const std::pair<double, double>> points,
    std::span<const std::vector<std::pair<double, double>>> without_a_share);

/// Returns "1.334 (95%: 1.331 to 1.337)", followed by the number of points left out if there are any.
[[nodiscard]] std::string exponent_text(const PowerFit& fit);

}  // namespace kds
