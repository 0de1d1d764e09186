#include "certificates/search/hull_search.h"

#include "certificates/search/define_certificate_search.h"

namespace kds {

template <int Dimension>
std::unique_ptr<CertificateSearch<SameTurn<Dimension>>> same_turn_search(const MotionRef<Dimension>& motion) {
  return detail::search_one_by_one<SameTurn<Dimension>>(motion);
}
template <int Dimension>
std::unique_ptr<CertificateSearch<CentroidInside<Dimension>>> centroid_search(
    const MotionRef<Dimension>& motion) {
  return detail::search_one_by_one<CentroidInside<Dimension>>(motion);
}

template std::unique_ptr<CertificateSearch<SameTurn<2>>> same_turn_search(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<SameTurn<3>>> same_turn_search(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<CentroidInside<2>>> centroid_search(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<CentroidInside<3>>> centroid_search(const MotionRef<3>&);

}  // namespace kds
