#pragma once
// The failure-time cascade of one certificate type over one motion, behind virtual calls on batches. The
// search takes certificates and the present time, and finds the first failures of the certificates in this
// step. The search is compiled once for each type and dimension (define_certificate_search.h), and users need
// not include that code. All answers are exact.

#include <cstdint>
#include <memory>
#include <span>

#include "certificates/base/certificate.h"
#include "certificates/base/constants.h"
#include "certificates/base/kernel.h"
#include "certificates/exact/instant.h"
#include "motions/curves/motion_ref.h"

namespace kds {

/// Knowledge of the structure about a new certificate's function at the present time.
enum class KnownAtStart : std::uint8_t {
  unknown,
  /// The present time is a failure time of the same function (by its table's Identity) with the opposite
  /// sign: the function has a root right now and is positive just after. This happens after a flip, when
  /// the same beads give the negated polynomial.
  at_own_root,
};

namespace detail {

template <class Certificate>
class TakesConstants {};
template <NeedsAnchors Certificate>
class TakesConstants<Certificate> {
 public:
  /// Sets the constants of all certificates from now on. Throws std::invalid_argument if a value cannot be a
  /// constant over the motion. Queries before the constants are set throw std::logic_error.
  virtual void set_constants(const ConstantsOf<Certificate>& constants) = 0;

 protected:
  ~TakesConstants() = default;
};

}  // namespace detail

/// The search of one certificate type. A search of a type with constants or positions may be used by one
/// thread at a time.
template <class Certificate>
class CertificateSearch : public detail::TakesConstants<Certificate> {
 public:
  virtual ~CertificateSearch() = default;

  /// Finds when each of these certificates, born now, first fails in the motion's step. All certificates born
  /// at their own root share one function, the one that is zero now, which is searched once.
  virtual void first_failures(Kernel kernel, std::span<const Certificate> certificates, const Instant& now,
                              std::span<const KnownAtStart> known, StageCounts& stages, TouchPolicy touches,
                              std::span<Failure> failures) const = 0;

  /// Returns the sign now: 1, 0 or -1.
  [[nodiscard]] virtual int sign_now(Kernel kernel, const Certificate& certificate, const Instant& now,
                                     StageCounts& stages) const = 0;
  /// Returns the sign just after now: 1, -1, or 0 if the function is zero for a while from now on.
  [[nodiscard]] virtual int sign_just_after(Kernel kernel, const Certificate& certificate, const Instant& now,
                                            StageCounts& stages) const = 0;
  /// Returns whether all certificates are positive now.
  [[nodiscard]] virtual bool all_positive_now(Kernel kernel, std::span<const Certificate> certificates,
                                              const Instant& now, StageCounts& stages) const = 0;

  /// Returns the certificate's sign just after the failure of `failed`, another certificate with the same
  /// roots. Returns 0 if doubles do not decide it.
  [[nodiscard]] virtual int sign_after_failure(const Certificate& certificate, const Certificate& failed,
                                               const Instant& now, StageCounts& stages) const {
    static_cast<void>(certificate);
    static_cast<void>(failed);
    static_cast<void>(now);
    static_cast<void>(stages);
    return 0;
  }

  /// Returns the sign at a time of the step: 1, 0 or -1. Exact, computed with integers only.
  [[nodiscard]] virtual int sign_at(const Certificate& certificate, const Dyadic& time) const = 0;
  /// Returns the polynomial that the certificate's failure times are roots of. Exact.
  [[nodiscard]] virtual ExactFunction exact_function(const Certificate& certificate) const = 0;
};

/// Returns the search of a certificate type over any motion of the dimension. Throws std::invalid_argument if
/// the motion is lifted and the certificate does not suit it, or if the function's degree over the motion is
/// too high. The search throws std::logic_error if the motion's degree changes later.
template <class Certificate, int Dimension>
[[nodiscard]] std::unique_ptr<CertificateSearch<Certificate>> search_over(const MotionRef<Dimension>& motion);

}  // namespace kds
