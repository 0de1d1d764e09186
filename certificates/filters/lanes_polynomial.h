#pragma once
// Four polynomials side by side in Bernstein form: subdivision, and what the signs of coefficients tell about
// roots.

#include <algorithm>
#include <array>
#include <cstddef>

#include "motions/numbers/bernstein.h"
#include "motions/numbers/lanes.h"

namespace kds {

/// The coefficients for a constant degree, or for one known at run time (any_degree).
template <int Degree>
using LanesCoefficients = decltype(Bernstein<Lanes, Degree>::scaled);

/// The scaled Bernstein coefficients of four functions, and the scale of their errors.
template <int Degree>
struct ScaledLanes {
  LanesCoefficients<Degree> scaled;
  Lanes error_scale;     ///< M^h, or a NaN if the bound is not proved
  Lanes::Mask positive;  ///< all coefficients are certainly positive

  ScaledLanes() = default;
  template <int Other>
  explicit ScaledLanes(const ScaledLanes<Other>& other) requires(Degree < 0 && Other >= 0)
      : error_scale(other.error_scale), positive(other.positive) {
    scaled.resize(other.scaled.size());
    std::copy(other.scaled.begin(), other.scaled.end(), scaled.begin());
  }
};

// Functions on these polynomials are compiled for the degrees that certificates have under motions of degrees
// 1 to 3. Other degrees use any_degree.
#define KDS_FOR_EACH_LANES_DEGREE(compile)                                                         \
  compile(any_degree) compile(1) compile(2) compile(3) compile(4) compile(5) compile(6) compile(8) \
      compile(9) compile(10) compile(12) compile(15) compile(18)

template <int Degree>
inline constexpr bool is_compiled = [] {
#define KDS_IS_DEGREE(degree) || Degree == (degree)
  return false KDS_FOR_EACH_LANES_DEGREE(KDS_IS_DEGREE);
#undef KDS_IS_DEGREE
}();

/// Replaces the polynomial on [0, 1] by its restriction to [u, 1], in place. The first coefficient becomes
/// the value at u.
template <class Row>
[[gnu::always_inline]] inline Lanes casteljau(Row& c, const Lanes& u) {
  const Lanes v = Lanes(1) - u;
  for (std::size_t round = c.size() - 1; round > 0; --round) {
    for (std::size_t i = 0; i < round; ++i) c[i] = v * c[i] + u * c[i + 1];
  }
  return c[0];
}

/// The shape of a polynomial on its interval, as far as its coefficients and their errors prove it.
struct LanesShape {
  Lanes::Mask positive;     ///< positive on all of it
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
  // The pattern + ... + ? - ... - with at most one uncertain coefficient has exactly one sign variation,
  // whatever the sign of that coefficient. By Descartes' rule of signs there is one root.
  const long enough = static_cast<long>(count) - 1;
  return {before, descends & (certain >= Lanes::Mask{enough, enough, enough, enough})};
}

/// Replaces the polynomial on [0, 1] by its restriction to [0, u], in place.
template <class Row>
[[gnu::always_inline]] inline void casteljau_left(Row& c, const Lanes& u) {
  const Lanes v = Lanes(1.0) - u;
  const std::size_t count = c.size();
  for (std::size_t round = 1; round < count; ++round) {
    for (std::size_t i = count - 1; i >= round; --i) c[i] = v * c[i - 1] + u * c[i];
  }
}

/// Returns the value at the start of a part, raised to be certainly positive if it is known to be positive
/// but lies too close to a root. Descartes' rule needs only the sign.
[[gnu::always_inline]] inline Lanes known_positive(const Lanes& value, const Lanes::Mask& known,
                                                   const Lanes& error) {
  return Lanes::choose(known, Lanes::max(value, error + error), value);
}

}  // namespace kds
