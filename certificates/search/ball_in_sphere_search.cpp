#include "certificates/search/ball_in_sphere_search.h"

#include "certificates/search/define_radical_search.h"

namespace kds {

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

}  // namespace kds
