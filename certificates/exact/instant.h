#pragma once
// The present time of a run within a step, as certificates need it: a bracket in doubles, and the exact
// number behind it, computed only if the exact stage asks for it.

#include <cstdint>
#include <memory>
#include <optional>

#include "certificates/base/failure_time.h"

namespace kds {

class Dyadic;
class ExactPolynomial;
class ExactTime;

/// A certificate's function with integer coefficients.
using ExactFunction = std::shared_ptr<const ExactPolynomial>;

/// Owners of certificates implement this interface to say exactly what the functions are.
class CertificateSource {
 public:
  virtual ~CertificateSource() = default;
  [[nodiscard]] virtual ExactFunction exact_function(std::uint32_t slot) const = 0;
};

/// Returns the root that a failure time stands for. Exact.
[[nodiscard]] ExactTime exact_time(const ExactPolynomial& function, const FailureTime& time);

/// Copies a narrower exact interval back into the doubles. The time must remain the only root of its
/// function.
void narrow(FailureTime& time, const ExactTime& exact);

class Instant {
 public:
  /// Constructs the start of a step or another time that is a double.
  explicit Instant(double u = 0) : time_{u, u, 0, false} {}
  explicit Instant(const Dyadic& u);
  /// Constructs a bracket without an exact number, for reports and not for decisions.
  explicit Instant(const FailureTime& time) : time_(time) {}
  /// Constructs the failure time of a certificate, which must stay available during the life of the instant.
  Instant(const FailureTime& time, const CertificateSource& source, std::uint32_t slot)
      : time_(time), source_(&source), slot_(slot) {}

  [[nodiscard]] double lower() const { return time_.lower; }
  [[nodiscard]] double upper() const { return time_.upper; }
  /// Returns whether the bracket separates this time from the other roots of its certificate's function.
  [[nodiscard]] bool isolating() const { return time_.isolating; }
  /// Returns whether this time is known to be the last root of its certificate's function in the step. Says
  /// nothing about other functions.
  [[nodiscard]] bool last() const { return time_.last; }
  /// Narrows the bracket once as far as doubles allow. Returns true if that had not been done before.
  bool narrow() const;
  /// Returns the exact number. Throws std::logic_error if only a bracket is known.
  [[nodiscard]] ExactTime& exact() const;
  /// Returns a new exact number for the same time, which can be narrowed independently of this instant.
  /// Returns nothing if only a bracket is known.
  [[nodiscard]] std::optional<ExactTime> exact_apart() const;

 private:
  struct Delete {  // so that this header need not include exact numbers
    void operator()(ExactTime* time) const;
  };

  mutable FailureTime time_;
  const CertificateSource* source_ = nullptr;
  std::uint32_t slot_ = 0;
  mutable std::unique_ptr<ExactTime, Delete> exact_;
  mutable bool narrowed_ = false;
};

}  // namespace kds
