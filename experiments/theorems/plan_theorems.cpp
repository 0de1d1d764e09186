#include "experiments/theorems/plan_theorems.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "motions/models/model.h"
#include "motions/models/shapes.h"
#include "structures/collision/closest_pair.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"

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

namespace {

struct FamilySize {
  std::uint64_t family = 0;       ///< pairs of spheres
  std::optional<Spread> seconds;  ///< time of the search, without building the hierarchy
};

template <int Dimension>
double ratio(const Eigen::Matrix3Xd& centers, std::span<const double> radii) {
  const std::array necklaces{BeadRange{0, static_cast<BeadId>(radii.size() - 1)}};
  const Balls<Dimension> balls(centers, radii);
  StaticWrappedHierarchy<Dimension> wrapped(necklaces);
  LayeredHierarchy<Dimension> layered(necklaces);
  wrapped.build(balls);
  layered.build(balls);
  const double inner = wrapped.sphere(0).radius;
  return inner > 0 ? layered.sphere(0).radius / inner : 1;
}

template <int Dimension>
ClosestByDiagram measure(const Eigen::Matrix3Xd& centers, std::size_t rounds) {
  const auto beads = static_cast<std::size_t>(centers.cols());
  const std::vector<double> radii(beads, models::radius);
  const PairsAsked asked{{{0, static_cast<BeadId>(beads - 1)}}, true, 2, true};
  const BeadPairs neighbors = BeadPairs::along(beads, asked.necklaces);
  ClosestPairReport report;
  ClosestByDiagram result;
  result.seconds = repeated_seconds(
      rounds,
      [&] {
        return processor_seconds_of([&] { report = closest_pair<Dimension>(centers, radii, neighbors); });
      },
      std::numeric_limits<double>::infinity());
  const PairsLookedAt& pairs = report.looked_at;
  result.looked_at = pairs.edges + pairs.common_neighbors + pairs.unconnected + pairs.centers + pairs.near;

  const Balls<Dimension> balls(centers, radii);
  SphereTree<Dimension> tree(Hierarchy::wrapped, asked.necklaces);
  tree.build(balls);
  const auto by_search = find_closest_pair(tree, balls, asked);
  result.same = by_search && report.pair && by_search->first == report.pair->first &&
                by_search->second == report.pair->second;
  return result;
}

// Requires at least three beads of radius 1, of which consecutive beads meet and no others.
ClosestByDiagram closest_by_diagram(const Eigen::Matrix3Xd& centers, int dimension, std::size_t rounds) {
  return dimension == 2 ? measure<2>(centers, rounds) : measure<3>(centers, rounds);
}

template <int Dimension>
FamilySize measure(const Eigen::Matrix3Xd& centers, Hierarchy hierarchy, std::size_t rounds) {
  const auto beads = static_cast<std::size_t>(centers.cols());
  const Balls<Dimension> balls(centers, std::vector<double>(beads, models::radius));
  const PairsAsked asked{{{0, static_cast<BeadId>(beads - 1)}}, true, 2, true};
  SphereTree<Dimension> tree(hierarchy, asked.necklaces);
  tree.build(balls);
  FamilySize size;
  const auto search = [&] {
    return processor_seconds_of([&] { size.family = find_pairs(tree, asked).family; });
  };
  if (rounds == 0)
    search();
  else
    size.seconds = repeated_seconds(rounds, search, std::numeric_limits<double>::infinity());
  return size;
}

// Measures the family of beads with radius 1. No two beads may collide except neighbours along the chain. If
// `rounds` is 0, no time is measured.
FamilySize measure_family(const Eigen::Matrix3Xd& centers, int dimension, Hierarchy hierarchy,
                          std::size_t rounds) {
  return dimension == 2 ? measure<2>(centers, hierarchy, rounds) : measure<3>(centers, hierarchy, rounds);
}

// Returns n log2 n in the plane, n^(4/3) in space.
double family_bound(int dimension, std::size_t beads) {
  const auto n = static_cast<double>(beads);
  return dimension == 2 ? n * std::log2(n) : std::pow(n, 4.0 / 3);
}

using Centers = Eigen::Matrix3Xd;

// The smallest sizes for Theorem 2.3 and for random chains. Each further size is twice as large.
constexpr std::size_t kLeastOfRoots = 16, kLeastOfChains = 1024;

Centers random_chain(std::size_t beads, std::uint64_t seed) {
  const models::Settings settings{.beads = beads, .seed = seed, .motion = models::ShapeMotion::rest};
  return models::generate(*models::find_model("random-chain"), settings).front().frames.front();
}

// Moves the beads slightly, since in a regular grid all adjacent pairs are equally close. Consecutive beads
// still meet, and no others.
Centers jittered_grid(std::size_t beads, int dimension, double gap, std::uint64_t seed) {
  const double overlap = 0.05 * (1 - gap);
  const models::Settings settings{.beads = beads,
                                  .seed = seed,
                                  .motion = models::ShapeMotion::rest,
                                  .bond = 1 - overlap,
                                  .gap = gap,
                                  .dimension = dimension,
                                  .jitter = std::min(0.4 * gap, 0.9 * overlap)};
  return models::generate(*models::find_model("grid"), settings).front().frames.front();
}

class Planner {
 public:
  explicit Planner(const TheoremOptions& options) : options_(options) {}

