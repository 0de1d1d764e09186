#include "certificates/search/define_certificate_search.h"
#include "certificates/types/closer.h"

namespace kds {

template std::unique_ptr<CertificateSearch<Closer>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<Closer>> search_over(const MotionRef<3>&);

}  // namespace kds
