#include "experiments/program/timing.h"

#include <fmt/format.h>

#include "experiments/output/text.h"

namespace kds {

std::string spread_text(const Spread& spread) {
  if (spread.least == spread.most) return short_decimal(spread.median);
  return fmt::format("{} ({} to {})", short_decimal(spread.median), short_decimal(spread.least),
                     short_decimal(spread.most));
}

std::vector<std::vector<double>> seconds_in_turn(std::size_t rounds,
                                                 const std::vector<std::function<double()>>& works) {
  constexpr double enough = 1;
  std::vector<std::vector<double>> seconds(works.size());
  for (std::size_t round = 0; round < rounds; ++round)
    for (std::size_t w = 0; w < works.size(); ++w)
      if (round == 0 || seconds[w].front() <= enough) seconds[w].push_back(works[w]());
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
