#pragma once
// The first descent of four polynomials at once: walks along each from the left, by a step that doubles while
// all coefficients on it are positive and halves while they show nothing, until one holds a single root. No
// allocation, bounded work; what it cannot prove it says so.

#include "certificates/search/narrow_lanes.h"

namespace kds {

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

struct LanesSearch {
  Lanes::Mask never{};  ///< positive to the end
  Lanes::Mask found{};  ///< isolated
  Lanes::Mask last{};   ///< of those, the last root
};

/// The value at the start of a part, made certainly positive where it is known to be, close to a root as it
/// may lie: the rule of signs asks for signs alone.
[[gnu::always_inline]] inline Lanes known_positive(const Lanes& value, const Lanes::Mask& known,
                                                   const Lanes& error) {
  return Lanes::choose(known, Lanes::max(value, error + error), value);
}

/// Where the control polygon first falls below zero, in [0,1]; 1 if it does not.
template <class Row>
[[gnu::always_inline]] inline Lanes first_descent_of_polygon(const Row& c) {
  const std::size_t last = c.size() - 1;
  Lanes place(static_cast<double>(last)), left(0.0), right(-1.0);
  for (std::size_t k = last; k-- > 0;) {
    const Lanes::Mask falls = (c[k] > Lanes(0.0)) & (c[k + 1] <= Lanes(0.0));
    place = Lanes::choose(falls, Lanes(static_cast<double>(k)), place);
    left = Lanes::choose(falls, c[k], left);
    right = Lanes::choose(falls, c[k + 1], right);
  }
  return (place + left / (left - right)) * Lanes(1.0 / static_cast<double>(last));
}

/// Searches the wanted lanes after `from`, where they are certainly positive: by their computed value, or
/// `known` to be. The part given is that on [from, 1], as computed; it tells how far the
/// first look goes, and looks that start at `from` subdivide it.
template <int Degree>
[[KDS_LANES_TARGETS]] void isolate_lanes(LanesDescent<Degree>& descent, double from,
                                         const Lanes::Mask& wanted, const Lanes::Mask& known,
                                         LanesSearch& result) {
  constexpr int most_steps = 100;
  Lanes::Mask searching = wanted;
  Lanes lower(from);
  const LanesCoefficients<Degree> given = descent.part;
  const Lanes rest(1 - from);
  LanesCoefficients<Degree> known_given = given;
  known_given[0] = known_positive(given[0], known, descent.local_error);
  Lanes step = Lanes(1.5) * rest * first_descent_of_polygon(known_given);
  for (int count = 0; count < most_steps && Lanes::any(searching); ++count) {
    const Lanes upper = Lanes::min(lower + step, Lanes(1.0));
    LanesCoefficients<Degree> part;
    if (Lanes::any(searching & (lower > Lanes(from)))) {
      part = descent.bernstein;
      casteljau_left(part, upper);
      casteljau(part, lower / upper);
    } else {  // two subdivisions again, one of them made already
      part = given;
      casteljau_left(part, (upper - lower) / rest);
    }
    part[0] = known_positive(part[0], known & (lower <= Lanes(from)), descent.local_error);
    const LanesShape shape = shape_of(part, descent.local_error);
    const Lanes::Mask found = searching & shape.one_descent;
    const Lanes::Mask never = searching & shape.positive & (upper >= Lanes(1.0));
    for (std::size_t k = 0; k < part.size(); ++k)
      descent.part[k] = Lanes::choose(found, part[k], descent.part[k]);
    descent.lower = Lanes::choose(found, lower, descent.lower);
    descent.upper = Lanes::choose(found, upper, descent.upper);
    result.found |= found;
    result.last |= found & (upper >= Lanes(1.0));
    result.never |= never;
    lower = Lanes::choose(shape.positive, upper, lower);
    step = Lanes::choose(shape.positive, step + step, step * Lanes(0.5));
    searching &= ~(found | never) & (step > Lanes(0x1p-30)) & (lower < Lanes(1.0));
  }
}

}  // namespace kds
