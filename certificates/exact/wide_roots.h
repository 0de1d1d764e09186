#pragma once
// The roots of a wide polynomial on [0,1], each in an interval of its own: Descartes' rule of signs on parts
// of the step, by the polynomial's leading digits where these tell. Roots may lie anywhere between 2^-10000
// and 1 - 2^-10000, and pairs of them as close together: where halving would take a step for each binary
// digit, scales are searched by halving exponents, and digits doubled from step to step. Exact.

#include <optional>

#include "certificates/exact/wide_polynomial.h"

namespace kds {

/// Visits the roots of a square-free polynomial in [lower, upper], lower < upper, ascending; their intervals
/// are disjoint but for touching ends. Those that the visitor does not want are not looked for.
/// It may narrow roots, but visits none of the same polynomial.
void visit_wide_roots(const WidePolynomial& square_free, const Dyadic& lower, const Dyadic& upper,
                      const RootVisitor& visit);

/// Roots of a square-free polynomial whose intervals reach into (lower, upper), as far as they are narrowed:
/// how many, 2 standing for more, and the first. Nothing where not all there are known.
struct RootsAround {
  int count = 0;
  RootInterval first;
};
[[nodiscard]] std::optional<RootsAround> known_roots_around(const WidePolynomial& square_free,
                                                            const Dyadic& lower, const Dyadic& upper);

/// Notes what was found out otherwise: an interval with one root, at which the polynomial changes its sign.
void keep_root(const WidePolynomial& polynomial, const RootInterval& root);

/// Narrows the interval of a root at which the polynomial changes its sign, which is known at the lower end.
/// Its `digits` say how many binary digits a step is worth that is guessed from the values at both ends: 1 at
/// first, then what the step before has made of it. Who visits the root later finds it narrowed.
void narrow_root(const WidePolynomial& polynomial, RootInterval& root);

/// The only root in [lower, upper], at which the polynomial changes its sign: as narrow as it is known.
[[nodiscard]] RootInterval known_root(const WidePolynomial& polynomial, const Dyadic& lower,
                                      const Dyadic& upper);

/// The interval is shorter than 2^-digits times what it is away from 0 or 1, whichever is nearer.
[[nodiscard]] bool has_digits(const RootInterval& root, unsigned digits);

/// A number between two of [0,1], with few digits, that halves the interval where its ends are of one scale
/// and else comes as near to the end by which the scale is wide as halving their exponents does: towards 0
/// and 1 scales are without end.
[[nodiscard]] Dyadic split_point(const Dyadic& lower, const Dyadic& upper);

}  // namespace kds
