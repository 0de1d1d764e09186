#pragma once
// The time at which a certificate fails: a bracket of two doubles, and which root of the certificate's
// function in the bracket is meant.
//
// The time is root number `ordinal` (from 0, each root counted once) of the function in [lower, upper].
// Together with the function, this determines the time exactly. If lower < upper, the time lies strictly
// between them. If `isolating`, there is no other root in the bracket, and the function's signs at lower and
// upper are proved to differ. The function is the certificate's own, which turns negative at the time. For a
// radical certificate it is a polynomial that has all roots of the certificate's function (the norm,
// radical.h) and may change sign in either direction. The `fast` kernel gives lower == upper without proof.

#include <cstdint>

namespace kds {

struct FailureTime {
  double lower = 0;
  double upper = 0;
  std::uint16_t ordinal = 0;
  bool isolating = true;
  bool touch = false;  ///< the function only touches zero there, which is no failure, see TouchPolicy
  bool last = false;   ///< known to be the function's last root in the step, and not at its end
};

/// Whether a structure is told when a function touches zero without changing sign. A touch is not a failure.
/// However, motions in general position have no touches, so a structure may have to examine itself at one.
enum class TouchPolicy : std::uint8_t { ignored, reported };

/// The result of searching a new certificate. A certificate that never fails has its own kind, not a large
/// time.
struct Failure {
  enum class Kind : std::uint8_t {
    never,     ///< holds for the rest of the step
    zero,      ///< the function is zero on the whole step, so it never fails either
    later,     ///< fails at `time`, before the end of the step, or only touches zero then
    at_birth,  ///< does not hold just after the present time
  };
  Kind kind = Kind::never;
  FailureTime time{};
};

}  // namespace kds
