#pragma once
// Searches of the order, orientation, power test and distance of beads and of the sizes of simplices, each
// compiled once per dimension. Only queries need a declaration.

#include "certificates/search/certificate_search.h"
#include "certificates/types/orientation.h"
#include "certificates/types/simplex_size.h"

namespace kds {

/// Makes searches for the queries about faces of a hull (orientation.h): signs at one moment, one at
/// a time. For a lifted motion they use its centres.
template <int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<SameTurn<Dimension>>> same_turn_search(
    const MotionRef<Dimension>& motion);
template <int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<CentroidInside<Dimension>>> centroid_search(
    const MotionRef<Dimension>& motion);

/// Makes the search for the query whether a face is attached (simplex_size.h): signs at one moment, one at a
/// time.
template <std::size_t N, int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<CentreSide<N>>> centre_side_search(
    const MotionRef<Dimension>& motion);

}  // namespace kds