  TheoremPlan plan() {
    if (asked(Theorem::tightness)) plan_tightness();
    if (asked(Theorem::family) || asked(Theorem::search)) plan_families();
    if (asked(Theorem::closest_pair)) plan_closest_pairs();
    return std::move(plan_);
  }

 private:
  [[nodiscard]] bool asked(Theorem theorem) const {
    return std::find(options_.theorems.begin(), options_.theorems.end(), theorem) != options_.theorems.end();
  }

  std::size_t add_series(Theorem theorem, std::string_view model, int dimension, std::string_view hierarchy,
                         std::optional<double> expected, std::size_t sizes) {
    plan_.series.push_back({theorem, std::string(model), dimension, std::string(hierarchy), expected, {}});
    plan_.sizes.push_back(sizes);
    return plan_.series.size() - 1;
  }

  // Returns the powers of two times `least`, up to `most` and the option's limit.
  [[nodiscard]] std::vector<std::size_t> powers_of_two(std::size_t least, std::size_t most) const {
    std::vector<std::size_t> sizes;
    for (std::size_t beads = least; beads <= std::min(most, options_.most_beads); beads *= 2)
      sizes.push_back(beads);
    return sizes;
  }

  using Made = std::function<Centers(std::size_t beads)>;

  void plan_tightness() {
    const auto add = [&](std::string_view model, int dimension, double radius, const Made& made,
                         std::optional<double> expected = std::nullopt) {
      const std::vector<std::size_t> sizes = powers_of_two(kLeastOfRoots, options_.most_beads);
      const std::size_t series = add_series(Theorem::tightness, model, dimension, "", expected, sizes.size());
      for (const std::size_t beads : sizes)
        plan_.work.emplace_back([=](std::vector<TheoremSeries>& all) {
          const double ratio = root_ratio(made(beads), std::vector<double>(beads, radius), dimension);
          const double bound = std::sqrt(static_cast<double>(tree_height(beads)) + 1);
          all[series].points.push_back({beads, ratio, bound, std::nullopt, ratio <= bound});
        });
    };
    add(
        "points of Lemma 2.5", 2, 0,
        [](std::size_t beads) { return models::tightness_points(static_cast<int>(tree_height(beads))); },
        0.5);
    for (const int dimension : {2, 3})
      add("grid", dimension, models::radius,
          [=, gap = options_.gap](std::size_t beads) { return models::packed_grid(beads, dimension, gap); });
    add("random chain", 3, models::radius,
        [seed = options_.seed](std::size_t beads) { return random_chain(beads, seed); });
  }

  // One search serves both theorems.
  void plan_families() {
    const auto add = [&](std::string_view model, int dimension, Hierarchy hierarchy,
                         const std::vector<std::size_t>& sizes, const Made& made) {
      const std::string_view name = hierarchy_names[static_cast<std::size_t>(hierarchy)];
      const double expected = dimension == 2 ? 1 : 4.0 / 3;
      std::vector<std::size_t> series;
      for (const Theorem theorem : {Theorem::family, Theorem::search})
        if (asked(theorem))
          series.push_back(add_series(theorem, model, dimension, name, expected, sizes.size()));
      for (const std::size_t beads : sizes)
        plan_.work.emplace_back(
            [=, rounds = asked(Theorem::search) ? options_.rounds : 0](std::vector<TheoremSeries>& all) {
              const FamilySize size = measure_family(made(beads), dimension, hierarchy, rounds);
              for (const std::size_t s : series) {
                const double value = all[s].theorem == Theorem::family ? static_cast<double>(size.family)
                                                                       : size.seconds->median;
                const auto bound = all[s].theorem == Theorem::family
                                       ? std::optional(family_bound(dimension, beads))
                                       : std::nullopt;  // a time has no bound without the constant
                all[s].points.push_back({beads, value, bound, size.seconds, std::nullopt});
              }
            });
    };
    for (const int dimension : {2, 3})
      for (const Hierarchy hierarchy : {Hierarchy::wrapped, Hierarchy::layered})
        add("grid", dimension, hierarchy, sizes_of_grids(dimension),
            [=, gap = options_.gap](std::size_t beads) {
              return models::packed_grid(beads, dimension, gap);
            });
    add("random chain", 3, Hierarchy::wrapped, powers_of_two(kLeastOfChains, options_.most_beads),
        [seed = options_.seed](std::size_t beads) { return random_chain(beads, seed); });
  }

