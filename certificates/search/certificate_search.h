#pragma once
// The failure-time cascade of one certificate type over one motion, behind calls by batches: from
// certificates and the present time to their first failures in this step. Compiled once for a type and a
// dimension (define_certificate_search.h); who uses it includes none of it. `filtered` and `exact` answer
// exactly, `fast` approximately (kernel.h).

#include <cstdint>
#include <memory>
#include <span>

#include "certificates/base/certificate.h"
#include "certificates/base/constants.h"
#include "certificates/base/failure_time.h"
#include "certificates/base/kernel.h"
#include "certificates/base/stage_counts.h"
#include "certificates/exact/instant.h"
#include "motions/curves/motion_ref.h"

namespace kds {

/// What the structure knows of a new certificate's function at the present time.
enum class KnownAtStart : std::uint8_t {
  unknown,
  /// The present time is a failure time of the same function (by its table's Identity) with the opposite
  /// sign: the function has a root right now and is positive just after. After a flip the same beads give the
  /// negated polynomial.
  at_own_root,
};

namespace detail {

template <class Certificate>
class TakesConstants {};
template <NeedsAnchors Certificate>
class TakesConstants<Certificate> {
 public:
  /// Of all certificates from now on. Throws std::invalid_argument where one cannot be a constant over the
  /// motion; what is asked before they are set throws std::logic_error.
  virtual void set_constants(const ConstantsOf<Certificate>& constants) = 0;

 protected:
  ~TakesConstants() = default;
};

}  // namespace detail

/// Of a type with constants or positions, used by one thread at a time.
template <class Certificate>
class CertificateSearch : public detail::TakesConstants<Certificate> {
 public:
  virtual ~CertificateSearch() = default;

  /// When each of these, born now, fails for the first time in the motion's step. All that are born at their
  /// own root have one function, the one that is zero now: it is searched once.
  virtual void first_failures(Kernel kernel, std::span<const Certificate> certificates, const Instant& now,
                              std::span<const KnownAtStart> known, StageCounts& stages, TouchPolicy touches,
                              std::span<Failure> failures) const = 0;

  /// The sign now: 1, 0 or -1.
  [[nodiscard]] virtual int sign_now(Kernel kernel, const Certificate& certificate, const Instant& now,
                                     StageCounts& stages) const = 0;
  /// The sign just after now: 1, -1, or 0 if the function is zero from now on for a while.
  [[nodiscard]] virtual int sign_just_after(Kernel kernel, const Certificate& certificate, const Instant& now,
                                            StageCounts& stages) const = 0;
  /// Whether all are positive now.
  [[nodiscard]] virtual bool all_positive_now(Kernel kernel, std::span<const Certificate> certificates,
                                              const Instant& now, StageCounts& stages) const = 0;

  /// The sign just after `failed` has, another certificate with the same roots, as doubles know it, or 0.
  [[nodiscard]] virtual int sign_after_failure(const Certificate& certificate, const Certificate& failed,
                                               const Instant& now, StageCounts& stages) const {
    static_cast<void>(certificate);
    static_cast<void>(failed);
    static_cast<void>(now);
    static_cast<void>(stages);
    return 0;
  }

  /// The sign at a time of the step: 1, 0 or -1. Exact, by integers alone.
  [[nodiscard]] virtual int sign_at(const Certificate& certificate, const Dyadic& time) const = 0;
  /// The polynomial whose roots failure times of the certificate name. Exact.
  [[nodiscard]] virtual ExactFunction exact_function(const Certificate& certificate) const = 0;
};

/// Of a certificate type over any motion of the dimension. Throws std::invalid_argument where the motion is
/// lifted and the certificate asks for radii, and where its function has too high a degree over it. The
/// search throws std::logic_error where the motion's degree changes later.
template <class Certificate, int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<Certificate>> search_over(const MotionRef<Dimension>& motion);

}  // namespace kds
