#include "experiments/program/mean_interval.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "experiments/output/text.h"
#include "structures/contacts/contact_estimates.h"

namespace kds {

double student_95(double freedom) { return student_quantile(freedom); }

namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
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
  constexpr std::size_t batches = 16;
  constexpr double count = batches, most_correlated = 0.999;
  const double mean = mean_of(series);
  double before = 0, squares = 0, products = 0;
  for (std::size_t b = 0; b < batches; ++b) {
    const std::size_t first = b * series.size() / batches, end = (b + 1) * series.size() / batches;
    const double off = mean_of(series.subspan(first, end - first)) - mean;
    squares += off * off;
    products += off * before;
    before = off;
  }
  const double found = squares > 0 ? products / squares : 0;
  const double correlation = std::clamp(found + (1 + 4 * found) / count, 0.0, most_correlated);
  const double in_one = (1 + correlation) / (1 - correlation);  // batches worth an independent one
  const double variance = squares / (count - std::min(in_one, count - 1));
  const double freedom = std::max(count / in_one - 1, 1.0);
  const double error = student_95(freedom) * std::sqrt(variance * in_one / count);
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
