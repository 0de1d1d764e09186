#pragma once
// A necklace, and what makes it a proper one (Agarwal et al., section 2.1): consecutive beads touch, all
// others are disjoint, no ball lies inside others, and radii are uniform. Conditions are reported, not
// imposed: real files break them.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "motions/base/bead_range.h"

namespace kds {

enum class Condition {
  connected,      ///< consecutive beads have a point in common
  disjoint,       ///< no others have, nor have beads of two necklaces
  uncontained,    ///< no ball lies in another
  uniform_radii,  ///< no two radii have a ratio above rho
  uniform_bonds,  ///< no two bonds have
};
inline constexpr std::array kConditions{Condition::connected, Condition::disjoint, Condition::uncontained,
                                        Condition::uniform_radii, Condition::uniform_bonds};
[[nodiscard]] std::string_view name_of(Condition condition);

/// Beads of the scene that violate a condition together.
///   connected, disjoint: first < second;
///   uncontained: `first` lies in `second`; of two equal balls the later lies in the earlier;
///   uniform_radii: `first` is too small beside `second`, the first of the largest beads of its necklace;
///   uniform_bonds: the bond from `first` to the next bead is too short beside that from `second`, the first
///   of the longest.
struct Violation {
  BeadId first = 0, second = 0;
  friend auto operator<=>(const Violation&, const Violation&) = default;
};

struct Violations {
  std::size_t count = 0;
  std::vector<Violation> listed;  ///< the first of them, ascending
};

struct NecklaceReport {
  std::array<Violations, kConditions.size()> conditions;
  [[nodiscard]] const Violations& operator[](Condition condition) const {
    return conditions[static_cast<std::size_t>(condition)];
  }
  /// No condition is violated.
  [[nodiscard]] bool proper() const;
};

struct ValidateOptions {
  /// The constant of uniformity, at least 1. Without one only beads of radius 0 beside others, and bonds of
  /// length 0 beside others, are not uniform: no constant would do.
  double rho = std::numeric_limits<double>::infinity();
  std::size_t most_listed = std::numeric_limits<std::size_t>::max();  ///< of each condition
};

/// A view: centres and radii are those of the whole scene and must outlive it.
class Necklace {
 public:
  /// Throws InputError naming the bead where a centre is not finite or a radius not finite or negative.
  Necklace(BeadRange beads, const Eigen::Matrix3Xd& scene_centers, std::span<const double> scene_radii);

  [[nodiscard]] const BeadRange& beads() const { return beads_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_.last - beads_.first + 1; }
  [[nodiscard]] Eigen::Vector3d center(BeadId bead) const { return centers_->col(Eigen::Index{bead}); }
  [[nodiscard]] double radius(BeadId bead) const { return radii_[bead]; }

  struct Extent {
    double least, most;
    /// Infinite where no constant bounds it.
    [[nodiscard]] double ratio() const { return least == most ? 1 : most / least; }
  };
  [[nodiscard]] Extent radii() const;
  /// Distances of consecutive centres, rounded. 0 to 0 for a single bead.
  [[nodiscard]] Extent bonds() const;

  /// All violations in this necklace alone. Exact. Time n log n, times the number of powers of two among the
  /// diameters, plus the pairs that are near.
  [[nodiscard]] NecklaceReport validate(const ValidateOptions& options = {}) const;

 private:
  BeadRange beads_;
  const Eigen::Matrix3Xd* centers_;
  std::span<const double> radii_;
};

/// Several necklaces of one scene, in its order: what violates a condition in one of them, and the beads of
/// two that meet or lie in each other.
///
/// Why `uncontained` looks at pairs only, although the paper forbids a ball within several others together:
/// where all nonadjacent beads are disjoint, a ball that lies in the union of others lies in the union of its
/// neighbours, which are disjoint closed sets, and hence in one of them. So a scene of no violation is
/// proper.
[[nodiscard]] NecklaceReport validate(std::span<const Necklace> necklaces,
                                      const ValidateOptions& options = {});

}  // namespace kds
