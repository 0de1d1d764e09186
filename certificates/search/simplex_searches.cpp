#include <cstddef>

#include "certificates/search/define_certificate_search.h"
#include "certificates/search/predicate_searches.h"
#include "certificates/types/simplex_size.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<SimplexSize<1>>> search_over(const MotionRef<2>& motion) {
  return detail::search_one_by_one<SimplexSize<1>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<SimplexSize<1>>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<SimplexSize<1>>(motion);
}
template std::unique_ptr<CertificateSearch<SimplexSize<2>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<SimplexSize<2>>> search_over(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<SimplexSize<3>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<SimplexSize<3>>> search_over(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<SimplexSize<4>>> search_over(const MotionRef<3>&);

template <std::size_t N, int Dimension>
std::unique_ptr<CertificateSearch<CentreSide<N>>> centre_side_search(const MotionRef<Dimension>& motion) {
  return detail::search_one_by_one<CentreSide<N>>(motion);
}

template std::unique_ptr<CertificateSearch<CentreSide<2>>> centre_side_search(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<CentreSide<2>>> centre_side_search(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<CentreSide<3>>> centre_side_search(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<CentreSide<3>>> centre_side_search(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<CentreSide<4>>> centre_side_search(const MotionRef<3>&);

}  // namespace kds
