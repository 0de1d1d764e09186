#pragma once
// Pairs of balls at one time in a periodic cell, by the distance of their nearest images. Exact for the given
// numbers: doubles with an error bound decide, else rationals.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "motions/frames/periodic.h"
#include "motions/numbers/exact_number.h"
#include "structures/collision/closest_pair.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Compares the distances of nearest images. The balls must outlive this object. Throws InputError if a
/// coordinate, a radius or the cell is more than 100,000 times as long as the lattice's shortest vector.
template <int Dimension>
class NearestImages {
 public:
  NearestImages(const Balls<Dimension>& balls, const Cell& cell);

  /// Returns whether an image of one ball is at most `distance` (finite, not negative) from the other ball.
  [[nodiscard]] bool are_within(BeadId a, BeadId b, double distance) const;
  /// Returns the distance of the nearest images of two balls' surfaces, rounded.
  [[nodiscard]] double distance(BeadId a, BeadId b) const;

  /// The exact distance of two surfaces: sqrt(square) - reach.
  struct Gap {
    Rational square, reach;
  };
  [[nodiscard]] Gap gap(BeadId a, BeadId b) const;
  /// Returns a bound of the error of distance().
  [[nodiscard]] double error() const { return margin_; }

 private:
  [[nodiscard]] Eigen::Vector3d difference(BeadId a, BeadId b) const;

  const Balls<Dimension>& balls_;
  Cell cell_;
  Images images_;
  double margin_;
};

/// Returns all pairs asked for whose balls have images at most `distance` apart, in ascending order. Tests
/// all pairs.
template <int Dimension>
[[nodiscard]] std::vector<BeadPair> image_pairs_by_force(const Balls<Dimension>& balls, const Cell& cell,
                                                         const PairsAsked& asked, double distance);
/// Returns the same pairs, found by a grid of all images around the cell. If the reach is more than four
/// times the length of the lattice's shortest vector, all pairs are tested.
template <int Dimension>
[[nodiscard]] std::vector<BeadPair> image_pairs_by_cells(const Balls<Dimension>& balls, const Cell& cell,
                                                         const PairsAsked& asked, double distance);
/// Returns the pair asked for whose images are the closest, or none if no pairs are asked for. If several are
/// equally close, returns the first. Tests all pairs.
template <int Dimension>
[[nodiscard]] std::optional<ClosestPair> closest_images_by_force(const Balls<Dimension>& balls,
                                                                 const Cell& cell, const PairsAsked& asked);
/// Returns the same pair, found by grids. Tests all pairs only if none is nearer than the cell is wide.
template <int Dimension>
[[nodiscard]] std::optional<ClosestPair> closest_images_by_cells(const Balls<Dimension>& balls,
                                                                 const Cell& cell, const PairsAsked& asked);

}  // namespace kds
