#pragma once
// Declares search_over for balls that reach further along a direction than others. Code that makes tables of
// BallReachesFurther includes this header, because a specialization must be declared before it is used.

#include "certificates/search/certificate_search.h"
#include "certificates/types/reaches_further.h"

namespace kds {

template <>
std::unique_ptr<CertificateSearch<BallReachesFurther>> search_over(const MotionRef<2>& motion);
template <>
std::unique_ptr<CertificateSearch<BallReachesFurther>> search_over(const MotionRef<3>& motion);

}  // namespace kds
