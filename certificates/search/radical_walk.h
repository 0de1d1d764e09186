#pragma once
// The walk of a radical certificate along the roots of its norm to its first failure, in double.

#include <optional>

#include "certificates/search/careful_search.h"

namespace kds {

/// A radical certificate in double, whatever its type.
class RadicalInDouble {
 public:
  virtual ~RadicalInDouble() = default;

  [[nodiscard]] virtual const BoundedPolynomial& norm() const = 0;
  /// 1 or -1 if that is the sign all over [lower, upper] for certain, else 0.
  [[nodiscard]] virtual int certain_sign_on(double lower, double upper) const = 0;
  /// The same where the norm's sign is known, or 0.
  [[nodiscard]] virtual int sign_by_norm(int norm_sign, double lower, double upper) const = 0;
  /// The norm's sign where the certificate holds, as A and B of opposite signs all over [lower, upper] tell,
  /// else 0. At an isolating failure time, where the norm changes its sign, it has the other just after.
  [[nodiscard]] virtual int norm_while_it_holds(double lower, double upper) const = 0;
  /// Whether the certificate may be in use (radical.h) all over [lower, upper], for certain.
  [[nodiscard]] virtual bool is_usable_on(double lower, double upper) const = 0;
  /// The norm's sign at a time, or 0.
  [[nodiscard]] virtual int certain_norm_at(double u) const = 0;
};

/// What doubles prove of a certificate, or nothing. At its own root the bracket holds no other one, so at its
/// upper end it still holds.
[[nodiscard]] std::optional<Failure> proved_failure(const RadicalInDouble& certificate, const Instant& now,
                                                    KnownAtStart known);

/// What doubles say of it where nothing is certain and everything taken to be.
[[nodiscard]] Failure fast_first_failure(const RadicalInDouble& certificate, const Instant& now,
                                         KnownAtStart known, StageCounts& stages);

}  // namespace kds
