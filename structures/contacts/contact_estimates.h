#pragma once
// Estimates with 95% intervals of how often contacts begin and end.
//
// One pair: the pair is taken as memoryless, which means that it begins and ends contacts at constant rates.
//
// - Rate of n events in a time t: n / t, with the interval of a Poisson mean (Garwood 1936), from the 2.5%
//   quantile of the gamma distribution of shape n to the 97.5% quantile of shape n + 1, divided by t. Without
//   an event, the upper end is the one-sided 95% bound -log(0.05) / t.
// - Share of time in contact: the odds are the rate of beginning divided by the rate of end, and the ratio of
//   two times of several events has an F distribution. Written by quantiles of the beta distribution, as
//   those of Clopper and Pearson (1934): odds = on / off * x / (1 - x), where x runs from the 2.5% quantile
//   of Beta(begins, ends + 1) to the 97.5% quantile of Beta(begins + 1, ends).
//
// Several pairs: sum of a / sum of b over pairs has on the logarithmic scale the variance
// n / (n - 1) * sum of (a / A - b / B)^2, where A and B are the sums and n pairs are ever in contact. The
// variance is that of the linearized ratio, robust to any dependence within a pair. The interval takes
// Student's quantile with n - 1 degrees of freedom. Intervals of rates are at least as wide as that of one
// memoryless pair with the sums. That of the occupancy is the ratio's alone, because beginnings and ends may
// differ in a short run. Pairs are taken as independent and drawn from one population. For the same pairs in
// another run the interval is too wide.
//
// docs/findings.md has a table of how often these intervals contain the true value.

#include <cstdint>
#include <optional>

namespace kds {

/// An estimate with the ends of its 95% interval. A part that does not follow from the data is missing.
struct Estimate {
  std::optional<double> value = {}, lower = {}, upper = {};

  friend bool operator==(const Estimate&, const Estimate&) = default;
};

/// Returns 1 / x for a quantity x, 0 and larger. The inverse of 0 is missing.
[[nodiscard]] Estimate inverse_of(const Estimate& estimate);

/// Returns the value of `estimate`, with the lower of the two lower ends and the higher of the two upper
/// ones.
[[nodiscard]] Estimate widened(Estimate estimate, const Estimate& other);

/// Returns the rate of events in a time. All parts are missing if the time is 0.
[[nodiscard]] Estimate rate_of(std::uint64_t events, double time);

/// Returns the share of the time in contact of one pair. There is no interval if the pair is always or never
/// in contact, because the run then does not show how long the other state lasts.
[[nodiscard]] Estimate share_of(std::uint64_t begins, std::uint64_t ends, double on, double off);

/// Returns the 97.5% quantile of Student's t distribution. `freedom` is above 0.
[[nodiscard]] double student_quantile(double freedom);

/// The ratio of two sums over pairs.
class RatioOverPairs {
 public:
  /// Adds a pair that is ever in contact. Neither number is negative.
  void add(double above, double below) {
    ++pairs_;
    add_sums(above, below, 1);
  }
  /// Adds `times` pairs that are never in contact: 0 above, and this number below. They do not count as n.
  void add_apart(double below, double times) { add_sums(0, below, times); }

  /// Returns the ratio with its interval. The interval is missing if a sum is 0 or n is below 2.
  [[nodiscard]] Estimate ratio() const;

 private:
  void add_sums(double above, double below, double times);

  std::uint64_t pairs_ = 0;
  double above_ = 0, below_ = 0, above_squares_ = 0, products_ = 0, below_squares_ = 0;
};

}  // namespace kds
