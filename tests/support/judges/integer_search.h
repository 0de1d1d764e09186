#pragma once
// Computes failures and signs of single certificates with integers alone, for tests of faster ways to compute
// them.

#include "certificates/search/certificate_search.h"
#include "certificates/search/sphere_searches.h"

namespace kds::test {

template <class Certificate, Motion M>
[[nodiscard]] auto search_for(const Certificate&, const M& motion) {
  return search_over<Certificate>(MotionRef<M::dimension>(motion));
}

template <class Certificate, Motion M>
[[nodiscard]] Failure integer_first_failure(const Certificate& certificate, const M& motion,
                                            const Instant& now, KnownAtStart known = KnownAtStart::unknown) {
  StageCounts stages;
  Failure failure;
  search_for(certificate, motion)
      ->first_failures(Kernel::exact, {&certificate, 1}, now, {&known, 1}, stages, TouchPolicy::ignored,
                       {&failure, 1});
  return failure;
}

template <class Certificate, Motion M>
[[nodiscard]] int integer_sign_now(const Certificate& certificate, const M& motion, const Instant& now) {
  StageCounts stages;
  return search_for(certificate, motion)->sign_now(Kernel::exact, certificate, now, stages);
}

template <class Certificate, Motion M>
[[nodiscard]] int integer_sign_just_after(const Certificate& certificate, const M& motion,
                                          const Instant& now) {
  StageCounts stages;
  return search_for(certificate, motion)->sign_just_after(Kernel::exact, certificate, now, stages);
}

}  // namespace kds::test
