#pragma once
// One root of a polynomial among its others.

#include <functional>

#include "motions/numbers/exact_number.h"

namespace kds {

/// An interval with one root and no root at its ends; or, where lower == upper, the root itself.
struct RootInterval {
  Dyadic lower, upper;
  unsigned digits = 1;    ///< what the next step of narrowing it is worth (narrow_root)
  int sign_at_lower = 0;  ///< of the polynomial, if it is known
};

/// Takes one root; returns whether the next one is wanted.
using RootVisitor = std::function<bool(RootInterval)>;

}  // namespace kds
