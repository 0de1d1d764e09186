#pragma once
// Motions of a degree that is known only when the program runs, up to `MostDegree`: what the program uses for
// users' polynomials beyond the degrees it is compiled for. Polynomials are elevated to MostDegree where they
// are asked for, exactly, in whole numbers only (integer_view.h): elevation of control points would round.

#include <cassert>

#include "motions/curves/bezier_motion.h"

namespace kds {

template <int DimensionValue, int MostDegree>
class ElevatedMotion : public BezierMotion<DimensionValue, MostDegree> {
 public:
  static constexpr bool is_elevated = true;

  using BezierMotion<DimensionValue, MostDegree>::BezierMotion;

  /// Control points 0 ... own_degree() are the motion's; the last place holds the end again.
  [[nodiscard]] int own_degree() const { return own_degree_; }
  void set_own_degree(int own) {
    assert(own >= 1 && own <= MostDegree);
    own_degree_ = own;
  }

 private:
  int own_degree_ = MostDegree;
};

template <class M>
inline constexpr bool elevated = requires {
  requires M::is_elevated;
};

/// The degree of the curves of a motion's beads.
template <Motion M>
[[nodiscard]] constexpr int own_degree(const M& motion) {
  if constexpr (elevated<M>) {
    return motion.own_degree();
  } else {
    return M::degree;
  }
}

static_assert(Motion<ElevatedMotion<3, 10>>);

}  // namespace kds
