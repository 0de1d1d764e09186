#pragma once
// Signs of certificates at a time, or just after it.

#include <cstdint>

#include "certificates/search/certificate_search.h"

namespace kds {

enum class Moment : std::uint8_t { now, just_after };

/// Returns the certificate's sign at the moment: CertificateSearch::sign_now or sign_just_after.
template <class Certificate>
[[nodiscard]] int sign_of(const CertificateSearch<Certificate>& search, Kernel kernel,
                          const Certificate& certificate, Moment moment, const Instant& time,
                          StageCounts& stages) {
  return moment == Moment::now ? search.sign_now(kernel, certificate, time, stages)
                               : search.sign_just_after(kernel, certificate, time, stages);
}

}  // namespace kds
