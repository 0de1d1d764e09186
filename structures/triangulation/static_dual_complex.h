#pragma once
// The dual complex of balls at rest, built from nothing by CGAL with exact predicates.

#include <Eigen/Core>
#include <span>

#include "structures/triangulation/complex_simplices.h"

namespace kds {

/// Returns the dual complex (weighted alpha complex at alpha = 0) of the balls with these centres and squared
/// radii. A simplex of the regular triangulation belongs to it iff a coface belongs, or if its smallest
/// orthogonal sphere has a squared radius of at most 0 and no bead conflicts with this sphere. All signs are
/// exact. Centres may lie in a plane, on a line or in a point; a bead with a negative weight has no ball. In
/// degenerate positions the complex is that of the triangulation that CGAL chooses. Takes about linear time
/// for molecules. The numbers must be finite.
[[nodiscard]] ComplexSimplices static_dual_complex(const Eigen::Matrix3Xd& centers,
                                                   std::span<const double> weights);

}  // namespace kds
