#include "certificates/search/define_certificate_search.h"
#include "certificates/types/power_test.h"

namespace kds {

template std::unique_ptr<CertificateSearch<PowerTest<2>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<PowerTest<3>>> search_over(const MotionRef<3>&);

}  // namespace kds
