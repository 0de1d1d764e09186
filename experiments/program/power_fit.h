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
  std::size_t left_out = 0;  ///< points without a logarithm
  double exponent = 0, factor = 0;
  std::optional<double> error = {};  ///< the 95% interval is exponent +- error
};

/// Fits the law by least squares of the logarithms. Uses the points whose coordinates are both positive.
/// Returns nothing if fewer than three such points exist or if they share one x. The fit has no interval,
/// because points off the line do not tell errors of measurement from a law that is no power.
[[nodiscard]] std::optional<PowerFit> fit_power(std::span<const std::pair<double, double>> points);

/// Fits the same law and computes the interval by the jackknife. Each element of `without_a_share` has the
/// points as they are when one of several equal shares of the measurements is left out; the interval comes
/// from the exponents of these fits. Shares must be independent, such as conformations drawn anew, or blocks
/// of frames that are longer than the correlation time. The interval is for the exponent that the same fit
/// to the means of endless measurements has, at these x. It says how much the exponent varies when the
/// measurements are repeated, even if the points do not lie on a line or have unequal errors
/// (coverage_test.cpp). Returns nothing if one of the fits fails.
[[nodiscard]] std::optional<PowerFit> fit_power(
    std::span<const std::pair<double, double>> points,
    std::span<const std::vector<std::pair<double, double>>> without_a_share);

/// Returns "1.334 (95%: 1.331 to 1.337)", followed by the number of points left out if there are any.
[[nodiscard]] std::string exponent_text(const PowerFit& fit);

}  // namespace kds
