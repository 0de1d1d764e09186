#include "certificates/search/relaxed_ball_in_sphere_search.h"

#include "certificates/search/define_radical_search.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 4, true>>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallInSphere<3, 4, true>>(motion);
}

}  // namespace kds
