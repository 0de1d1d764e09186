#pragma once
// Areas and volumes of a union of balls in space, from its dual complex, and of the voids that the union
// encloses.
//
// The power diagram cuts the union into one piece per ball. Inclusion and exclusion over the simplices of the
// dual complex gives the area and the volume of each piece (H. Edelsbrunner, "The union of balls and its dual
// shape", Discrete & Computational Geometry 13, 1995; H. Edelsbrunner, P. Koehl, "The geometry of
// biomolecular solvation", Combinatorial and Computational Geometry, 2005). Areas of two caps on a sphere
// follow from the theorem of Gauss and Bonnet. docs/dual_complex.md has the formulas.
//
// The complex says which terms are summed; the terms are doubles. In tests, results deviate by less than 1e-9
// of the sphere or ball of the bead (a contact: of the disc of the smaller ball), for ratios of radii up to
// 1e5. The terms of nearly flat simplices, and of balls whose radii differ by more than a factor of 100, are
// computed with rational numbers before square roots and angles.
//
// Degenerate positions: a flat simplex in the complex means that the radical planes of its beads share a line
// or are equal. Each point of that line serves as the centre of a flat tetrahedron, and the sums are the
// same. Balls with the same centre have no edge: the smaller one is hidden, and of equal ones all but one
// are.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "structures/triangulation/complex_simplices.h"

namespace kds {

/// Areas and volumes in powers of the unit of the centres. All are at least zero.
struct UnionMeasures {
  /// For each bead, the area of its sphere that is outside all other balls. The sum is the area of the
  /// union's boundary.
  std::vector<double> areas;
  /// For each bead, the volume of its ball within its cell of the power diagram. The sum is the union's
  /// volume.
  std::vector<double> volumes;
  /// For each edge of the complex, the area of the common facet of the two cells within the balls.
  std::vector<double> contacts;
};

/// Measures the union of the balls with these centres and radii. `complex` is their dual complex. A bead that
/// is no vertex of it has area and volume zero. Takes time linear in the numbers of beads and simplices.
/// Throws std::invalid_argument if centres and radii differ in number, or if a vertex of the complex has a
/// radius that is negative or not finite.
[[nodiscard]] UnionMeasures measure_union(const Eigen::Matrix3Xd& centers, std::span<const double> radii,
                                          const ComplexSimplices& complex);

/// A tetrahedron of the regular triangulation that does not belong to the dual complex. The bits say which of
/// its faces do.
struct ComplementCell {
  std::array<BeadId, 4> beads{};
  std::uint8_t vertices = 0;   ///< bit i: beads[i]
  std::uint8_t edges = 0;      ///< bit e: edge tetrahedron_edges[e]
  std::uint8_t triangles = 0;  ///< bit i: the triangle opposite to beads[i]
};

struct ComplementMeasures {
  double volume = 0;  ///< of the part of the cells that is outside all balls
  /// Beads, ascending, with the area of their spheres that bounds this part.
  std::vector<std::pair<BeadId, double>> areas;
};

/// Measures what is outside the union in these tetrahedra, such as all tetrahedra of a void (J. Liang et al.,
/// "Analytical shape computation of macromolecules II", Proteins 33, 1998). The result describes the
/// complement only if the tetrahedra are all those of one component of the complement of the complex; the
/// parts of single tetrahedra may be negative. The volume deviates by less than 1e-9 of all balls that touch
/// the tetrahedra. Throws like measure_union.
[[nodiscard]] ComplementMeasures measure_complement(const Eigen::Matrix3Xd& centers,
                                                    std::span<const double> radii,
                                                    std::span<const ComplementCell> cells);

}  // namespace kds