  void plan_closest_pairs() {
    // A helix with a constant number of turns has a power diagram of quadratic size.
    constexpr std::size_t most_of_helix = 4096;
    const auto add = [&](std::string_view model, int dimension, std::optional<double> expected,
                         const std::vector<std::size_t>& sizes, const Made& made) {
      const std::size_t series =
          add_series(Theorem::closest_pair, model, dimension, "", expected, sizes.size());
      for (const std::size_t beads : sizes)
        plan_.work.emplace_back([=, rounds = options_.rounds](std::vector<TheoremSeries>& all) {
          const ClosestByDiagram closest = closest_by_diagram(made(beads), dimension, rounds);
          all[series].points.push_back(
              {beads, static_cast<double>(closest.looked_at), std::nullopt, closest.seconds, closest.same});
        });
    };
    for (const int dimension : {2, 3})
      add("grid", dimension, 1, sizes_of_grids(dimension),
          [dimension, gap = options_.gap, seed = options_.seed](std::size_t beads) {
            return jittered_grid(beads, dimension, gap, seed);
          });
    add("random chain", 3, 1, powers_of_two(kLeastOfChains, options_.most_beads),
        [seed = options_.seed](std::size_t beads) { return random_chain(beads, seed); });
    add("helix", 3, std::nullopt, powers_of_two(512, most_of_helix), [](std::size_t beads) {
      constexpr double turns = 10;
      return models::helix(beads, turns);
    });
  }

  [[nodiscard]] std::vector<std::size_t> sizes_of_grids(int dimension) const {
    std::vector<std::size_t> sizes;
    for (const std::size_t side : sides_of_grids(dimension, options_.most_beads))
      sizes.push_back(beads_of_grid(dimension, side));
    return sizes;
  }

  TheoremOptions options_;
  TheoremPlan plan_;
};

}  // namespace

double root_ratio(const Eigen::Matrix3Xd& centers, std::span<const double> radii, int dimension) {
  return dimension == 2 ? ratio<2>(centers, radii) : ratio<3>(centers, radii);
}

std::size_t tree_height(std::size_t beads) { return static_cast<std::size_t>(std::bit_width(beads - 1)); }

std::size_t beads_of_grid(int dimension, std::size_t side) {
  const std::size_t rows = dimension == 2 ? side : side * side;
  return rows * side + rows - 1;
}

std::vector<std::size_t> sides_of_grids(int dimension, std::size_t most_beads) {
  constexpr std::size_t least_beads = 1000;
  const double factor = dimension == 2 ? 1.34 : 1.22;  // n grows by a factor of about 1.8
  std::vector<std::size_t> sides;
  std::size_t side = 3;
  while (beads_of_grid(dimension, side + 2) <= most_beads) side += 2;
  for (auto next = static_cast<double>(side); beads_of_grid(dimension, side) >= least_beads;) {
    sides.push_back(side);
    next /= factor;
    side = std::min(side - 2, 2 * static_cast<std::size_t>(next / 2) + 1);
  }
  std::reverse(sides.begin(), sides.end());
  return sides;
}

TheoremPlan plan_theorems(const TheoremOptions& options) { return Planner(options).plan(); }

// The third random chain sets the limit: grids of three sizes have fewer beads.
std::size_t least_beads_for(const std::vector<Theorem>& theorems) {
  const bool roots_only =
      std::ranges::all_of(theorems, [](Theorem theorem) { return theorem == Theorem::tightness; });
  return 4 * (roots_only ? kLeastOfRoots : kLeastOfChains);
}

bool measures_time(const std::vector<Theorem>& theorems) {
  return std::ranges::any_of(theorems, [](Theorem theorem) {
    return theorem == Theorem::search || theorem == Theorem::closest_pair;
  });
}

}  // namespace kds
