#pragma once
// Four polynomials side by side in Bernstein form: subdivision, a first classification by the signs of their
// coefficients, and the search for the first descent. Steps from the left isolate the descent, then it is
// narrowed to a bracket whose ends are proved. No allocation and bounded work; lanes whose result cannot be
// proved are reported as undecided.

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
/// because they are `known` to be. `descent.part` must hold the computed polynomial on [from, 1]. The part
/// determines the first step, and steps that start at `from` subdivide the part.
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

/// The present time, and what is known about each lane's function at that time.
struct LanesNow {
  double lower = 0, upper = 0;
  bool isolating = false;
  unsigned at_own_root = 0;  ///< lanes at their own root, one bit each: see KnownAtStart
};

/// The classification of each lane. If a lane is in no mask, not even its present sign is certain.
struct LanesSigns {
  Lanes::Mask positive{};  ///< never fails: all coefficients are positive
  Lanes::Mask never{};     ///< never fails from now on
  Lanes::Mask violated{};  ///< negative now
  Lanes::Mask found{};     ///< fails once from now on, in `descent`
  Lanes::Mask unclear{};   ///< positive now, still to be searched
  Lanes::Mask known{};     ///< positive now because it is at its own root, even if the value does not show it
};
template <int Degree>
struct LanesOutcome : LanesSigns {
  LanesDescent<Degree> descent;  ///< polynomials and errors of the lanes that are not positive
};

/// Classifies functions that are not all positive (ScaledLanes) from the present time on, by a first look at
/// the signs of their Bernstein coefficients. The answers are those of BoundedPolynomial for one function at
/// a time. Functions that need a subdivision are left to later stages. `uniform` is from their ErrorBound.
template <int Degree>
void classify_lanes(const ScaledLanes<Degree>& functions, double uniform, const LanesNow& now,
                    LanesOutcome<Degree>& out);

template <int Degree>
requires(!is_compiled<Degree>) void classify_lanes(const ScaledLanes<Degree>& functions, double uniform,
                                                   const LanesNow& now, LanesOutcome<Degree>& out) {
  LanesOutcome<any_degree> same;
  classify_lanes(ScaledLanes<any_degree>(functions), uniform, now, same);
  static_cast<LanesSigns&>(out) = same;
  same.descent.copy_to(out.descent);
}

}  // namespace kds
