#include "certificates/search/sphere_searches.h"

#include "certificates/search/define_certificate_search.h"
#include "certificates/search/define_radical_search.h"
#include "certificates/types/bead_in_sphere.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 1>>> search_over(const MotionRef<2>& motion) {
  return radical_search_over<BallInSphere<2, 1>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 2>>> search_over(const MotionRef<2>& motion) {
  return radical_search_over<BallInSphere<2, 2>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<2, 3>>> search_over(const MotionRef<2>& motion) {
  return radical_search_over<BallInSphere<2, 3>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 1>>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallInSphere<3, 1>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 2>>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallInSphere<3, 2>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 3>>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallInSphere<3, 3>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 4>>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallInSphere<3, 4>>(motion);
}

// A basis of one bead: the beads coincide, which is rare.
template <>
std::unique_ptr<CertificateSearch<BeadInSphere<1>>> search_over(const MotionRef<2>& motion) {
  return detail::search_one_by_one<BeadInSphere<1>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BeadInSphere<1>>> search_over(const MotionRef<3>& motion) {
  return detail::search_one_by_one<BeadInSphere<1>>(motion);
}
template std::unique_ptr<CertificateSearch<BeadInSphere<2>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<BeadInSphere<2>>> search_over(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<BeadInSphere<3>>> search_over(const MotionRef<3>&);

}  // namespace kds
