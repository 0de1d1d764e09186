#include "experiments/program/growth_fit.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace kds {

namespace {

double value_of(const GrowthTerm& term, double x) {
  return std::pow(x, term.power) * (term.logarithm ? std::log2(x) : 1);
}

struct WeightedFit {
  Eigen::VectorXd coefficients;
  double squares = 0;  // of the relative residuals
};

// Minimizes the sum of (sum of coefficients * terms / y - 1)^2. Columns are scaled, so that terms of
// different size do not lose digits.
WeightedFit weighted_fit(const GrowthPoints& points, const std::vector<GrowthTerm>& terms) {
  const auto rows = static_cast<Eigen::Index>(points.size()),
             columns = static_cast<Eigen::Index>(terms.size());
  Eigen::MatrixXd shares(rows, columns);
  for (Eigen::Index r = 0; r < rows; ++r)
    for (Eigen::Index c = 0; c < columns; ++c)
      shares(r, c) = value_of(terms[static_cast<std::size_t>(c)], points[static_cast<std::size_t>(r)].first) /
                     points[static_cast<std::size_t>(r)].second;
  const Eigen::VectorXd scales = shares.colwise().norm();
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(rows);
  const Eigen::MatrixXd scaled = shares * scales.cwiseInverse().asDiagonal();
  const Eigen::VectorXd solution = scaled.colPivHouseholderQr().solve(ones);
  return {scales.cwiseInverse().asDiagonal() * solution, (scaled * solution - ones).squaredNorm()};
}

bool usable(const GrowthPoints& points) {
  return std::ranges::all_of(points, [](const auto& point) {
    return point.first > 0 && point.second > 0 && std::isfinite(point.second);
  });
}

}  // namespace

double GrowthFit::at(double x) const {
  double sum = 0;
  for (std::size_t k = 0; k < terms.size(); ++k) sum += coefficients[k] * value_of(terms[k], x);
  return sum;
}

std::optional<GrowthFit> fit_growth(const GrowthPoints& points, const std::vector<GrowthTerm>& terms) {
  const GrowthPoints sizes = one_per_size(points);
  const std::size_t parameters = terms.size() + 1;  // the coefficients, and the size of the residuals
  if (!usable(sizes) || sizes.size() < parameters + 2) return std::nullopt;
  const WeightedFit found = weighted_fit(sizes, terms);
  GrowthFit fit;
  fit.terms = terms;
  fit.coefficients = {found.coefficients.begin(), found.coefficients.end()};
  fit.points = sizes.size();
  if (!(fit.coefficients.front() > 0)) return std::nullopt;
  for (const auto& [x, y] : sizes) {
    const double fitted = fit.at(x);
    if (!(fitted > 0)) return std::nullopt;
    fit.residual_most = std::max(fit.residual_most, std::abs(y / fitted - 1));
  }
  constexpr double rounding = 1e-24;  // squared residuals below are rounding errors
  const auto n = static_cast<double>(sizes.size()), k = static_cast<double>(parameters);
  fit.criterion = n * std::log(std::max(found.squares / n, rounding)) + 2 * k + 2 * k * (k + 1) / (n - k - 1);
  GrowthFit without_last = fit;
  const WeightedFit others = weighted_fit({sizes.begin(), sizes.end() - 1}, terms);
  without_last.coefficients = {others.coefficients.begin(), others.coefficients.end()};
  fit.prediction_error = without_last.at(sizes.back().first) / sizes.back().second - 1;
  return fit;
}

std::optional<GrowthFit> best_growth(const GrowthPoints& points,
                                     std::span<const std::vector<GrowthTerm>> forms) {
  std::optional<GrowthFit> best;
  for (const auto& form : forms)
    if (auto fit = fit_growth(points, form); fit && (!best || fit->criterion < best->criterion))
      best = std::move(fit);
  return best;
}

