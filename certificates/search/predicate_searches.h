#pragma once
// Searches of the order, orientation, power test and distance of beads, each compiled once per dimension.
// Only the queries about faces of a hull need a declaration.

#include "certificates/search/certificate_search.h"
#include "certificates/types/orientation.h"

namespace kds {

/// Makes searches for the queries about faces of a hull (orientation.h): signs at one moment, one at
/// a time. For a lifted motion they use its centres.
template <int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<SameTurn<Dimension>>> same_turn_search(
    const MotionRef<Dimension>& motion);
template <int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<CentroidInside<Dimension>>> centroid_search(
    const MotionRef<Dimension>& motion);

}  // namespace kds
