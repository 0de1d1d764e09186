#pragma once
// Searches single certificates over a motion. Each call constructs the search object that a structure would
// keep.

#include <algorithm>
#include <array>
#include <initializer_list>

#include "certificates/exact/exact_polynomial.h"
#include "certificates/exact/exact_time.h"
#include "certificates/search/certificate_search.h"

namespace kds::test {

/// Returns the identity with these beads in their order; unused entries are filled.
[[nodiscard]] inline Identity identity_with(std::uint32_t type, std::initializer_list<BeadId> beads) {
  Identity identity{type, {}};
  identity.beads.fill(no_bead);
  std::copy(beads.begin(), beads.end(), identity.beads.begin());
  return identity;
}

inline constexpr std::array all_kernels{Kernel::filtered, Kernel::exact};

template <class Certificate, Motion M>
[[nodiscard]] Failure first_failure(Kernel kernel, const Certificate& certificate, const M& motion,
                                    const Instant& now, KnownAtStart known, StageCounts& stages,
                                    TouchPolicy touches = TouchPolicy::ignored) {
  Failure failure;
  search_over<Certificate>(MotionRef<M::dimension>(motion))
      ->first_failures(kernel, {&certificate, 1}, now, {&known, 1}, stages, touches, {&failure, 1});
  return failure;
}

template <class Certificate, Motion M>
[[nodiscard]] int sign_now(Kernel kernel, const Certificate& certificate, const M& motion, const Instant& now,
                           StageCounts& stages) {
  return search_over<Certificate>(MotionRef<M::dimension>(motion))
      ->sign_now(kernel, certificate, now, stages);
}

template <class Certificate, Motion M>
[[nodiscard]] int sign_just_after(Kernel kernel, const Certificate& certificate, const M& motion,
                                  const Instant& now, StageCounts& stages) {
  return search_over<Certificate>(MotionRef<M::dimension>(motion))
      ->sign_just_after(kernel, certificate, now, stages);
}

template <class Certificate, Motion M>
[[nodiscard]] ExactPolynomial exact_function(const Certificate& certificate, const M& motion) {
  return *search_over<Certificate>(MotionRef<M::dimension>(motion))->exact_function(certificate);
}

}  // namespace kds::test
