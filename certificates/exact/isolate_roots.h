#pragma once
// The roots of a polynomial on [0,1], each in an interval of its own: Descartes' rule of signs on parts of
// the step, by the polynomial's leading digits where these tell. Exact.

#include <functional>
#include <vector>

#include "certificates/exact/exact_polynomial.h"

namespace kds {

/// Takes one root; returns whether the next one is wanted.
using RootVisitor = std::function<bool(RootInterval)>;

/// Visits the roots of a square-free polynomial in [lower, upper], ascending; their intervals are disjoint
/// but for touching ends.
void visit_roots(const ExactPolynomial& square_free, const Dyadic& lower, const Dyadic& upper,
                 const RootVisitor& visit);

/// All the roots that visit_roots visits.
[[nodiscard]] std::vector<RootInterval> isolate_roots(const ExactPolynomial& square_free, const Dyadic& lower,
                                                      const Dyadic& upper);

/// A number between two of [0,1], with few digits, that halves the interval where its ends are of one scale
/// and else comes as near to the end by which the scale is wide as halving their exponents does: towards 0
/// and 1 scales are without end.
[[nodiscard]] Dyadic split_point(const Dyadic& lower, const Dyadic& upper);

}  // namespace kds
