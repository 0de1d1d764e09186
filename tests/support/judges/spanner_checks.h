#pragma once
// Checks a spanner by its definition, with numbers that are not the library's and all pairs of beads.

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "motions/base/bead.h"
#include "tests/support/judges/second_numbers.h"
#include "tests/support/text_of.h"

namespace kds::test {

/// Explains why a spanner does not meet its definition at one time, or returns nothing. `square(a, b)` is the
/// square of a distance, with lengths multiplied by `one`. `stretch` is what was asked for. Distances that
/// equal a limit pass either way.
template <class Spanner, class Square>
std::optional<std::string> not_a_spanner(const Spanner& spanner, const std::vector<BeadId>& present,
                                         double stretch, const second::Integer& one, Square square) {
  const auto value = [](double x) { return second::value(std::vector{x}, 0); };
  const auto limit = [&](double factor, BeadId level) {
    const second::Rational length =
        value(factor) * value(spanner.unit()) * (second::Integer(1) << level) * one;
    return second::Rational(length * length);
  };
  const auto distance = [&](BeadId a, BeadId b) {
    return std::sqrt(second::Rational(square(a, b), one * one).template convert_to<double>());
  };
  std::vector<BeadId> levels;
  std::size_t roots = 0;
  const auto centres = spanner.centres();
  if (centres.size() != present.size()) return "there are not as many centres as beads";
  for (std::size_t k = 0; k < present.size(); ++k) {
    const auto [bead, parent, level] = centres[k];
    if (bead != present[k]) return text_of("bead ", present[k], " is no centre");
    levels.push_back(level);
    if (parent == no_bead) {
      ++roots;
      continue;
    }
    const auto at = std::find(present.begin(), present.end(), parent) - present.begin();
    if (at == static_cast<std::ptrdiff_t>(present.size()) ||
        centres[static_cast<std::size_t>(at)].level <= level)
      return text_of("bead ", parent, " is no centre of the level above bead ", bead);
    if (square(bead, parent) > limit(1, level + 1))
      return text_of("bead ", parent, " does not cover its child ", bead);
  }
  if (roots != (present.empty() ? 0 : 1)) return text_of("there are ", roots, " roots");
  std::set<std::pair<BeadId, BeadId>> edges;
  for (const auto& edge : spanner.edges()) edges.emplace(edge.first, edge.second);
  const std::size_t n = present.size();
  std::vector<double> shortest(n * n, HUGE_VAL);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b) {
      const second::Rational d = square(present[a], present[b]);
      const BeadId common = std::min(levels[a], levels[b]);
      if (common > 0 && d < limit(1, common))
        return text_of("beads ", present[a], " and ", present[b], " are centres of level ", common,
                       ", but too near");
      const second::Rational reach = limit(spanner.reach(), common);
      const bool is_edge = edges.erase({present[a], present[b]}) > 0;
      if (d != reach && is_edge != (d < reach))
        return text_of("beads ", present[a], " and ", present[b],
                       is_edge ? " are too far for an edge" : " lack an edge");
      if (is_edge) shortest[a * n + b] = shortest[b * n + a] = distance(present[a], present[b]);
    }
  if (!edges.empty()) return "an edge has a bead that is not there";
  for (std::size_t via = 0; via < n; ++via)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b)
        shortest[a * n + b] = std::min(shortest[a * n + b], shortest[a * n + via] + shortest[via * n + b]);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b) {
      const double d = distance(present[a], present[b]);
      if (!(shortest[a * n + b] <= stretch * d * (1 + 1e-9)))
        return text_of("the path from bead ", present[a], " to ", present[b], " is too long");
    }
  return std::nullopt;
}

}  // namespace kds::test
