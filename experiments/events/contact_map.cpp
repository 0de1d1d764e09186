#include "experiments/events/contact_map.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/page/svg_plot.h"

namespace kds {

void ContactOccupancy::add(const Event& event, std::string_view kind) {
  const std::pair pair(event.change.ids[0], event.change.ids[1]);
  double& length = lengths_[pair];
  if (kind == "begin") open_[pair] = event.frame();
  if (kind != "end") return;
  const auto begin = open_.find(pair);
  length += event.frame() - begin->second;
  open_.erase(begin);
}

std::vector<PairOccupancy> ContactOccupancy::pairs(double first, double last) const {
  std::vector<PairOccupancy> result;
  for (const auto& [pair, ended] : lengths_) {
    const auto begin = open_.find(pair);
    const double length = ended + (begin == open_.end() ? 0 : last - begin->second);
    result.push_back({pair.first, pair.second, length / (last - first)});
  }
  return result;
}

std::string contact_map(const std::string& label, const std::vector<std::string>& names,
                        const std::vector<PairOccupancy>& pairs, std::size_t most_names) {
  constexpr std::size_t most_squares = 3000;
  std::map<std::pair<std::size_t, std::size_t>, const PairOccupancy*> squares;
  std::size_t block = 1 + (names.size() - 1) / most_names;
  for (;; block += std::max<std::size_t>(1, block / 4)) {
    squares.clear();
    for (const PairOccupancy& pair : pairs) {
      const PairOccupancy*& best = squares[{pair.first / block, pair.second / block}];
      if (best == nullptr || best->occupancy < pair.occupancy) best = &pair;
    }
    if (squares.size() <= most_squares) break;
  }
  constexpr std::size_t most_letters = 8;  // letters of a name beside a tick
  const bool are_short =
      std::ranges::all_of(names, [](const std::string& name) { return name.size() <= most_letters; });
  const auto side = static_cast<double>(block);
  MapPlot map{label, block == 1 ? "occupancy" : fmt::format("largest occupancy of {0} x {0}", block),
              -0.5,  static_cast<double>(names.size()) - 0.5,
              side,  {}};
  if (are_short)
    map.name_of = [&](std::size_t position) { return names[std::min(position, names.size() - 1)]; };
  for (const auto& [position, pair] : squares) {
    const auto middle = [&](std::size_t index) { return (static_cast<double>(index) + 0.5) * side - 0.5; };
    map.squares.push_back({middle(position.first), middle(position.second), pair->occupancy,
                           fmt::format("{} and {}", names[pair->first], names[pair->second])});
  }
  return svg_plot(map);
}

}  // namespace kds
