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

#include "experiments/theorems/interleaved_grids.h"
#include "motions/models/model.h"
#include "motions/models/shapes.h"
#include "structures/collision/closest_pair.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/collision/separating_families.h"
#include "structures/hierarchy/bead_orders.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/path_cages.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"

namespace kds {

std::string_view quantity_of(Theorem theorem) {
  switch (theorem) {
    case Theorem::paths:
      return "tests per node of a verification";
    case Theorem::tightness:
    case Theorem::groupings:
      return "layered / wrapped radius of the root";
    case Theorem::family:
    case Theorem::families:
    case Theorem::two_necklaces:
      return "pairs in the separating family";
    case Theorem::search:
      return "seconds of the search";
    case Theorem::closest_pair:
      return "pairs looked at";
  }
  return "";
}

bool TheoremSeries::is_ratio() const {
  return theorem == Theorem::tightness || theorem == Theorem::groupings;
}

bool TheoremSeries::has_logarithm() const {
  return dimension == 2 && (theorem == Theorem::family || theorem == Theorem::families ||
                            theorem == Theorem::search || theorem == Theorem::two_necklaces);
}

std::vector<GrowthTerm> TheoremSeries::lower_terms() const {
  switch (theorem) {
    case Theorem::tightness:
    case Theorem::groupings:
    case Theorem::paths:
      return {{0}};
    case Theorem::family:
    case Theorem::families:
    case Theorem::search:
    case Theorem::two_necklaces:
      return {{1}, {0}};
    case Theorem::closest_pair:
      return {{(dimension - 1.0) / dimension}};
  }
  return {};
}

GrowthPoints TheoremSeries::growth() const {
  GrowthPoints growth;
  for (const TheoremPoint& point : points)
    growth.emplace_back(static_cast<double>(is_ratio() ? tree_height(point.beads) : point.beads),
                        point.value);
  return growth;
}

std::optional<PowerFit> TheoremSeries::fit() const {
  GrowthPoints divided = growth();
  if (has_logarithm())
    for (auto& [x, y] : divided) y /= std::log2(x);
  return fit_power(divided);
}

std::optional<double> TheoremSeries::exponent() const {
  return growth_exponent(growth(), {1, has_logarithm()}, lower_terms());
}

std::optional<GrowthFit> TheoremSeries::law() const {
  std::vector<std::vector<GrowthTerm>> forms;
  if (expected) {
    forms.push_back({{*expected, has_logarithm()}});
    for (const GrowthTerm& lower : lower_terms()) {
      forms.push_back(forms.back());
      forms.back().push_back(lower);
    }
  }
  if (!expected || at_most) forms.insert(forms.end(), usual_forms().begin(), usual_forms().end());
  return best_growth(growth(), forms);
}

double TheoremSeries::predicted(const GrowthFit& law, std::size_t beads) const {
  return law.at(static_cast<double>(is_ratio() ? tree_height(beads) : beads));
}

std::string name_of(const TheoremSeries& series) {
  std::string name = fmt::format("{} in {}", series.model, series.dimension == 2 ? "the plane" : "space");
  for (const std::string& part : {series.hierarchy, series.variant})
    if (!part.empty()) name += ", " + part;
  return name;
}

namespace {

struct FamilySize {
  PairsFound found;
  std::optional<Spread> seconds;  ///< of the search, without building the hierarchy
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
        return processor_seconds_per_call(
            [&] { report = closest_pair<Dimension>(centers, radii, neighbors); });
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

// Searches the pairs asked about. If `rounds` is 0, no time is measured.
template <int Dimension>
FamilySize search_family(const SphereTree<Dimension>& tree, const PairsAsked& asked, std::size_t rounds) {
  FamilySize size;
  const auto search = [&] { size.found = find_pairs(tree, asked); };
  if (rounds == 0)
    search();
  else
    size.seconds = repeated_seconds(
        rounds, [&] { return processor_seconds_per_call(search); }, std::numeric_limits<double>::infinity());
  return size;
}

PairsAsked within_one_chain(std::size_t beads, BeadId apart) {
  return {{{0, static_cast<BeadId>(beads - 1)}}, true, apart, true};
}

template <int Dimension>
SphereTree<Dimension> tree_of_chain(const Eigen::Matrix3Xd& centers, Hierarchy hierarchy) {
  const auto beads = static_cast<std::size_t>(centers.cols());
  SphereTree<Dimension> tree(hierarchy, within_one_chain(beads, 2).necklaces);
  tree.build(Balls<Dimension>(centers, std::vector<double>(beads, models::radius)));
  return tree;
}

// Measures the family of beads with radius 1. No two beads may collide except neighbours along the chain.
FamilySize measure_family(const Eigen::Matrix3Xd& centers, int dimension, Hierarchy hierarchy,
                          std::size_t rounds) {
  const PairsAsked asked = within_one_chain(static_cast<std::size_t>(centers.cols()), 2);
  return dimension == 2 ? search_family(tree_of_chain<2>(centers, hierarchy), asked, rounds)
                        : search_family(tree_of_chain<3>(centers, hierarchy), asked, rounds);
}

// Measures the family between two chains without collisions.
template <int Dimension>
FamilySize measure_between(const TwoChains& chains, std::size_t rounds) {
  Eigen::Matrix3Xd centers(3, chains.first.cols() + chains.second.cols());
  centers << chains.first, chains.second;
  const auto first = static_cast<BeadId>(chains.first.cols()), beads = static_cast<BeadId>(centers.cols());
  const PairsAsked asked{{{0, first - 1}, {first, beads - 1}}, false, 2, true};
  SphereTree<Dimension> tree(Hierarchy::wrapped, asked.necklaces);
  tree.build(Balls<Dimension>(centers, std::vector<double>(beads, models::radius)));
  return search_family(tree, asked, rounds);
}

// Measures the cascade verification of the second of two frames, without and with path cages.
template <int Dimension>
std::array<TheoremPoint, 2> measure_paths(std::span<const Eigen::Matrix3Xd> frames, std::size_t rounds) {
  const auto beads = static_cast<std::size_t>(frames[0].cols());
  const std::vector<double> radii(beads, models::radius);
  const std::array necklaces{BeadRange{0, static_cast<BeadId>(beads - 1)}};
  const Balls<Dimension> before(frames[0], radii), after(frames[1], radii);
  StaticWrappedHierarchy<Dimension> trusted(necklaces), now(necklaces);
  trusted.build(before);
  now.build(after);
  trusted.update(after, Update::trust);
  std::array<TheoremPoint, 2> points;
  std::array<CascadeCost, 2> costs;
  for (const std::size_t with_paths : {0U, 1U}) {
    CascadeCost& cost = costs[with_paths];
    TheoremPoint& point = points[with_paths];
    point.seconds = repeated_seconds(
        rounds,
        [&] {
          return processor_seconds_per_call(
              [&] { cost = cascade_cost(trusted, now, after, with_paths == 1); });
        },
        std::numeric_limits<double>::infinity());
    point.beads = beads;
    point.tests = cost.tests + cost.path_tests;
    point.value = static_cast<double>(*point.tests) / static_cast<double>(beads - 1);
    point.holds = cost.escaped == costs[0].escaped;
  }
  return points;
}

// A family that is compared with others, and the hierarchy and search that give it.
struct FamilyVariant {
  std::string_view name;
  Hierarchy hierarchy;
  enum class Kind : std::uint8_t { smallest, search, written, by_space } kind;
  SearchRule rule = {};
};
// The first variant of each hierarchy is the smallest family.
constexpr std::array kFamilyVariants{
    FamilyVariant{"smallest", Hierarchy::wrapped, FamilyVariant::Kind::smallest},
    FamilyVariant{"found by the search", Hierarchy::wrapped, FamilyVariant::Kind::search},
    FamilyVariant{"explicit", Hierarchy::wrapped, FamilyVariant::Kind::written},
    FamilyVariant{
        "larger sphere split", Hierarchy::wrapped, FamilyVariant::Kind::search, {Split::larger_sphere, 1}},
    FamilyVariant{
        "first node split", Hierarchy::wrapped, FamilyVariant::Kind::search, {Split::first_node, 1}},
    FamilyVariant{
        "leaves of 2 beads", Hierarchy::wrapped, FamilyVariant::Kind::search, {Split::more_beads, 2}},
    FamilyVariant{
        "leaves of 8 beads", Hierarchy::wrapped, FamilyVariant::Kind::search, {Split::more_beads, 8}},
    FamilyVariant{"grouped by space", Hierarchy::wrapped, FamilyVariant::Kind::by_space},
    FamilyVariant{"smallest", Hierarchy::layered, FamilyVariant::Kind::smallest},
    FamilyVariant{"found by the search", Hierarchy::layered, FamilyVariant::Kind::search},
    FamilyVariant{"explicit", Hierarchy::layered, FamilyVariant::Kind::written},
};

// If beads are grouped by space, the tree's order is not the chain's. All pairs are then asked about, and the
// pairs of neighbours, which meet, are no pairs of the family.
template <int Dimension>
PairsFound compared_family(const Eigen::Matrix3Xd& centers, const FamilyVariant& variant) {
  using Kind = FamilyVariant::Kind;
  const PairsAsked asked =
      within_one_chain(static_cast<std::size_t>(centers.cols()), variant.kind == Kind::by_space ? 1 : 2);
  if (variant.kind == Kind::by_space)
    return find_pairs(tree_of_chain<Dimension>(in_order(centers, order_by_space(centers)), variant.hierarchy),
                      asked);
  const SphereTree<Dimension> tree = tree_of_chain<Dimension>(centers, variant.hierarchy);
  if (variant.kind == Kind::smallest) return smallest_family(tree, asked);
  if (variant.kind == Kind::search) return find_pairs(tree, asked, variant.rule);
  PairsFound written;
  written.family = explicit_family(tree, asked);
  return written;
}

// Returns n log2 n in the plane, n^(4/3) in space.
double family_bound(int dimension, std::size_t beads) {
  const auto n = static_cast<double>(beads);
  return dimension == 2 ? n * std::log2(n) : std::pow(n, 4.0 / 3);
}

using Centers = Eigen::Matrix3Xd;

// The smallest sizes for Theorem 2.3 and for random chains. Each further size is twice as large.
constexpr std::size_t kLeastOfRoots = 16, kLeastOfChains = 1024;
constexpr std::size_t kMostOfSmallest = 8192;
constexpr std::string_view kLemmaPoints = "points of Lemma 2.5";

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
    if (asked(Theorem::paths)) plan_paths();
    if (asked(Theorem::tightness)) plan_tightness();
    if (asked(Theorem::groupings)) plan_groupings();
    if (asked(Theorem::family) || asked(Theorem::search)) plan_families();
    if (asked(Theorem::families)) plan_compared_families();
    if (asked(Theorem::two_necklaces)) plan_two_necklaces();
    if (asked(Theorem::closest_pair)) plan_closest_pairs();
    return std::move(plan_);
  }

