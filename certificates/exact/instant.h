#pragma once
// The present time of a run within a step, as certificates need it: a bracket in doubles and, only when the
// exact stage asks, the exact number behind it.

#include <cstdint>
#include <memory>
#include <optional>

#include "certificates/base/failure_time.h"

namespace kds {

class Dyadic;
class ExactPolynomial;
class ExactTime;

/// A certificate's function on whole numbers.
using ExactFunction = std::shared_ptr<const ExactPolynomial>;

/// Whoever holds certificates can say exactly what their functions are.
class CertificateSource {
 public:
  virtual ~CertificateSource() = default;
  [[nodiscard]] virtual ExactFunction exact_function(std::uint32_t slot) const = 0;
};

/// The root that a failure time stands for. Exact.
[[nodiscard]] ExactTime exact_time(const ExactPolynomial& function, const FailureTime& time);

/// Carries a narrower exact interval back into the doubles. The time must stay the only root of its function.
void narrow(FailureTime& time, const ExactTime& exact);

class Instant {
 public:
  /// The start of a step, or another time that is a double.
  explicit Instant(double u = 0) : time_{u, u, 0, false} {}
  explicit Instant(const Dyadic& u);
  /// A bracket with nothing behind it: for reports, not for decisions.
  explicit Instant(const FailureTime& time) : time_(time) {}
  /// The failure time of a certificate, which must stay available while the instant lasts.
  Instant(const FailureTime& time, const CertificateSource& source, std::uint32_t slot)
      : time_(time), source_(&source), slot_(slot) {}

  [[nodiscard]] double lower() const { return time_.lower; }
  [[nodiscard]] double upper() const { return time_.upper; }
  /// The bracket separates this time from the other roots of its certificate's function.
  [[nodiscard]] bool isolating() const { return time_.isolating; }
  /// It is known to be the last root of that function in the step; of no other function this tells anything.
  [[nodiscard]] bool last() const { return time_.last; }
  /// Narrows the bracket as far as doubles go, once: true if that was still to be done.
  bool narrow() const;
  /// Throws std::logic_error where there is a bracket and nothing behind it.
  [[nodiscard]] ExactTime& exact() const;
  /// Returns a new exact number for the same time, which can be narrowed independently of this instant.
  /// Returns nothing if only a bracket is known.
  [[nodiscard]] std::optional<ExactTime> exact_apart() const;

 private:
  struct Delete {  // so that exact numbers are included only by those who use them
    void operator()(ExactTime* time) const;
  };

  mutable FailureTime time_;
  const CertificateSource* source_ = nullptr;
  std::uint32_t slot_ = 0;
  mutable std::unique_ptr<ExactTime, Delete> exact_;
  mutable bool narrowed_ = false;
};

}  // namespace kds
