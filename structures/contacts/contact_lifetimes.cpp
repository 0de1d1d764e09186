#include "structures/contacts/contact_lifetimes.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace kds {

namespace {

/// Sums the squares of the residuals r of pairs (contact_lifetimes.h) while contacts end.
class PairResiduals {
 public:
  explicit PairResiduals(std::size_t pairs) : pairs_(pairs) {}

  void add_contact(std::uint32_t pair) {
    change(pair, 0, 1);
    contacts_ += 1;
    pair_count_ = contacts_ * contacts_ / risks_;
  }
  /// Moves to the next length at which contacts end. G grows there by `by`.
  void grow(double by) { growth_ += by; }
  /// Takes a contact of this length from those at risk. `drop` is 1 / (Y - d), or 0 if it is censored.
  void leave(std::uint32_t pair, double drop) { change(pair, growth_ - drop, -1); }

  /// Returns n.
  [[nodiscard]] double count() const { return pair_count_ > 1 ? pair_count_ : contacts_; }
  [[nodiscard]] double variance() const {
    const double squares = pair_count_ > 1 ? left_ + growth_ * (2 * products_ + growth_ * risks_) : growth_;
    return std::max(0.0, squares) * count() / (count() - 1);
  }

 private:
  struct Pair {
    double left = 0, at_risk = 0;  // the sum of r over contacts that are no longer at risk; number of others
  };
  void change(std::uint32_t pair, double left, double at_risk) {
    Pair& p = pairs_[pair];
    const Pair old = p;
    p = {old.left + left, old.at_risk + at_risk};
    left_ += p.left * p.left - old.left * old.left;
    products_ += p.left * p.at_risk - old.left * old.at_risk;
    risks_ += p.at_risk * p.at_risk - old.at_risk * old.at_risk;
  }

  std::vector<Pair> pairs_;
  double pair_count_ = 0, contacts_ = 0, growth_ = 0;
  // Sums over the pairs: left^2, left times at_risk, and at_risk^2.
  double left_ = 0, products_ = 0, risks_ = 0;
};

Estimate with_band(double survival, double variance, double quantile) {
  if (!(survival > 0 && survival < 1)) return {survival};
  const double width = quantile * std::sqrt(variance) / std::log(survival);  // negative
  return {survival, std::pow(survival, std::exp(-width)), std::pow(survival, std::exp(width))};
}

}  // namespace

void ContactLifetimes::add(const ContactInterval& interval) {
  const std::uint64_t key = (std::uint64_t{interval.first} << 32U) | interval.second;
  const double length = interval.length();
  const auto [at, is_new] = pairs_.try_emplace(key);
  PairLifetimes& pair = at->second.figures;
  if (is_new) {
    at->second.index = static_cast<std::uint32_t>(pairs_.size() - 1);
    pair.first = interval.first;
    pair.second = interval.second;
    pair.first_begin = interval.begin;
  }
  pair.last_end = interval.end;
  ++pair.contacts;
  pair.open_at_start += interval.open_at_start ? 1 : 0;
  pair.open_at_end += interval.open_at_end ? 1 : 0;
  pair.open_at_both += interval.open_at_start && interval.open_at_end ? 1 : 0;
  pair.total += length;
  pair.longest = std::max(pair.longest, length);
  if (!interval.open_at_start) lives_.push_back({length, at->second.index, interval.open_at_end});
  largest_reading_ =
      std::max({largest_reading_, std::abs(interval.begin.clock.begin), std::abs(interval.end.clock.end)});
}

std::vector<PairLifetimes> ContactLifetimes::pairs(double run_length) const {
  std::vector<PairLifetimes> pairs;
  for (const auto& [key, of_pair] : pairs_) {
    PairLifetimes& pair = pairs.emplace_back(of_pair.figures);
    pair.run_length = run_length;
    pair.occupancy = share_of(pair.begins(), pair.ends(), pair.total, pair.apart());
    pair.begin_rate = rate_of(pair.begins(), pair.apart());
    pair.end_rate = rate_of(pair.ends(), pair.total);
    pair.residence = inverse_of(pair.end_rate);
  }
  return pairs;
}

