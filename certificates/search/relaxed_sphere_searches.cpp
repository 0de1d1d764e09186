#include "certificates/search/relaxed_sphere_searches.h"

#include "certificates/search/define_certificate_search.h"
#include "certificates/search/define_radical_search.h"
#include "certificates/types/bead_in_sphere.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 1, true>>> search_over(const MotionRef<2>& motion) {
  return radical_search_over<BallInSphere<2, 1, true>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 2, true>>> search_over(const MotionRef<2>& motion) {
  return radical_search_over<BallInSphere<2, 2, true>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 3, true>>> search_over(const MotionRef<2>& motion) {
  return radical_search_over<BallInSphere<2, 3, true>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 1, true>>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallInSphere<3, 1, true>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 2, true>>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallInSphere<3, 2, true>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 3, true>>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallInSphere<3, 3, true>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 4, true>>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallInSphere<3, 4, true>>(motion);
}

template std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<2>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<3>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<2>>> search_over(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<3>>> search_over(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<4>>> search_over(const MotionRef<3>&);

}  // namespace kds
