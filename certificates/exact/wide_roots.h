#pragma once
// Isolates the roots of a wide polynomial on [0,1], each in its own interval, by Descartes' rule of signs on
// parts of the step. Balls of few bits are used where they decide. Roots may lie anywhere
// between 2^-10000 and 1 - 2^-10000, and pairs of roots as close together. Plain halving would take a step
// for each binary digit. Instead, scales are searched by halving exponents, and the number of digits doubles
// from step to step. Exact.

#include <optional>

#include "certificates/exact/wide_polynomial.h"

namespace kds {

/// Visits the roots of a square-free polynomial in [lower, upper], lower < upper, ascending. The isolating
/// intervals are disjoint except for common ends. Roots that the visitor does not want are not isolated. The
/// visitor may narrow roots, but must not visit roots of the same polynomial.
void visit_wide_roots(const WidePolynomial& square_free, const Dyadic& lower, const Dyadic& upper,
                      const RootVisitor& visit);

/// The known roots of a square-free polynomial whose intervals overlap (lower, upper): their number (2 stands
/// for more) and the first one. The query returns nothing unless all roots there are known.
struct RootsAround {
  int count = 0;
  RootInterval first;
};
[[nodiscard]] std::optional<RootsAround> known_roots_around(const WidePolynomial& square_free,
                                                            const Dyadic& lower, const Dyadic& upper);

/// Records an interval found elsewhere: it has one root, at which the polynomial changes sign.
void keep_root(const WidePolynomial& polynomial, const RootInterval& root);

/// Narrows the interval of a root at which the polynomial changes sign. The sign at the lower end must be
/// known. The next step guesses a part of the interval from the values at both ends; root.digits says how
/// many binary digits it should gain: 1 at first, then the number that the previous step has set. The
/// narrowed interval is stored with the polynomial, for later visits of the root.
void narrow_root(const WidePolynomial& polynomial, RootInterval& root);

/// Returns the only root in [lower, upper], at which the polynomial changes sign, as narrow as it is known.
[[nodiscard]] RootInterval known_root(const WidePolynomial& polynomial, const Dyadic& lower,
                                      const Dyadic& upper);

/// Returns whether the interval is shorter than 2^-digits times its distance from 0 or 1, whichever is
/// nearer.
[[nodiscard]] bool has_digits(const RootInterval& root, unsigned digits);

/// Returns a number with few digits between two numbers of [0,1]. If the two numbers have the same scale, the
/// result is the midpoint. Otherwise it halves the exponents, towards the end at which the interval spans
/// many scales, because scales towards 0 and 1 are endless.
[[nodiscard]] Dyadic split_point(const Dyadic& lower, const Dyadic& upper);

}  // namespace kds
