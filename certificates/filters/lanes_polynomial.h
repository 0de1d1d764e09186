#pragma once
// Four polynomials side by side by their Bernstein coefficients: subdivision, and what signs tell of roots.

#include <array>
#include <cstddef>

#include "motions/numbers/bernstein.h"
#include "motions/numbers/lanes.h"

namespace kds {

/// Of a degree that is a constant, or (any_degree) known at run time.
template <int Degree>
using LanesCoefficients = decltype(Bernstein<Lanes, Degree>::scaled);

/// In place: the polynomial on [u, 1] from that on [0, 1]; the first coefficient becomes the value at u.
template <class Row>
[[gnu::always_inline]] inline Lanes casteljau(Row& c, const Lanes& u) {
  const Lanes v = Lanes(1) - u;
  for (std::size_t round = c.size() - 1; round > 0; --round) {
    for (std::size_t i = 0; i < round; ++i) c[i] = v * c[i] + u * c[i + 1];
  }
  return c[0];
}

/// What coefficients with errors say of a polynomial on their interval.
struct LanesShape {
  Lanes::Mask positive;     ///< all over it
  Lanes::Mask one_descent;  ///< positive at its start, negative at its end, one root between
};

template <class Row>
[[gnu::always_inline]] inline LanesShape shape_of(const Row& c, const Lanes& error) {
  const std::size_t count = c.size();
  Lanes::Mask before = c[0] > error;
  Lanes::Mask after = c[count - 1] < -error;
  const Lanes::Mask descends = before & after;
  Lanes::Mask certain = -(before + after);
  for (std::size_t k = 1; k < count; ++k) {
    before &= c[k] > error;
    after &= c[count - 1 - k] < -error;
    certain -= before + after;
  }
  // + ... + ? - ... - with one doubtful coefficient or none has exactly one sign variation whatever that one
  // is: one root, by Descartes.
  const long enough = static_cast<long>(count) - 1;
  return {before, descends & (certain >= Lanes::Mask{enough, enough, enough, enough})};
}

/// In place: the polynomial on [0, u] from that on [0, 1].
template <class Row>
[[gnu::always_inline]] inline void casteljau_left(Row& c, const Lanes& u) {
  const Lanes v = Lanes(1.0) - u;
  const std::size_t count = c.size();
  for (std::size_t round = 1; round < count; ++round) {
    for (std::size_t i = count - 1; i >= round; --i) c[i] = v * c[i - 1] + u * c[i];
  }
}

/// The value at the start of a part, made certainly positive where it is known to be, close to a root as it
/// may lie: the rule of signs asks for signs alone.
[[gnu::always_inline]] inline Lanes known_positive(const Lanes& value, const Lanes::Mask& known,
                                                   const Lanes& error) {
  return Lanes::choose(known, Lanes::max(value, error + error), value);
}

}  // namespace kds
