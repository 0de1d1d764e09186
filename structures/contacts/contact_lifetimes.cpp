#include "structures/contacts/contact_lifetimes.h"

#include <algorithm>
#include <cmath>

namespace kds {

namespace {

/// Finds the median of `count` lengths that come in ascending order.
class RunningMedian {
 public:
  explicit RunningMedian(std::uint64_t count) : count_(count) {}
  void add(double length) {
    if (next_ == (count_ - 1) / 2) sum_ += 0.5 * length;
    if (next_ == count_ / 2) sum_ += 0.5 * length;
    ++next_;
  }
  [[nodiscard]] bool is_complete() const { return next_ == count_; }
  [[nodiscard]] double median() const { return sum_; }

 private:
  std::uint64_t count_, next_ = 0;
  double sum_ = 0;
};

void add_band(SurvivalPoint& point, double variance) {
  constexpr double quantile = 1.959963984540054;  // of the normal distribution, at 0.975
  if (point.survival <= 0) return;
  if (point.survival >= 1) {
    point.lower = point.upper = 1;
    return;
  }
  const double width = quantile * std::sqrt(variance) / std::log(point.survival);  // negative
  point.lower = std::pow(point.survival, std::exp(-width));
  point.upper = std::pow(point.survival, std::exp(width));
}

}  // namespace

void LivesInMemory::visit_sorted(const std::function<void(const ContactLife&)>& visit) {
  std::sort(lives_.begin(), lives_.end());
  for (const ContactLife& life : lives_) visit(life);
}

std::optional<double> LifetimeFigures::begin_rate() const {
  if (!(total < run_length)) return std::nullopt;
  return static_cast<double>(begins()) / (run_length - total);
}

std::optional<double> LifetimeFigures::end_rate() const {
  if (!(total > 0)) return std::nullopt;
  return static_cast<double>(ends()) / total;
}

std::optional<double> LifetimeFigures::residence() const {
  if (ends() == 0) return std::nullopt;
  return total / static_cast<double>(ends());
}

void ContactLifetimes::add(const ContactInterval& interval) {
  const std::uint64_t key = (std::uint64_t{interval.first} << 32U) | interval.second;
  const double length = interval.length();
  PairLifetimes& pair = pairs_[key];
  if (pair.contacts == 0) {
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
  const bool is_censored = interval.open_at_start || interval.open_at_end;
  by_pair_->add({key, length, is_censored});
  of_all_->add({0, length, is_censored});
}

void ContactLifetimes::visit_pairs(double run_length,
                                   const std::function<void(const PairLifetimes&)>& visit) const {
  auto at = pairs_.begin();
  std::optional<RunningMedian> middle;
  by_pair_->visit_sorted([&](const ContactLife& life) {
    if (!middle) middle.emplace(at->second.contacts);
    middle->add(life.length);
    if (!middle->is_complete()) return;
    PairLifetimes pair = at->second;
    pair.run_length = run_length;
    pair.median = middle->median();
    visit(pair);
    middle.reset();
    ++at;
  });
}

LifetimeFigures ContactLifetimes::all(double run_length) const {
  LifetimeFigures sum;
  for (const auto& [key, pair] : pairs_) {
    sum.contacts += pair.contacts;
    sum.open_at_start += pair.open_at_start;
    sum.open_at_end += pair.open_at_end;
    sum.open_at_both += pair.open_at_both;
    sum.total += pair.total;
    sum.longest = std::max(sum.longest, pair.longest);
    sum.run_length += run_length;
  }
  if (sum.contacts == 0) return sum;
  RunningMedian middle(sum.contacts);
  of_all_->visit_sorted([&](const ContactLife& life) { middle.add(life.length); });
  sum.median = middle.median();
  return sum;
}

std::vector<SurvivalPoint> ContactLifetimes::survival(double least_drop) const {
  std::uint64_t at_risk = 0;
  for (const auto& [key, pair] : pairs_) at_risk += pair.contacts;
  std::vector<SurvivalPoint> points;
  std::optional<SurvivalPoint> now;  // the length that is being counted
  double survival = 1, variance = 0, kept = 1;
  bool is_kept = true;
  const auto complete = [&] {
    const auto n = static_cast<double>(now->at_risk), d = static_cast<double>(now->ended);
    if (now->ended > 0) {
      survival = now->ended == now->at_risk ? 0 : survival * (1 - d / n);
      variance += d / (n * (n - d));
    }
    now->survival = survival;
    add_band(*now, variance);
    at_risk -= now->ended + now->censored;
    is_kept = now->ended > 0 && kept - survival >= least_drop;
    if (!is_kept) return;
    points.push_back(*now);
    kept = survival;
  };
  of_all_->visit_sorted([&](const ContactLife& life) {
    if (now && now->length != life.length) {
      complete();
      now.reset();
    }
    if (!now) now = SurvivalPoint{life.length, at_risk};
    ++(life.is_censored ? now->censored : now->ended);
  });
  if (now) complete();
  if (now && !is_kept) points.push_back(*now);
  return points;
}

}  // namespace kds
