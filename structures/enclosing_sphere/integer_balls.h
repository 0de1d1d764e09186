#pragma once
// All balls of a motion at one dyadic time, in integers. Exact. Used for audits and for output at frames.

#include <optional>
#include <span>
#include <vector>

#include "motions/base/bead.h"
#include "motions/curves/curves.h"
#include "motions/curves/positions.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/exact_sphere.h"

namespace kds {

template <int Dimension>
struct IntegerBalls {
  int unit = 0;  ///< lengths are multiplied by 2^unit
  std::vector<IntegerBall<Dimension>> balls;

  [[nodiscard]] std::vector<IntegerBall<Dimension>> of(std::span<const BeadId> beads) const {
    std::vector<IntegerBall<Dimension>> some;
    for (const BeadId b : beads) some.push_back(balls[b]);
    return some;
  }
};

template <int Dimension>
[[nodiscard]] IntegerBalls<Dimension> integer_balls_at(const Curves<Dimension>& curves, const Dyadic& time);

/// Returns the basis without its superfluous beads.
template <int Dimension>
[[nodiscard]] Basis proper_part(const Basis& basis, const IntegerBalls<Dimension>& whole);

/// Returns whether doubles with error bounds prove that a basis has no superfluous bead and that its sphere
/// holds a range of beads. That sphere is then the smallest one around the range. False proves nothing.
template <int Dimension>
[[nodiscard]] bool is_surely_basis_of(const Basis& basis, const BeadRange& range,
                                      const RoundedPositions<Dimension>& positions);

/// Returns the first bead of a range that is not inside the sphere of a proper basis, or none.
template <int Dimension>
[[nodiscard]] std::optional<BeadId> bead_outside(const Basis& basis, const BeadRange& range,
                                                 const IntegerBalls<Dimension>& whole);

}  // namespace kds
