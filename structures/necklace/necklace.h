#pragma once
// A necklace and the conditions of a proper one (Agarwal et al., section 2.1): consecutive beads touch, all
// other beads are disjoint, no ball lies inside others, and radii are uniform. Violations are reported, not
// rejected, because real files have them.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "motions/base/bead.h"

namespace kds {

enum class Condition {
  connected,      ///< consecutive beads have a point in common
  disjoint,       ///< no other beads meet, nor do beads of two necklaces
  uncontained,    ///< no ball lies in another
  uniform_radii,  ///< no two radii have a ratio above rho
  uniform_bonds,  ///< no two bonds have a ratio above rho
};
inline constexpr std::array kConditions{Condition::connected, Condition::disjoint, Condition::uncontained,
                                        Condition::uniform_radii, Condition::uniform_bonds};
[[nodiscard]] std::string_view name_of(Condition condition);

/// Two beads of the scene that violate a condition together.
///   connected, disjoint: first < second; uncontained: `first` lies in `second`; if two balls are equal, the
///   later one lies in the earlier; uniform_radii: `first` is too small compared with `second`, the first of
///   the largest beads of its necklace; uniform_bonds: the bond from `first` to the next bead is too short
///   compared with the bond from `second`, which is the first of the longest bonds.
struct Violation {
  BeadId first = 0, second = 0;
  friend auto operator<=>(const Violation&, const Violation&) = default;
};

struct Violations {
  std::size_t count = 0;
  std::vector<Violation> listed;  ///< the first violations, in ascending order
};

struct NecklaceReport {
  std::array<Violations, kConditions.size()> conditions;
  [[nodiscard]] const Violations& operator[](Condition condition) const {
    return conditions[static_cast<std::size_t>(condition)];
  }
  /// Returns whether no condition is violated.
  [[nodiscard]] bool proper() const;
};

struct ValidateOptions {
  /// The constant of uniformity, at least 1. If the constant is infinite, uniformity is violated only by
  /// beads of radius 0 together with larger ones, and by bonds of length 0 together with longer ones, because
  /// no constant bounds such a ratio.
  double rho = std::numeric_limits<double>::infinity();
  std::size_t most_listed = std::numeric_limits<std::size_t>::max();  ///< maximum number listed per condition
};

/// A view: the centres and radii belong to the whole scene and must outlive it.
class Necklace {
 public:
  /// Throws InputError naming the bead if a centre is not finite, or if a radius is negative or not finite.
  Necklace(BeadRange beads, const Eigen::Matrix3Xd& scene_centers, std::span<const double> scene_radii);

  [[nodiscard]] const BeadRange& beads() const { return beads_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_.last - beads_.first + 1; }
  [[nodiscard]] Eigen::Vector3d center(BeadId bead) const { return centers_->col(Eigen::Index{bead}); }
  [[nodiscard]] double radius(BeadId bead) const { return radii_[bead]; }

  struct Extent {
    double least, most;
    /// Returns the greatest ratio, infinite if no constant bounds it.
    [[nodiscard]] double ratio() const { return least == most ? 1 : most / least; }
  };
  [[nodiscard]] Extent radii() const;
  /// Returns the range of distances between consecutive centres, rounded. For a single bead the range is 0 to
  /// 0.
  [[nodiscard]] Extent bonds() const;

  /// Returns all violations within this necklace alone, exactly. Takes n log n time, times the number of
  /// powers of two among the diameters, plus the number of near pairs.
  [[nodiscard]] NecklaceReport validate(const ValidateOptions& options = {}) const;

 private:
  BeadRange beads_;
  const Eigen::Matrix3Xd* centers_;
  std::span<const double> radii_;
};

/// Validates several necklaces of one scene, in the scene's order. Returns the violations within each
/// necklace, and the beads of two necklaces that meet or lie in each other.
///
/// The paper also forbids that a ball lies within several others together, but `uncontained` tests pairs
/// only. Pairs suffice: if all nonadjacent beads are disjoint, a ball in the union of others lies in the
/// union of its neighbours. The neighbours are disjoint closed sets, so the ball lies in one of them. A scene
/// without violations is therefore proper.
[[nodiscard]] NecklaceReport validate(std::span<const Necklace> necklaces,
                                      const ValidateOptions& options = {});

}  // namespace kds
