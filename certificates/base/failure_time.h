#pragma once
// When a certificate fails: a bracket in doubles, and which root of the certificate's function in it.
//
// Exact: the time is root number `ordinal` (from 0, each root once) of the function in [lower, upper];
// together with the function this determines it. If lower < upper it lies strictly between. If `isolating`,
// there is no other root in the bracket and the function's signs at lower and at upper differ, both proved.
// The function is the certificate's own, which turns negative there, or, for a radical certificate, one that
// has all its roots (its norm, radical.h) and may change either way. The `fast` kernel gives lower == upper
// without any proof.

#include <cstdint>

namespace kds {

struct FailureTime {
  double lower = 0;
  double upper = 0;
  std::uint16_t ordinal = 0;
  bool isolating = true;
  bool touch = false;  ///< the function only touches zero there: no failure, see TouchPolicy
  bool last = false;   ///< known to be the function's last root in the step, and not at its end
};

/// Whether a structure is told that a function touches zero without changing sign. That is no failure. But
/// motions in general position have no such moments, so that a structure may have to look at itself then.
enum class TouchPolicy : std::uint8_t { ignored, reported };

/// What a search finds out about a new certificate. That it never fails is a value, not a large number.
struct Failure {
  enum class Kind : std::uint8_t {
    never,     ///< holds for the rest of the step
    zero,      ///< the function is zero for the whole step: never fails either
    later,     ///< fails at `time`, before the end of the step, or touches zero then
    at_birth,  ///< does not hold just after the present time
  };
  Kind kind = Kind::never;
  FailureTime time{};
};

}  // namespace kds
