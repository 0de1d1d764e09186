// A search that the library does not compile: in the plane, the sphere through three beads is not needed
// besides the one through two.
#include "certificates/search/define_certificate_search.h"
#include "certificates/types/bead_in_sphere.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<BeadInSphere<3>>> search_over(const MotionRef<2>& motion) {
  return detail::search_one_by_one<BeadInSphere<3>>(motion);
}

}  // namespace kds
