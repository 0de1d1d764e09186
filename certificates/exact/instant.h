#pragma once
// Times at which certificates fail, as brackets in doubles and roots of functions. This header knows no exact
// numbers, so that files which only hand times on need not parse them.

#include <cstdint>
#include <memory>
#include <optional>

namespace kds {

class Dyadic;
class ExactPolynomial;
class ExactTime;

/// The stage of the failure-time cascade that decided a failure time (docs/exactness.md). A certificate that
/// shares another one's search has its stage. Like counts of work, the stage of a time depends on where a run
/// starts or is cut.
enum class DecidedBy : std::uint8_t {
  unknown,    ///< no stage: the time is not that of a certificate that failed, or comes from a log
  isolation,  ///< doubles with proved error bounds
  refined,    ///< doubles, with error bounds followed operation by operation
  exact,      ///< integers
};

/// The time at which a certificate fails: a bracket of two doubles, and which root of the certificate's
/// function in the bracket is meant.
///
/// The time is root number `ordinal` (from 0, each root counted once) of the function in [lower, upper].
/// Together with the function, this determines the time exactly. If lower < upper, the time lies strictly
/// between them. If `isolating`, there is no other root in the bracket, and the function's signs at lower and
/// upper are proved to differ. The function is the certificate's own, which turns negative at the time. For a
/// radical certificate it is a polynomial that has all roots of the certificate's function (the norm,
/// radical.h) and may change sign in either direction.
struct FailureTime {
  double lower = 0;
  double upper = 0;
  std::uint16_t ordinal = 0;
  bool isolating = true;
  bool touch = false;  ///< the function only touches zero there, which is no failure, see TouchPolicy
  bool last = false;   ///< known to be the function's last root in the step, and not at its end
  DecidedBy decided_by = DecidedBy::unknown;
};
static_assert(sizeof(FailureTime) == 24, "the queue holds failure times: keep them small");

/// Whether a structure is notified when a function touches zero without changing sign. A touch is not a
/// failure. However, motions in general position have no touches, so a structure may have to examine itself
/// at one.
enum class TouchPolicy : std::uint8_t { ignored, reported };

/// The result of searching a new certificate. A certificate that never fails has its own kind, not a large
/// time.
struct Failure {
  enum class Kind : std::uint8_t {
    never,     ///< holds for the rest of the step
    zero,      ///< the function is zero on the whole step, so it never fails either
    later,     ///< fails at `time`, before the end of the step, or only touches zero then
    at_birth,  ///< does not hold just after the present time
  };
  Kind kind = Kind::never;
  FailureTime time{};
};

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

/// The present time of a run within a step, as certificates need it: a bracket in doubles, and the exact
/// number behind it, computed only if the exact stage asks for it.
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
