#pragma once
// Means with confidence intervals: of independent measurements, and of time series, whose values depend on
// the values before them.

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace kds {

/// Returns the 97.5% quantile of Student's t distribution: an interval of this many standard errors to either
/// side of an estimate has 95% confidence. `freedom` is the number of degrees of freedom, above 0.
[[nodiscard]] double student_95(double freedom);

/// A mean with its 95% confidence interval.
struct MeanInterval {
  double mean = 0, lower = 0, upper = 0;
  std::size_t samples = 0;
};

/// Means over inputs and tasks have an interval from this many values on. For two values Student's quantile
/// is 12.7, so that the interval of a count can reach a factor of exp(12.7), which is 330,000, to either
/// side. For three it is 4.3.
inline constexpr std::size_t least_pooled = 3;

/// Returns the mean of independent measurements, such as runs of several seeds, with Student's interval.
/// Returns nothing for fewer than two measurements.
[[nodiscard]] std::optional<MeanInterval> mean_of_independent(std::span<const double> values);

/// Returns the same mean with an interval above 0, for a quantity that is never negative, such as a count. An
/// interval of mean +- e becomes mean exp(-e / mean) to mean exp(e / mean). The new interval is symmetric for
/// the logarithm of the mean (delta method) and close to the given one if e is small. If the values are few
/// and skewed, its coverage is better. Together with mean_of_independent its coverage is 90 to 98% if the
/// standard deviation of the values is below their mean, and lower otherwise. Returns nothing in these cases:
/// - there is no interval, or an end of the new one is not finite;
/// - the mean is not above 0;
/// - the interval has no width (the spread of equal values is unknown).
[[nodiscard]] std::optional<MeanInterval> above_zero(const std::optional<MeanInterval>& interval);

/// The least number of values for which mean_over_time gives an interval.
inline constexpr std::size_t least_series = 50;

/// Returns the mean of a stationary time series, whose values may depend on the values before them. The
/// interval comes from 16 batch means (Conway, 1963) and an autoregressive process of order 1 through them,
/// whose correlation is corrected for its bias (Marriott and Pope, 1954). Student's quantile is that of the
/// number of independent batches, so the interval is very wide if the series is hardly longer than its
/// correlation time. Together with above_zero the coverage is 90 to 98% for the series in coverage_test.cpp,
/// if they are at least two correlation times long. The coverage is higher if values swing around the mean,
/// and lower if noise hides a motion that is as slow as the series is long. A series that drifts has no such
/// mean. Returns nothing for fewer than `least_series` values. O(n) time.
[[nodiscard]] std::optional<MeanInterval> mean_over_time(std::span<const double> series);

/// Returns sum(above) / sum(below) of two series over the same steps, with the interval of mean_over_time for
/// the linearized ratio. Returns nothing if mean_over_time does or if sum(below) is not positive.
[[nodiscard]] std::optional<MeanInterval> ratio_over_time(std::span<const double> above,
                                                          std::span<const double> below);

/// Returns "8.333 (95%: 7.9 to 8.8)".
[[nodiscard]] std::string interval_text(const MeanInterval& mean);

}  // namespace kds
