#pragma once
// The first descent of four polynomials at once: found in steps from the left, then narrowed to a bracket
// whose ends are proved. No allocation, bounded work; what it cannot prove it says so.

#include <algorithm>

#include "certificates/filters/lanes_polynomial.h"

namespace kds {

/// A polynomial on [0,1] as in BoundedPolynomial, and its part on [lower, upper], which is certainly positive
/// at lower, negative at upper, and has one root.
template <int Degree>
struct LanesDescent {
  LanesCoefficients<Degree> bernstein, part;
  Lanes value_error, local_error;
  Lanes lower, upper;

  LanesDescent() = default;
  template <int Other>
  explicit LanesDescent(const LanesDescent<Other>& other) requires(Degree < 0 && Other >= 0) {
    bernstein.resize(other.bernstein.size());
    part.resize(other.part.size());
    copy(other, *this);
  }
  template <int Other>
  void copy_to(LanesDescent<Other>& other) const {
    copy(*this, other);
  }

 private:
  template <class From, class To>
  static void copy(const From& from, To& to) {
    std::copy(from.bernstein.begin(), from.bernstein.end(), to.bernstein.begin());
    std::copy(from.part.begin(), from.part.end(), to.part.begin());
    to.value_error = from.value_error;
    to.local_error = from.local_error;
    to.lower = from.lower;
    to.upper = from.upper;
  }
};

struct LanesSearch {
  Lanes::Mask never{};  ///< positive to the end
  Lanes::Mask found{};  ///< isolated
  Lanes::Mask last{};   ///< of those, the last root
};

/// Searches the wanted lanes after `from`, where they are certainly positive: by their computed value, or
/// `known` to be. The part given is that on [from, 1], as computed; it tells how far the first look goes, and
/// looks that start at `from` subdivide it.
template <int Degree>
void isolate_lanes(LanesDescent<Degree>& descent, double from, const Lanes::Mask& wanted,
                   const Lanes::Mask& known, LanesSearch& result);

/// Narrows lower and upper of the wanted lanes.
template <int Degree>
void narrow_lanes(LanesDescent<Degree>& descent, const Lanes::Mask& wanted);

/// One step of Newton's and more (Halley) from the control polygon on, until it stands: near the only descent
/// on [0,1], as far as the coefficients themselves tell.
[[nodiscard]] double descent_of(const Coefficients<Lanes>& bernstein);

template <int Degree>
requires(!is_compiled<Degree>) void isolate_lanes(LanesDescent<Degree>& descent, double from,
                                                  const Lanes::Mask& wanted, const Lanes::Mask& known,
                                                  LanesSearch& result) {
  LanesDescent<any_degree> same(descent);
  isolate_lanes(same, from, wanted, known, result);
  same.copy_to(descent);
}
template <int Degree>
requires(!is_compiled<Degree>) void narrow_lanes(LanesDescent<Degree>& descent, const Lanes::Mask& wanted) {
  LanesDescent<any_degree> same(descent);
  narrow_lanes(same, wanted);
  same.copy_to(descent);
}

}  // namespace kds
