#include "experiments/theorems/theorem_series.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "experiments/theorems/root_ratio.h"

namespace kds {

std::string_view quantity_of(Theorem theorem) {
  switch (theorem) {
    case Theorem::tightness:
      return "layered / wrapped radius of the root";
    case Theorem::family:
      return "pairs in the separating family";
    case Theorem::search:
      return "seconds of the search";
    case Theorem::closest_pair:
      return "pairs looked at";
  }
  return "";
}

std::optional<PowerFit> TheoremSeries::fit() const {
  const bool per_level = dimension == 2 && (theorem == Theorem::family || theorem == Theorem::search);
  std::vector<std::pair<double, double>> logarithmic;
  for (const TheoremPoint& point : points) {
    const auto n = static_cast<double>(point.beads);
    const double x = theorem == Theorem::tightness ? static_cast<double>(tree_height(point.beads)) : n;
    logarithmic.emplace_back(x, per_level ? point.value / std::log2(n) : point.value);
  }
  return fit_power(logarithmic);
}

std::string name_of(const TheoremSeries& series) {
  return fmt::format("{} in {}{}{}", series.model, series.dimension == 2 ? "the plane" : "space",
                     series.hierarchy.empty() ? "" : ", ", series.hierarchy);
}

}  // namespace kds
