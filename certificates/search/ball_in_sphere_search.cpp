#include "certificates/search/define_radical_search.h"
#include "certificates/types/ball_in_sphere.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<BallInSphere<3, 4>>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallInSphere<3, 4>>(motion);
}

}  // namespace kds
