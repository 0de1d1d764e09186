#include "certificates/search/relaxed_bead_in_sphere_search.h"

#include "certificates/search/define_certificate_search.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<2>>> search_over(const MotionRef<2>& motion) {
  return detail::search_one_by_one<RelaxedBeadInSphere<2>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<3>>> search_over(const MotionRef<2>& motion) {
  return detail::search_one_by_one<RelaxedBeadInSphere<3>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<2>>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<RelaxedBeadInSphere<2>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<3>>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<RelaxedBeadInSphere<3>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<4>>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<RelaxedBeadInSphere<4>>(motion);
}

}  // namespace kds
