#include "certificates/search/define_certificate_search.h"
#include "certificates/types/contact.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<Contact>> search_over(const MotionRef<1>& motion) {
  return detail::search_one_by_one<Contact>(motion);
}
template std::unique_ptr<CertificateSearch<Contact>> search_over(const MotionRef<2>&);
template std::unique_ptr<CertificateSearch<Contact>> search_over(const MotionRef<3>&);

}  // namespace kds
