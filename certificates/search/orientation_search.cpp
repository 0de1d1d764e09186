#include "certificates/search/define_certificate_search.h"
#include "certificates/types/orientation.h"

namespace kds {

template std::unique_ptr<CertificateSearch<Orientation<2>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<Orientation<3>>> search_over(const MotionRef<3>&);

}  // namespace kds
