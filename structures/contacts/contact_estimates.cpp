#include "structures/contacts/contact_estimates.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace kds {

Estimate inverse_of(const Estimate& estimate) {
  const auto inverse = [](const std::optional<double>& x) {
    return x && *x > 0 ? std::optional(1 / *x) : std::nullopt;
  };
  return {inverse(estimate.value), inverse(estimate.upper), inverse(estimate.lower)};
}

Estimate widened(Estimate estimate, const Estimate& other) {
  if (!estimate.lower || (other.lower && *other.lower < *estimate.lower)) estimate.lower = other.lower;
  if (!estimate.upper || (other.upper && *other.upper > *estimate.upper)) estimate.upper = other.upper;
  return estimate;
}

Estimate rate_of(std::uint64_t events, double time) {
  if (!(time > 0)) return {};
  if (events == 0) return {0.0, 0.0, -std::log(0.05) / time};
  const auto n = static_cast<double>(events);
  return {n / time, boost::math::gamma_p_inv(n, 0.025) / time, boost::math::gamma_p_inv(n + 1, 0.975) / time};
}

Estimate share_of(std::uint64_t begins, std::uint64_t ends, double on, double off) {
  if (!(on + off > 0)) return {};
  Estimate share{on / (on + off)};
  if (!(on > 0 && off > 0)) return share;
  const auto b = static_cast<double>(begins), e = static_cast<double>(ends);
  const auto at = [&](double x) { return on * x / (on * x + off * (1 - x)); };
  share.lower = begins == 0 ? 0 : at(boost::math::ibeta_inv(b, e + 1, 0.025));
  share.upper = ends == 0 ? 1 : at(boost::math::ibeta_inv(b + 1, e, 0.975));
  return share;
}

double student_quantile(double freedom) { return quantile(boost::math::students_t(freedom), 0.975); }

void RatioOverPairs::add_sums(double above, double below, double times) {
  above_ += times * above;
  below_ += times * below;
  above_squares_ += times * above * above;
  products_ += times * above * below;
  below_squares_ += times * below * below;
}

Estimate RatioOverPairs::ratio() const {
  if (!(below_ > 0)) return {};
  Estimate estimate{above_ / below_};
  if (!(above_ > 0) || pairs_ < 2) return estimate;
  const auto n = static_cast<double>(pairs_);
  const double squares = above_squares_ / (above_ * above_) - 2 * products_ / (above_ * below_) +
                         below_squares_ / (below_ * below_);
  const double width = student_quantile(n - 1) * std::sqrt(std::max(0.0, squares * n / (n - 1)));
  estimate.lower = *estimate.value * std::exp(-width);
  estimate.upper = *estimate.value * std::exp(width);
  return estimate;
}

}  // namespace kds
