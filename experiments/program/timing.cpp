#include "experiments/program/timing.h"

#include <fmt/format.h>

#include <utility>

#include "experiments/output/text.h"

namespace kds {

namespace {

class RepeatedWork {
 public:
  RepeatedWork(std::function<double()> work, double enough) : work_(std::move(work)) {
    constexpr double least = 1e-3;
    double once = work_();
    const bool is_short = once < least;
    if (is_short) once = work_();  // fills the caches
    calls_ = static_cast<std::size_t>(std::max(1.0, least / std::max(once, 1e-9)));
    if (!is_short) seconds_.push_back(once);
    only_once_ = once > enough;
  }

  [[nodiscard]] bool has(std::size_t rounds) const { return only_once_ || seconds_.size() >= rounds; }
  void do_round() {
    double sum = 0;
    for (std::size_t call = 0; call < calls_; ++call) sum += work_();
    seconds_.push_back(sum / static_cast<double>(calls_));
  }
  [[nodiscard]] const std::vector<double>& seconds() const { return seconds_; }

 private:
  std::function<double()> work_;
  std::size_t calls_ = 1;  // per round
  bool only_once_ = false;
  std::vector<double> seconds_;
};

}  // namespace

std::string spread_text(const Spread& spread) {
  if (spread.least == spread.most) return short_decimal(spread.median);
  return fmt::format("{} ({} to {})", short_decimal(spread.median), short_decimal(spread.least),
                     short_decimal(spread.most));
}

Spread repeated_seconds(std::size_t rounds, std::function<double()> work, double enough) {
  RepeatedWork repeated(std::move(work), enough);
  while (!repeated.has(rounds)) repeated.do_round();
  return spread_of(repeated.seconds());
}

std::vector<std::vector<double>> seconds_in_turn(std::size_t rounds,
                                                 std::vector<std::function<double()>> works) {
  constexpr double enough = 1;
  std::vector<RepeatedWork> repeated;
  for (std::function<double()>& work : works) repeated.emplace_back(std::move(work), enough);
  for (std::size_t round = 1; round <= rounds; ++round)
    for (RepeatedWork& work : repeated)
      if (!work.has(round)) work.do_round();
  std::vector<std::vector<double>> seconds;
  for (const RepeatedWork& work : repeated) seconds.push_back(work.seconds());
  return seconds;
}

Spread ratios_by_round(const std::vector<double>& seconds, const std::vector<double>& others) {
  const auto at = [](const std::vector<double>& of, std::size_t round) {
    return of[of.size() == 1 ? 0 : round];
  };
  std::vector<double> ratios;
  for (std::size_t round = 0; round < std::max(seconds.size(), others.size()); ++round)
    ratios.push_back(at(seconds, round) / at(others, round));
  return spread_of(ratios);
}

}  // namespace kds
