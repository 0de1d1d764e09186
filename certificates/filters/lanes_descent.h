#pragma once
// Finds the first descent of four polynomials at once. Steps from the left isolate it, then it is narrowed to
// a bracket whose ends are proved. No allocation and bounded work; lanes whose result cannot be proved are
// reported as undecided.

#include <algorithm>

#include "certificates/filters/lanes_polynomial.h"

namespace kds {

/// Polynomials on [0,1] as in BoundedPolynomial, and their restrictions to [lower, upper], where each
/// polynomial has one root and is certainly positive at lower and negative at upper.
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
  Lanes::Mask never{};  ///< positive up to the end
  Lanes::Mask found{};  ///< isolated
  Lanes::Mask last{};   ///< lanes of `found` in which this is the last root
};

/// Searches the wanted lanes after `from`, where they must be certainly positive, by the computed value or
/// because they are `known` to be. `descent.part` must hold the computed polynomial on [from, 1]. It
/// determines the first step, and steps that start at `from` subdivide it.
template <int Degree>
void isolate_lanes(LanesDescent<Degree>& descent, double from, const Lanes::Mask& wanted,
                   const Lanes::Mask& known, LanesSearch& result);

/// Narrows [lower, upper] in the wanted lanes.
template <int Degree>
void narrow_lanes(LanesDescent<Degree>& descent, const Lanes::Mask& wanted);

/// Runs Halley's iteration from the control polygon until it converges, near the only descent on [0,1]. Uses
/// the coefficients without error bounds.
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
