#include "experiments/program/mean_interval.h"

#include <fmt/format.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "experiments/output/text.h"

namespace kds {

double student_95(double freedom) { return quantile(boost::math::students_t(freedom), 0.975); }

namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Returns the standard error of the mean of a series with mean 0, by the circular block bootstrap.
double block_error(std::span<const double> series, std::size_t block) {
  const std::size_t count = series.size();
  double sum = std::accumulate(series.begin(), series.begin() + static_cast<std::ptrdiff_t>(block), 0.0);
  double squares = 0;
  for (std::size_t first = 0; first < count; ++first) {
    squares += sum * sum;
    sum += series[(first + block) % count] - series[first];
  }
  const auto n = static_cast<double>(count), b = static_cast<double>(block);
  // The mean square of all block means is the variance of a block mean less that of the whole mean.
  return std::sqrt(squares / (b * b) / n * (b / n) / (1 - b / n));
}

}  // namespace

std::optional<MeanInterval> mean_of_independent(std::span<const double> values) {
  if (values.size() < 2) return std::nullopt;
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const auto count = static_cast<double>(values.size());
  const double error = student_95(count - 1) * std::sqrt(squares / (count - 1) / count);
  return MeanInterval{mean, mean - error, mean + error, values.size()};
}

std::optional<MeanInterval> above_zero(const std::optional<MeanInterval>& interval) {
  if (!interval || !(interval->mean > 0) || !(interval->lower < interval->upper)) return std::nullopt;
  const double mean = interval->mean, factor = std::exp((interval->upper - mean) / mean);
  if (!std::isfinite(mean * factor)) return std::nullopt;
  return MeanInterval{mean, mean / factor, mean * factor, interval->samples};
}

std::optional<MeanInterval> mean_over_time(std::span<const double> series) {
  if (series.size() < least_series) return std::nullopt;
  const double mean = mean_of(series);
  std::vector<double> centered(series.begin(), series.end());
  for (double& value : centered) value -= mean;
  constexpr std::size_t blocks = 5;
  const double error = student_95(blocks - 1) * block_error(centered, series.size() / blocks);
  return MeanInterval{mean, mean - error, mean + error, series.size()};
}

std::optional<MeanInterval> ratio_over_time(std::span<const double> above, std::span<const double> below) {
  const double sum = std::accumulate(below.begin(), below.end(), 0.0);
  if (above.size() != below.size() || above.size() < least_series || !(sum > 0)) return std::nullopt;
  const double ratio = std::accumulate(above.begin(), above.end(), 0.0) / sum;
  const double mean_below = sum / static_cast<double>(below.size());
  std::vector<double> linear;
  for (std::size_t k = 0; k < above.size(); ++k)
    linear.push_back(ratio + (above[k] - ratio * below[k]) / mean_below);
  return mean_over_time(linear);
}

std::string interval_text(const MeanInterval& mean) {
  return fmt::format("{} (95%: {} to {})", short_decimal(mean.mean), short_decimal(mean.lower),
                     short_decimal(mean.upper));
}

}  // namespace kds
