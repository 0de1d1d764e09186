// The order of two beads along an axis. It is compiled in lanes for points with one coordinate, whose only
// structure is the sorted list.
#include "certificates/search/define_certificate_search.h"
#include "certificates/types/precedes.h"

namespace kds {

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

}  // namespace kds
