#include "experiments/program/power_fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "experiments/program/mean_interval.h"

namespace kds {

std::optional<PowerFit> fit_power(std::span<const std::pair<double, double>> points) {
  std::vector<std::pair<double, double>> logs;
  for (const auto& [x, y] : points)
    if (x > 0 && y > 0) logs.emplace_back(std::log2(x), std::log2(y));
  if (logs.size() < 3) return std::nullopt;
  const auto count = static_cast<double>(logs.size());
  double mean_x = 0, mean_y = 0, spread = 0, together = 0;
  for (const auto& [x, y] : logs) {
    mean_x += x / count;
    mean_y += y / count;
  }
  for (const auto& [x, y] : logs) {
    spread += (x - mean_x) * (x - mean_x);
    together += (x - mean_x) * (y - mean_y);
  }
  if (!(spread > 0)) return std::nullopt;
  const double slope = together / spread;
  return PowerFit{logs.size(), points.size() - logs.size(), slope, std::exp2(mean_y - slope * mean_x)};
}

std::optional<PowerFit> fit_power(std::span<const std::pair<double, double>> points,
                                  std::span<const std::vector<std::pair<double, double>>> without_a_share) {
  auto fit = fit_power(points);
  const auto shares = static_cast<double>(without_a_share.size());
  if (!fit || without_a_share.size() < 2) return std::nullopt;
  std::vector<double> exponents;
  double mean = 0, squares = 0;
  for (const auto& rest : without_a_share) {
    const auto of_rest = fit_power(rest);
    if (!of_rest) return std::nullopt;
    exponents.push_back(of_rest->exponent);
    mean += of_rest->exponent / shares;
  }
  for (const double exponent : exponents) squares += (exponent - mean) * (exponent - mean);
  fit->error = student_95(shares - 1) * std::sqrt((shares - 1) / shares * squares);
  return fit;
}

std::string exponent_text(const PowerFit& fit) {
  std::vector<std::string> notes;
  if (fit.error)
    notes.push_back(
        fmt::format("95%: {:.3f} to {:.3f}", fit.exponent - *fit.error, fit.exponent + *fit.error));
  if (fit.left_out > 0)
    notes.push_back(
        fmt::format("{} of {} points are 0 and left out", fit.left_out, fit.points + fit.left_out));
  return fmt::format("{:.3f}{}", fit.exponent,
                     notes.empty() ? "" : fmt::format(" ({})", fmt::join(notes, "; ")));
}

}  // namespace kds