 private:
  [[nodiscard]] bool asked(Theorem theorem) const {
    return std::find(options_.theorems.begin(), options_.theorems.end(), theorem) != options_.theorems.end();
  }

  std::size_t add_series(Theorem theorem, std::string_view model, int dimension, std::string_view hierarchy,
                         std::optional<double> expected, std::size_t sizes, std::string_view variant = "",
                         bool at_most = false) {
    plan_.series.push_back({theorem,
                            std::string(model),
                            dimension,
                            std::string(hierarchy),
                            std::string(variant),
                            expected,
                            at_most,
                            {}});
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

  /// Makes a necklace of a random model. Other models ignore the seed.
  using Made = std::function<Centers(std::size_t beads, std::uint64_t seed)>;

  /// Returns the point whose value is the mean over the seeds. `measure_one` measures the necklace of a seed.
  template <class MeasureOne>
  [[nodiscard]] static TheoremPoint over_seeds(std::size_t beads, const std::vector<std::uint64_t>& seeds,
                                               const MeasureOne& measure_one) {
    TheoremPoint point = measure_one(beads, seeds.front());
    if (seeds.size() == 1) return point;
    std::vector<double> values{point.value};
    std::vector<Spread> seconds;
    if (point.seconds) seconds.push_back(*point.seconds);
    for (std::size_t s = 1; s < seeds.size(); ++s) {
      const TheoremPoint other = measure_one(beads, seeds[s]);
      values.push_back(other.value);
      if (other.seconds) seconds.push_back(*other.seconds);
      if (other.holds) point.holds = *other.holds && point.holds.value_or(true);
    }
    const auto mean = mean_of_independent(values);
    point.over_seeds = above_zero(mean);
    point.value = mean->mean;
    if (!seconds.empty()) point.seconds = pooled(seconds);
    return point;
  }
  /// Returns the mean of the medians, the least of all and the most of all.
  [[nodiscard]] static Spread pooled(const std::vector<Spread>& all) {
    Spread pooled{0, all.front().least, all.front().most};
    for (const Spread& one : all) {
      pooled.median += one.median / static_cast<double>(all.size());
      pooled.least = std::min(pooled.least, one.least);
      pooled.most = std::max(pooled.most, one.most);
    }
    return pooled;
  }
  [[nodiscard]] std::vector<std::uint64_t> seeds_of(bool is_random) const {
    std::vector<std::uint64_t> seeds;
    for (std::size_t s = 0; s < (is_random ? options_.seeds : 1); ++s) seeds.push_back(options_.seed + s);
    return seeds;
  }

  // Measures the ratio of the roots over all sizes.
  void add_ratios(Theorem theorem, std::string_view model, int dimension, std::string_view variant,
                  double radius, const Made& made, std::optional<double> expected = std::nullopt,
                  bool is_random = false) {
    const std::vector<std::size_t> sizes = powers_of_two(kLeastOfRoots, options_.most_beads);
    const std::size_t series = add_series(theorem, model, dimension, "", expected, sizes.size(), variant);
    for (const std::size_t beads : sizes)
      plan_.work.emplace_back([=, seeds = seeds_of(is_random)](std::vector<TheoremSeries>& all) {
        all[series].points.push_back(over_seeds(beads, seeds, [&](std::size_t n, std::uint64_t seed) {
          const double ratio = root_ratio(made(n, seed), std::vector<double>(n, radius), dimension);
          const double bound = std::sqrt(static_cast<double>(tree_height(n)) + 1);
          return TheoremPoint{n, ratio, bound, std::nullopt, ratio <= bound};
        }));
      });
  }

  void plan_paths() {
    const auto add = [&](std::string_view name, int dimension, std::string_view model,
                         models::Settings settings) {
      const std::vector<std::size_t> sizes = powers_of_two(kLeastOfChains, options_.most_beads);
      const std::size_t without =
          add_series(Theorem::paths, name, dimension, "", std::nullopt, sizes.size(), "cascade");
      add_series(Theorem::paths, name, dimension, "", std::nullopt, sizes.size(), "path cages");
      settings.frames = 2;
      settings.seed = options_.seed;
      for (const std::size_t beads : sizes)
        plan_.work.emplace_back([=, rounds = options_.rounds](std::vector<TheoremSeries>& all) {
          models::Settings sized = settings;
          sized.beads = beads;
          const auto frames = models::generate(*models::find_model(model), sized).front().frames;
          const auto points =
              dimension == 2 ? measure_paths<2>(frames, rounds) : measure_paths<3>(frames, rounds);
          for (const std::size_t with_paths : {0U, 1U})
            all[without + with_paths].points.push_back(points[with_paths]);
        });
    };
    add("rolling spiral", 2, "spiral", {.turns = 8, .rolled = models::Span{0.5, 0.52}});
    add("wandering random chain", 3, "random-chain", {.motion = models::ShapeMotion::wander});
  }

  [[nodiscard]] static Centers lemma_points(std::size_t beads, std::uint64_t) {
    return models::tightness_points(static_cast<int>(tree_height(beads)));
  }
  [[nodiscard]] Made grid(int dimension) const {
    return [=, gap = options_.gap](std::size_t beads, std::uint64_t) {
      return models::packed_grid(beads, dimension, gap);
    };
  }
  void plan_tightness() {
    add_ratios(Theorem::tightness, kLemmaPoints, 2, "", 0, lemma_points, 0.5);
    for (const int dimension : {2, 3})
      add_ratios(Theorem::tightness, "grid", dimension, "", models::radius, grid(dimension));
    add_ratios(Theorem::tightness, "random chain", 3, "", models::radius, random_chain, std::nullopt, true);
  }

  void plan_groupings() {
    const auto by_space = [](const Made& made) -> Made {
      return [=](std::size_t beads, std::uint64_t seed) {
        const Centers centers = made(beads, seed);
        return in_order(centers, order_by_space(centers));
      };
    };
    add_ratios(Theorem::groupings, kLemmaPoints, 2, "antipodes paired", 0,
               [](std::size_t beads, std::uint64_t seed) {
                 return in_order(lemma_points(beads, seed), order_by_antipodes(beads));
               });
    add_ratios(Theorem::groupings, kLemmaPoints, 2, "by space", 0, by_space(lemma_points));
    for (const int dimension : {2, 3})
      add_ratios(Theorem::groupings, "grid", dimension, "by space", models::radius,
                 by_space(grid(dimension)));
    add_ratios(Theorem::groupings, "random chain", 3, "by space", models::radius, by_space(random_chain),
               std::nullopt, true);
  }

  // One search serves both theorems.
  void plan_families() {
    const auto add = [&](std::string_view model, int dimension, Hierarchy hierarchy,
                         const std::vector<std::size_t>& sizes, const Made& made, bool is_random = false) {
      const std::string_view name = hierarchy_names[static_cast<std::size_t>(hierarchy)];
      const double expected = dimension == 2 ? 1 : 4.0 / 3;
      std::vector<std::size_t> series;
      for (const Theorem theorem : {Theorem::family, Theorem::search})
        if (asked(theorem))
          series.push_back(
              add_series(theorem, model, dimension, name, expected, sizes.size(), "", is_random));
      for (const std::size_t beads : sizes)
        plan_.work.emplace_back([=, rounds = asked(Theorem::search) ? options_.rounds : 0,
                                 seeds = seeds_of(is_random)](std::vector<TheoremSeries>& all) {
          std::vector<FamilySize> sizes_of_seeds;
          for (const std::uint64_t seed : seeds)
            sizes_of_seeds.push_back(measure_family(made(beads, seed), dimension, hierarchy, rounds));
          for (const std::size_t s : series) {
            std::size_t next = 0;
            all[s].points.push_back(over_seeds(beads, seeds, [&](std::size_t n, std::uint64_t) {
              const FamilySize& size = sizes_of_seeds[next++];
              const bool counts = all[s].theorem == Theorem::family;
              // A time has no bound without the constant.
              return TheoremPoint{n,
                                  counts ? static_cast<double>(size.found.family) : size.seconds->median,
                                  counts ? std::optional(family_bound(dimension, n)) : std::nullopt,
                                  size.seconds,
                                  std::nullopt,
                                  size.found.tests};
            }));
          }
        });
    };
    for (const int dimension : {2, 3})
      for (const Hierarchy hierarchy : {Hierarchy::wrapped, Hierarchy::layered})
        add("grid", dimension, hierarchy, sizes_of_grids(dimension, options_.most_beads), grid(dimension));
    add("random chain", 3, Hierarchy::wrapped, powers_of_two(kLeastOfChains, options_.most_beads),
        random_chain, true);
  }

  void plan_compared_families() {
    const auto add = [&](std::string_view model, int dimension, const std::vector<std::size_t>& sizes,
                         const Made& made) {
      const std::size_t first = plan_.series.size();
      for (const FamilyVariant& variant : kFamilyVariants)
        add_series(Theorem::families, model, dimension,
                   hierarchy_names[static_cast<std::size_t>(variant.hierarchy)], std::nullopt, sizes.size(),
                   variant.name);
      for (const std::size_t beads : sizes)
        plan_.work.emplace_back([=, seed = options_.seed](std::vector<TheoremSeries>& all) {
          const Centers centers = made(beads, seed);
          std::uint64_t smallest = 0;
          for (std::size_t v = 0; v < kFamilyVariants.size(); ++v) {
            const FamilyVariant& variant = kFamilyVariants[v];
            using Kind = FamilyVariant::Kind;
            const PairsFound found =
                dimension == 2 ? compared_family<2>(centers, variant) : compared_family<3>(centers, variant);
            if (variant.kind == Kind::smallest) smallest = found.family;
            std::optional<bool> holds;  // over the same tree, no family is smaller than the smallest
            if (variant.kind != Kind::by_space) holds = smallest <= found.family;
            std::optional<std::uint64_t> tests;
            if (variant.kind != Kind::written) tests = found.tests;
            all[first + v].points.push_back({beads, static_cast<double>(found.family),
                                             family_bound(dimension, beads), std::nullopt, holds, tests});
          }
        });
    };
    // The smallest family takes too much memory for more beads.
    const std::size_t most = std::min(options_.most_beads, kMostOfSmallest);
    for (const int dimension : {2, 3})
      add("grid", dimension, sizes_of_grids(dimension, most), grid(dimension));
    add("random chain", 3, powers_of_two(kLeastOfChains, most), random_chain);
  }

  void plan_two_necklaces() {
    for (const int dimension : {2, 3}) {
      const std::vector<std::size_t> sides = sides_of_grids(dimension, options_.most_beads);
      const std::size_t series = add_series(Theorem::two_necklaces, "two interleaved grids", dimension,
                                            hierarchy_names[static_cast<std::size_t>(Hierarchy::wrapped)],
                                            dimension == 2 ? 1 : 4.0 / 3, sides.size());
      for (const std::size_t side : sides)
        plan_.work.emplace_back([=, gap = options_.gap,
                                 rounds = options_.rounds](std::vector<TheoremSeries>& all) {
          const TwoChains chains = interleaved_grids(side, dimension, gap);
          const auto beads = static_cast<std::size_t>(std::max(chains.first.cols(), chains.second.cols()));
          const FamilySize size =
              dimension == 2 ? measure_between<2>(chains, rounds) : measure_between<3>(chains, rounds);
          all[series].points.push_back({beads, static_cast<double>(size.found.family),
                                        family_bound(dimension, beads), size.seconds, std::nullopt,
                                        size.found.tests});
        });
    }
  }

  void plan_closest_pairs() {
    // A helix with a constant number of turns has a power diagram of quadratic size.
    constexpr std::size_t most_of_helix = 4096;
    const auto add = [&](std::string_view model, int dimension, std::optional<double> expected,
                         const std::vector<std::size_t>& sizes, const Made& made, bool is_random = true) {
      const std::size_t series =
          add_series(Theorem::closest_pair, model, dimension, "", expected, sizes.size());
      for (const std::size_t beads : sizes)
        plan_.work.emplace_back(
            [=, rounds = options_.rounds, seeds = seeds_of(is_random)](std::vector<TheoremSeries>& all) {
              all[series].points.push_back(over_seeds(beads, seeds, [&](std::size_t n, std::uint64_t seed) {
                const ClosestByDiagram closest = closest_by_diagram(made(n, seed), dimension, rounds);
                return TheoremPoint{n, static_cast<double>(closest.looked_at), std::nullopt, closest.seconds,
                                    closest.same};
              }));
            });
    };
    for (const int dimension : {2, 3})
      add("grid", dimension, 1, sizes_of_grids(dimension, options_.most_beads),
          [dimension, gap = options_.gap](std::size_t beads, std::uint64_t seed) {
            return jittered_grid(beads, dimension, gap, seed);
          });
    add("random chain", 3, 1, powers_of_two(kLeastOfChains, options_.most_beads), random_chain);
    add(
        "helix", 3, std::nullopt, powers_of_two(512, most_of_helix),
        [](std::size_t beads, std::uint64_t) {
          constexpr double turns = 10;
          return models::helix(beads, turns);
        },
        false);
  }

  [[nodiscard]] static std::vector<std::size_t> sizes_of_grids(int dimension, std::size_t most) {
    std::vector<std::size_t> sizes;
    for (const std::size_t side : sides_of_grids(dimension, most))
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
  const bool roots_only = std::ranges::all_of(theorems, [](Theorem theorem) {
    return theorem == Theorem::tightness || theorem == Theorem::groupings;
  });
  return 4 * (roots_only ? kLeastOfRoots : kLeastOfChains);
}

bool measures_time(const std::vector<Theorem>& theorems) {
  return std::ranges::any_of(theorems, [](Theorem theorem) {
    return theorem == Theorem::paths || theorem == Theorem::search || theorem == Theorem::two_necklaces ||
           theorem == Theorem::closest_pair;
  });
}

}  // namespace kds
