#pragma once
// An isolating interval of one root of a polynomial.

#include <functional>

#include "motions/numbers/exact_number.h"

namespace kds {

/// An interval that contains exactly one root, with no root at its ends. If lower == upper, it is the root
/// itself.
struct RootInterval {
  Dyadic lower, upper;
  unsigned digits = 1;    ///< how many binary digits the next narrowing step should gain (narrow_root)
  int sign_at_lower = 0;  ///< the polynomial's sign at `lower`; 0 if unknown
};

/// Takes one root; returns whether the next one is wanted.
using RootVisitor = std::function<bool(RootInterval)>;

}  // namespace kds
