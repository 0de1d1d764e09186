#include "certificates/search/define_certificate_search.h"
#include "certificates/types/relaxed_bead_in_sphere.h"

namespace kds {

template std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<2>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<3>>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<2>>> search_over(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<3>>> search_over(const MotionRef<3>&);
template std::unique_ptr<CertificateSearch<RelaxedBeadInSphere<4>>> search_over(const MotionRef<3>&);

}  // namespace kds