std::span<const std::vector<GrowthTerm>> usual_forms() {
  static const std::vector<std::vector<GrowthTerm>> forms{
      {{0}},
      {{0, true}},
      {{0, true}, {0}},
      {{1}},
      {{1}, {0}},
      {{1, true}},
      {{1, true}, {1}},
      {{4.0 / 3}},
      {{4.0 / 3}, {1}},
      {{2}},
      {{2}, {1}},
  };
  return forms;
}

std::optional<double> growth_exponent(const GrowthPoints& points, GrowthTerm leading,
                                      const std::vector<GrowthTerm>& lower) {
  constexpr double most = 2;  // above the power of the lower-order term
  constexpr int steps = 400;
  const GrowthPoints sizes = one_per_size(points);
  if (!usable(sizes) || sizes.size() < lower.size() + 4) return std::nullopt;
  std::vector<GrowthTerm> terms{leading};
  terms.insert(terms.end(), lower.begin(), lower.end());
  const auto squares = [&](double power) {
    terms.front().power = power;
    return weighted_fit(sizes, terms).squares;
  };
  // Two terms of one power are told apart by the logarithm, otherwise only by a slightly larger power.
  const double from = lower.front().power + (leading.logarithm != lower.front().logarithm ? 0 : 1e-6);
  const auto power_at = [&](int step) { return from + most * step / steps; };
  int best = 0;
  double least = squares(power_at(0));
  for (int step = 1; step <= steps; ++step)
    if (const double found = squares(power_at(step)); found < least) {
      least = found;
      best = step;
    }
  // Narrows the minimum by golden section between the neighbours of the best step.
  double low = power_at(std::max(best - 1, 0)), high = power_at(std::min(best + 1, steps));
  const double section = (std::sqrt(5.0) - 1) / 2;
  while (high - low > 1e-10) {
    const double a = high - section * (high - low), b = low + section * (high - low);
    (squares(a) < squares(b) ? high : low) = squares(a) < squares(b) ? b : a;
  }
  return (low + high) / 2;
}

GrowthPoints one_per_size(GrowthPoints points) {
  std::ranges::sort(points);
  GrowthPoints sizes;
  for (std::size_t first = 0, end = 0; first < points.size(); first = end) {
    double sum = 0;
    for (end = first; end < points.size() && points[end].first == points[first].first; ++end)
      sum += points[end].second;
    sizes.emplace_back(points[first].first, sum / static_cast<double>(end - first));
  }
  return sizes;
}

std::vector<double> local_exponents(const GrowthPoints& points) {
  const GrowthPoints sizes = one_per_size(points);
  std::vector<double> exponents;
  if (!usable(sizes)) return exponents;
  for (std::size_t k = 1; k < sizes.size(); ++k)
    exponents.push_back(std::log(sizes[k].second / sizes[k - 1].second) /
                        std::log(sizes[k].first / sizes[k - 1].first));
  return exponents;
}

std::string growth_text(const GrowthFit& fit, std::string_view variable) {
  constexpr double third = 1.0 / 3;
  std::string text;
  for (std::size_t k = 0; k < fit.terms.size(); ++k) {
    const auto [power, logarithm] = fit.terms[k];
    const double coefficient = fit.coefficients[k];
    if (text.empty())
      text = fmt::format("{:.4g}", coefficient);
    else
      text += fmt::format(" {} {:.4g}", coefficient < 0 ? "-" : "+", std::abs(coefficient));
    const double thirds = power / third;
    if (power == 1)
      text += fmt::format(" {}", variable);
    else if (power != 0 && std::abs(thirds - std::round(thirds)) < 1e-9 && power != std::round(power))
      text += fmt::format(" {}^({}/3)", variable, std::lround(thirds));
    else if (power != 0)
      text += fmt::format(" {}^{}", variable, power);
    if (logarithm) text += fmt::format(" log2 {}", variable);
  }
  return text;
}

}  // namespace kds
