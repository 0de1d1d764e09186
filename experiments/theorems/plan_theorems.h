#pragma once
// The quantities that the paper's theorems bound, each measured on families of necklaces over a range of
// sizes.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/program/growth_fit.h"
#include "experiments/program/mean_interval.h"
#include "experiments/program/power_fit.h"
#include "experiments/program/timing.h"
#include "structures/collision/sphere_tree.h"

namespace kds {

/// The theorems of Agarwal et al. (2004) about the growth of a quantity.
enum class Theorem : std::uint8_t {
  paths,          ///< remark in section 2.3: path cages do not speed up the verification
  tightness,      ///< 2.3: layered root at most sqrt(h + 1) times the wrapped root, almost tight
  groupings,      ///< remark after 2.3: the same ratio if the beads are grouped otherwise
  family,         ///< 3.1: a separating family of O(n log n) pairs in the plane, O(n^(4/3)) in space
  families,       ///< 3.1: the proof's family, the smallest one and those of other searches
  search,         ///< 3.2: collisions decided within the time of 3.1
  two_necklaces,  ///< 3.3: collisions of two necklaces decided within this time
  closest_pair    ///< 3.5: the closest pair is among the pairs that the power diagram and the chain give
};
/// The names of the enumerators in order.
inline constexpr std::array<std::string_view, 8> theorem_names{"paths",    "2.3", "groupings", "3.1",
                                                               "families", "3.2", "3.3",       "3.5"};
[[nodiscard]] constexpr std::string_view name_of(Theorem theorem) {
  return theorem_names[static_cast<std::size_t>(theorem)];
}

/// Returns the measured quantity in words, with its unit.
[[nodiscard]] std::string_view quantity_of(Theorem theorem);

struct TheoremPoint {
  std::size_t beads = 0;
  double value = 0;             ///< quantity_of the theorem
  std::optional<double> bound;  ///< the theorem's bound, without its constant if that is unspecified
  std::optional<Spread> seconds;
  std::optional<bool> holds;                    ///< empty if one size cannot decide it
  std::optional<std::uint64_t> tests = {};      ///< pairs of spheres that a search compared
  std::optional<MeanInterval> over_seeds = {};  ///< of the value, if it is the mean over several seeds
};

struct TheoremSeries {
  Theorem theorem = Theorem::tightness;
  std::string model;
  int dimension = 3;
  std::string hierarchy;           ///< empty if none
  std::string variant;             ///< family, rule or grouping; empty: as in the paper
  std::optional<double> expected;  ///< exponent in the theorem; empty if it says nothing about this model
  bool at_most = false;            ///< whether `expected` only bounds the exponent of this model
  std::vector<TheoremPoint> points;

  /// Returns the value by the number of beads n or, for 2.3 and groupings, by the tree's height h.
  [[nodiscard]] GrowthPoints growth() const;
  /// Fits a straight line to the logarithms. For families and searches in the plane, fits that of value /
  /// log2 n.
  [[nodiscard]] std::optional<PowerFit> fit() const;
  /// Fits the exponent of the leading term together with lower-order terms: b n + c for families and
  /// searches, a term for the surface for 3.5, a constant for the others. For families and searches in the
  /// plane, the leading term has the factor log2 n.
  [[nodiscard]] std::optional<double> exponent() const;
  /// Fits the law of the theorem, with its lower-order terms or without, as AICc decides. If the theorem
  /// names no exponent or only bounds it, the usual forms (growth_fit.h) are compared too.
  [[nodiscard]] std::optional<GrowthFit> law() const;

  /// Returns the quantity that a fitted law predicts for a necklace with this many beads.
  [[nodiscard]] double predicted(const GrowthFit& law, std::size_t beads) const;

 private:
  [[nodiscard]] bool is_ratio() const;
  [[nodiscard]] bool has_logarithm() const;
  [[nodiscard]] std::vector<GrowthTerm> lower_terms() const;
};

/// Returns a name such as "grid in space, wrapped, smallest".
[[nodiscard]] std::string name_of(const TheoremSeries& series);

/// Measures Theorem 2.3: returns layered radius / wrapped radius of the root over all balls of a necklace
/// with at least two beads. Returns 1 if both radii are 0.
[[nodiscard]] double root_ratio(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                int dimension);

/// Returns the height of the balanced tree over this many beads: the depth of its deepest leaf.
[[nodiscard]] std::size_t tree_height(std::size_t beads);

/// Measures Theorem 3.5: the closest pair by power diagram, and by a search of the hierarchy.
struct ClosestByDiagram {
  std::uint64_t looked_at = 0;  ///< pairs that the diagram and the chain give
  Spread seconds;               ///< time, diagram included
  bool same = false;  ///< whether the hierarchy search, which considers all pairs, finds the same pair
};

/// Returns the number of beads in a tightly packed grid (Theorems 3.1 and 3.2): all rows, and a bead beside
/// each row except the last that joins it to the next row.
[[nodiscard]] std::size_t beads_of_grid(int dimension, std::size_t side);

/// Returns odd sides of grids with 1000 to `most_beads` beads. The number of beads grows by a roughly
/// constant factor, and the last side is the largest possible. Sides are odd: if a side is a power of two,
/// tree nodes end where rows end, and results for a mixture of such sizes oscillate.
[[nodiscard]] std::vector<std::size_t> sides_of_grids(int dimension, std::size_t most_beads);

struct TheoremOptions {
  std::vector<Theorem> theorems;     ///< ascending
  std::size_t most_beads = 100'000;  ///< beads of the largest necklaces
  double gap = 0.05;                 ///< between rows of grids, in diameters
  std::uint64_t seed = 1;            ///< for random necklaces
  std::size_t rounds = 3;            ///< for each time measurement
  std::size_t seeds = 1;             ///< number of random necklaces of each size, from `seed` on
};

struct TheoremPlan {
  std::vector<TheoremSeries> series;  ///< without points
  std::vector<std::size_t> sizes;     ///< number of points of each series
  /// Each function adds a point to one series, or to two series that share a measurement. Call the functions
  /// in order.
  std::vector<std::function<void(std::vector<TheoremSeries>&)>> work;
};

[[nodiscard]] TheoremPlan plan_theorems(const TheoremOptions& options);

/// Returns the least value of most_beads for which each series has three sizes, as a fit needs.
[[nodiscard]] std::size_t least_beads_for(const std::vector<Theorem>& theorems);
[[nodiscard]] bool measures_time(const std::vector<Theorem>& theorems);

}  // namespace kds
