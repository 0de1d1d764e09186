#pragma once
// The walk of a radical certificate along the roots of its norm to its first failure, in double.

#include <optional>

#include "certificates/search/careful_search.h"

namespace kds {

/// A radical certificate in double, of any type.
class RadicalInDouble {
 public:
  virtual ~RadicalInDouble() = default;

  [[nodiscard]] virtual const BoundedPolynomial& norm() const = 0;
  /// Returns 1 or -1 if that is certainly the sign on all of [lower, upper], else 0.
  [[nodiscard]] virtual int certain_sign_on(double lower, double upper) const = 0;
  /// Returns the same for a known sign of the norm, or 0.
  [[nodiscard]] virtual int sign_by_norm(int norm_sign, double lower, double upper) const = 0;
  /// Returns the norm's sign where the certificate holds, if opposite signs of A and B on all of [lower,
  /// upper] determine it, else 0. At an isolating failure time the norm changes its sign, so just after it
  /// the norm has the opposite sign.
  [[nodiscard]] virtual int norm_while_it_holds(double lower, double upper) const = 0;
  /// Returns whether the certificate is certainly usable (radical.h) on all of [lower, upper].
  [[nodiscard]] virtual bool is_usable_on(double lower, double upper) const = 0;
  /// Returns the norm's sign at a time, or 0 if unknown.
  [[nodiscard]] virtual int certain_norm_at(double u) const = 0;
};

/// Returns the failure that doubles prove for a certificate, or nothing. At its own root, the certificate has
/// no other root in the bracket, so it still holds at the upper end.
[[nodiscard]] std::optional<Failure> proved_failure(const RadicalInDouble& certificate, const Instant& now,
                                                    KnownAtStart known);

/// Returns the failure as computed in double, without proof: every sign is taken as computed.
[[nodiscard]] Failure fast_first_failure(const RadicalInDouble& certificate, const Instant& now,
                                         KnownAtStart known, StageCounts& stages);

}  // namespace kds
