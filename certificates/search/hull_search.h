#pragma once
// Searches for the queries about faces of a hull (certificates/types/coplanar.h): signs at one moment, one at
// a time. For a lifted motion they use its centres.

#include "certificates/search/certificate_search.h"
#include "certificates/types/coplanar.h"

namespace kds {

template <int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<SameTurn<Dimension>>> same_turn_search(
    const MotionRef<Dimension>& motion);
template <int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<CentroidInside<Dimension>>> centroid_search(
    const MotionRef<Dimension>& motion);

}  // namespace kds
