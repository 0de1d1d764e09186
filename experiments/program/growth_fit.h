#pragma once
// Fits laws of growth to a quantity y that was measured at several sizes x: a leading term with a lower-order
// term, as in a x^(4/3) + b x. A power law alone is biased by the terms that it leaves out; power_fit.h fits
// it where no such term is known. No fit has an interval: residuals of sizes are no independent errors. They
// hold the terms that a form leaves out, families of grids oscillate with the side, and means over seeds have
// errors of their own, which the spread between seeds tells (mean_interval.h).

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kds {

using GrowthPoints = std::vector<std::pair<double, double>>;  ///< (x, y), both positive, in any order

/// The term x^power, or x^power log2 x.
struct GrowthTerm {
  double power = 1;
  bool logarithm = false;
};

/// y = sum of coefficients * terms, fitted by least squares of relative residuals.
struct GrowthFit {
  std::vector<GrowthTerm> terms;  ///< the leading term first
  std::vector<double> coefficients;
  std::size_t points = 0;
  double residual_most = 0;  ///< largest |y / fitted - 1|
  double criterion = 0;      ///< AICc of the relative residuals: the form with the least explains y best
  /// fitted / y - 1 for the largest size, if the form is fitted to the other sizes only.
  std::optional<double> prediction_error;

  [[nodiscard]] double at(double x) const;
};

/// Fits one form. Returns nothing unless there are at least three more sizes than terms, the leading
/// coefficient is positive and so are all fitted values.
[[nodiscard]] std::optional<GrowthFit> fit_growth(const GrowthPoints& points,
                                                  const std::vector<GrowthTerm>& terms);

/// Fits each form and returns the fit with the least AICc (Hurvich and Tsai, 1989), which weighs the
/// residuals against the number of coefficients. Returns nothing if no form can be fitted.
[[nodiscard]] std::optional<GrowthFit> best_growth(const GrowthPoints& points,
                                                   std::span<const std::vector<GrowthTerm>> forms);

/// The forms that are compared if no theorem names one: 1, log n, n, n log n, n^(4/3), n^2, each alone and
/// with the terms below it that can be told apart from it.
[[nodiscard]] std::span<const std::vector<GrowthTerm>> usual_forms();

/// Returns the exponent p of y = a x^p (log2 x)^l + b g(x) + ..., with lower-order terms g, by least squares
/// of relative residuals. `leading` tells whether the leading term has a logarithm; its power is ignored.
/// `lower` has at least one term, the highest first. The exponent is at least its power and at most two more.
/// Returns nothing unless there are at least four more sizes than lower-order terms.
[[nodiscard]] std::optional<double> growth_exponent(const GrowthPoints& points, GrowthTerm leading,
                                                    const std::vector<GrowthTerm>& lower);

/// Returns log(y2 / y1) / log(x2 / x1) for consecutive sizes, in ascending order of x. Points of one size are
/// replaced by their mean.
[[nodiscard]] std::vector<double> local_exponents(const GrowthPoints& points);

/// Returns the points in ascending order of x, with one point, the mean, for each x.
[[nodiscard]] GrowthPoints one_per_size(GrowthPoints points);

/// Returns a form such as "3.1 n^(4/3) + 5.2 n log2 n".
[[nodiscard]] std::string growth_text(const GrowthFit& fit, std::string_view variable = "n");

}  // namespace kds
