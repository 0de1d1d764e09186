#include "certificates/search/predicate_searches.h"

#include "certificates/search/define_certificate_search.h"
#include "certificates/types/distances.h"
#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "certificates/types/precedes.h"
#include "certificates/types/segments.h"

namespace kds {

// The order along an axis is compiled in lanes for points with one coordinate, whose only structure is the
// sorted list.
template std::unique_ptr<CertificateSearch<Precedes>> search_over(const MotionRef<1>&);
template <>
std::unique_ptr<CertificateSearch<Precedes>> search_over(const MotionRef<2>& motion) {
  return detail::search_one_by_one<Precedes>(motion);
}
template <>
std::unique_ptr<CertificateSearch<Precedes>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<Precedes>(motion);
}
template <>
std::unique_ptr<CertificateSearch<PrecedesAlong<1>>> search_over(const MotionRef<2>& motion) {
  return detail::search_one_by_one<PrecedesAlong<1>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<PrecedesAlong<1>>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<PrecedesAlong<1>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<PrecedesAlong<2>>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<PrecedesAlong<2>>(motion);
}

template std::unique_ptr<CertificateSearch<Orientation<2>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<Orientation<3>>> search_over(const MotionRef<3>&);

template std::unique_ptr<CertificateSearch<PowerTest<2>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<PowerTest<3>>> search_over(const MotionRef<3>&);

template std::unique_ptr<CertificateSearch<Closer>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<Closer>> search_over(const MotionRef<3>&);

template <>
std::unique_ptr<CertificateSearch<Contact>> search_over(const MotionRef<1>& motion) {
  return detail::search_one_by_one<Contact>(motion);
}
template std::unique_ptr<CertificateSearch<Contact>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<Contact>> search_over(const MotionRef<3>&);

template std::unique_ptr<CertificateSearch<ImageContact>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<ImageContact>> search_over(const MotionRef<3>&);

template std::unique_ptr<CertificateSearch<DistanceBeyond>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<DistanceBeyond>> search_over(const MotionRef<3>&);

template std::unique_ptr<CertificateSearch<SegmentsOrientation>> search_over(const MotionRef<3>&);

// Asked for at few times only, where four points are coplanar.
template <>
std::unique_ptr<CertificateSearch<CrossComponent<0>>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<CrossComponent<0>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<CrossComponent<1>>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<CrossComponent<1>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<CrossComponent<2>>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<CrossComponent<2>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BeyondEnds>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<BeyondEnds>(motion);
}

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
