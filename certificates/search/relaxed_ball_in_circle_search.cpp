#include "certificates/search/relaxed_ball_in_sphere_search.h"

#include "certificates/search/define_radical_search.h"

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

}  // namespace kds
