#include "certificates/search/support_searches.h"

#include "certificates/search/define_certificate_search.h"
#include "certificates/search/define_radical_search.h"

namespace kds {

template std::unique_ptr<CertificateSearch<ReachesFurther>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<ReachesFurther>> search_over(const MotionRef<3>&);

template <>
std::unique_ptr<CertificateSearch<BallReachesFurther>> search_over(const MotionRef<2>& motion) {
  return radical_search_over<BallReachesFurther>(motion);
}
template <>
std::unique_ptr<CertificateSearch<BallReachesFurther>> search_over(const MotionRef<3>& motion) {
  return radical_search_over<BallReachesFurther>(motion);
}

}  // namespace kds
