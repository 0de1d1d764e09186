// Searches that no structure needs, for their rows in `kds bench certificates`.
#include "certificates/search/define_certificate_search.h"
#include "certificates/types/bead_in_sphere.h"

namespace kds {

template std::unique_ptr<CertificateSearch<BeadInSphere<2>>> search_over(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<BeadInSphere<3>>> search_over(const MotionRef<3>&);

}  // namespace kds