LifetimeFigures ContactLifetimes::all(double run_length, std::uint64_t asked) const {
  LifetimeFigures all;
  RatioOverPairs odds, begins, ends;
  for (const auto& [key, of_pair] : pairs_) {
    LifetimeFigures pair = of_pair.figures;
    pair.run_length = run_length;
    all.contacts += pair.contacts;
    all.open_at_start += pair.open_at_start;
    all.open_at_end += pair.open_at_end;
    all.open_at_both += pair.open_at_both;
    all.total += pair.total;
    all.longest = std::max(all.longest, pair.longest);
    odds.add(pair.total, pair.apart());
    begins.add(static_cast<double>(pair.begins()), pair.apart());
    ends.add(static_cast<double>(pair.ends()), pair.total);
  }
  const double never = static_cast<double>(asked) - static_cast<double>(pairs_.size());
  odds.add_apart(run_length, never);
  begins.add_apart(run_length, never);
  all.run_length = run_length * static_cast<double>(asked);
  all.occupancy = share_of(all.begins(), all.ends(), all.total, all.apart());
  if (const Estimate ratio = odds.ratio(); ratio.lower) {
    all.occupancy.lower = *ratio.lower / (1 + *ratio.lower);
    all.occupancy.upper = *ratio.upper / (1 + *ratio.upper);
  }
  all.begin_rate = widened(rate_of(all.begins(), all.apart()), begins.ratio());
  all.end_rate = widened(rate_of(all.ends(), all.total), ends.ratio());
  all.residence = inverse_of(all.end_rate);
  return all;
}

Survival ContactLifetimes::survival(double least_drop) const {
  Survival result;
  std::vector<Life> lives = lives_;
  std::sort(lives.begin(), lives.end(), [](const Life& a, const Life& b) { return a.length < b.length; });
  result.contacts = lives.size();
  for (const auto& [key, pair] : pairs_) result.left_out += pair.figures.open_at_start;
  PairResiduals residuals(pairs_.size());
  for (const Life& life : lives) residuals.add_contact(life.pair);
  const double quantile = residuals.count() > 1 ? student_quantile(residuals.count() - 1) : 0;
  double survival = 1, kept = 1;
  for (auto first = lives.begin(), last = first; first != lives.end(); first = last) {
    const double end = first->length + 1e-12 * largest_reading_;
    SurvivalPoint point{first->length, static_cast<std::uint64_t>(lives.end() - first)};
    for (; last != lives.end() && last->length <= end; ++last)
      ++(last->is_censored ? point.censored : point.ended);
    // The order within a step must not depend on last digits, so that sums do not.
    std::sort(first, last, [](const Life& a, const Life& b) {
      return std::tie(a.pair, a.is_censored) < std::tie(b.pair, b.is_censored);
    });
    const auto n = static_cast<double>(point.at_risk), d = static_cast<double>(point.ended);
    survival = point.ended == point.at_risk ? 0 : survival * (1 - d / n);
    point.survival = {survival};
    if (survival > 0) {
      residuals.grow(d / (n * (n - d)));
      for (auto life = first; life != last; ++life)
        residuals.leave(life->pair, life->is_censored ? 0 : 1 / (n - d));
      point.survival = with_band(survival, residuals.variance(), quantile);
    }
    const auto meet = [&](std::optional<double>& length, const std::optional<double>& at) {
      if (!length && at && *at <= 0.5) length = point.length;
    };
    meet(result.median.value, point.survival.value);
    meet(result.median.lower, point.survival.lower);
    meet(result.median.upper, point.survival.upper);
    const bool is_last = last == lives.end();
    if (!is_last && !(point.ended > 0 && kept - survival >= least_drop)) continue;
    result.points.push_back(point);
    kept = survival;
  }
  return result;
}

}  // namespace kds
