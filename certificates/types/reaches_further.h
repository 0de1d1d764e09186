#pragma once
// "One ball reaches further than another along a direction", for bounding volumes with fixed directions. A
// ball with centre c and radius r reaches c.d + r |d| along d, the value of its support function. Each
// coordinate of a direction is -1, 0 or 1.
//
//   type                 function                                 degree   for
//   ReachesFurther       d.(c_b - c_a)                            k        beads of equal radii, any motion
//   BallReachesFurther   d.(c_b - c_a) + |d| (r_b - r_a)          k        balls of any radii
//
// The second is a radical A + B sqrt(D) with A = d.(c_b - c_a), B = r_b - r_a and D = |d|^2, which is 1, 2 or
// 3 and so positive. Its norm (d.(c_b - c_a))^2 - |d|^2 (r_b - r_a)^2 has degree 2k. Both are exact.
//
// The direction of a certificate is canonical: its first coordinate other than 0 is 1. So the first type has
// one function for a direction and its opposite, and a pair of beads that is exchanged at both ends of a node
// fails twice at one time with one identity.

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"
#include "certificates/base/radical.h"

namespace kds {

/// A direction with coordinates -1, 0 and 1, not all 0. In the plane the last coordinate is 0.
struct SlabDirection {
  std::array<std::int8_t, 3> steps{1, 1, 1};

  [[nodiscard]] constexpr SlabDirection opposite() const {
    SlabDirection other;
    for (std::size_t axis = 0; axis < 3; ++axis) other.steps[axis] = static_cast<std::int8_t>(-steps[axis]);
    return other;
  }
  /// Returns |d|^2, the number of coordinates other than 0.
  [[nodiscard]] constexpr int square() const {
    int count = 0;
    for (const int step : steps) count += step * step;
    return count;
  }
  /// Returns whether the first coordinate other than 0 is 1.
  [[nodiscard]] constexpr bool is_canonical() const {
    for (const int step : steps)
      if (step != 0) return step > 0;
    return true;
  }
  /// Returns a number that no other direction has.
  [[nodiscard]] constexpr BeadId number() const {
    return static_cast<BeadId>(9 * (steps[0] + 1) + 3 * (steps[1] + 1) + steps[2] + 1);
  }

  friend constexpr bool operator==(const SlabDirection&, const SlabDirection&) = default;
};

/// The arguments of the formulas: two beads and a canonical direction. The default direction has no
/// coordinate 0, so that bounds derived from the formula hold for all directions. Formulas multiply by the
/// direction's numbers (`times`) and do not branch on them, because exact functions are cached by these
/// factors.
struct DirectedBeads : std::array<BeadId, 2> {
  SlabDirection direction;

  friend constexpr bool operator==(const DirectedBeads&, const DirectedBeads&) = default;
};

namespace detail {

/// Returns the second centre minus the first, along the direction.
template <MotionView View>
[[nodiscard]] auto ahead_along(const View& view, const DirectedBeads& beads) {
  const auto d = view.difference(beads[1], beads[0]);
  auto sum = times(beads.direction.steps[0], d[0]);
  for (std::size_t axis = 1; axis < d.size(); ++axis) sum += times(beads.direction.steps[axis], d[axis]);
  return sum;
}

}  // namespace detail

/// Base of both types: the beads ascending, a canonical direction, and the signs that undo the two
/// exchanges.
struct AlongDirection {
  DirectedBeads beads{};
  int sign = 1;     ///< 1, or -1 if the beads were exchanged
  int forward = 1;  ///< 1, or -1 if the direction was reversed

  AlongDirection() = default;
  AlongDirection(BeadId ahead, BeadId behind, const SlabDirection& direction) {
    beads[0] = behind;
    beads[1] = ahead;
    sign = sort_beads<2>(beads);
    forward = direction.is_canonical() ? 1 : -1;
    beads.direction = forward > 0 ? direction : direction.opposite();
  }

  /// Returns whether the second bead in ascending order must be ahead along the canonical direction.
  [[nodiscard]] bool side() const { return sign * forward > 0; }
};

/// Holds while the bead `ahead` lies beyond the bead `behind` along the direction.
struct ReachesFurther : AlongDirection {
  static constexpr CertificateType type{13, "reaches_further"};

  using AlongDirection::AlongDirection;

  [[nodiscard]] Identity identity() const {
    Identity identity = identity_of(type, beads);
    identity.beads.back() = beads.direction.number();
    return identity;
  }

  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const DirectedBeads& beads) {
    return detail::ahead_along(view, beads);
  }
};

/// Holds while the ball `ahead` reaches further than the ball `behind` along the direction.
struct BallReachesFurther : AlongDirection {
  static constexpr CertificateType type{14, "ball_reaches_further"};

  using AlongDirection::AlongDirection;

  /// Returns the identity. Along a reversed direction the function is another one, so its name begins with
  /// the beads exchanged.
  [[nodiscard]] Identity identity() const {
    DirectedBeads named = beads;
    if (forward < 0) std::swap(named[0], named[1]);
    Identity identity = identity_of(type, named);
    identity.beads.back() = beads.direction.number();
    return identity;
  }

  [[nodiscard]] int root_sign() const { return forward; }

  struct Radical {
    struct Rational {
      DirectedBeads beads{};
      template <MotionView View>
      [[nodiscard]] static auto formula(const View& view, const DirectedBeads& beads) {
        return detail::ahead_along(view, beads);
      }
    };
    struct Root {
      static constexpr bool uses_radii = true;
      DirectedBeads beads{};
      template <MotionView View>
      [[nodiscard]] static auto formula(const View& view, const DirectedBeads& beads) {
        return view.radius_difference(beads[1], beads[0]);
      }
    };
    struct Norm {
      static constexpr bool uses_radii = true;
      DirectedBeads beads{};
      template <MotionView View>
      [[nodiscard]] static auto formula(const View& view, const DirectedBeads& beads) {
        const auto ahead = detail::ahead_along(view, beads);
        const auto larger = view.radius_difference(beads[1], beads[0]);
        return ahead * ahead - times(beads.direction.square(), larger * larger);
      }
    };
  };
};

}  // namespace kds

template <>
struct std::tuple_size<kds::DirectedBeads> : std::integral_constant<std::size_t, 2> {};
