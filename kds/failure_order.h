#pragma once
// The total order of failures within a step: exact time, then the certificate's identity, then its structure
// and place there. Never an address or the order of creation, so every kernel and every run orders alike.

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "certificates/base/certificate.h"
#include "certificates/base/failure_time.h"
#include "certificates/exact/instant.h"

namespace kds {

/// A holder of certificates in the queue.
class ScheduledSource : public CertificateSource {
 public:
  [[nodiscard]] virtual Identity identity(std::uint32_t slot) const = 0;
  /// Which sign of its identity's function the certificate wants.
  [[nodiscard]] virtual bool side(std::uint32_t) const { return true; }
  /// Breaks ties between certificates of one function: unique within a run for live certificates.
  [[nodiscard]] virtual std::uint64_t place(std::uint32_t slot) const = 0;
  /// The failure comes near: see EventQueue.
  virtual void fetch(std::uint32_t slot, unsigned bins_ahead) const {
    static_cast<void>(slot);
    static_cast<void>(bins_ahead);
  }
};

struct ScheduledFailure {
  FailureTime time;
  std::uint32_t tie = 0;  ///< same non-zero number: known to be the same time
  std::uint32_t slot = 0;
  ScheduledSource* source = nullptr;

  [[nodiscard]] Identity identity() const { return source->identity(slot); }
};

struct ComparisonCounts {
  std::uint64_t by_identity = 0;  ///< overlapping brackets of one function: the same time
  std::uint64_t exact = 0;        ///< overlapping brackets settled on integers
  std::uint64_t ties = 0;         ///< of those, equal times of different functions
};

class FailureOrder {
 public:
  /// Strict: a before b, narrowing both where their brackets overlap.
  [[nodiscard]] bool before(ScheduledFailure& a, ScheduledFailure& b) {
    // Apart, nearly always; which one is earlier no one foretells: no branch on that.
    if (std::max(a.time.lower, b.time.lower) > std::min(a.time.upper, b.time.upper)) [[likely]]
      return a.time.lower < b.time.lower;
    return before_closely(a, b);
  }
  [[nodiscard]] static double earliest(const ScheduledFailure& f) { return f.time.lower; }
  [[nodiscard]] static double latest(const ScheduledFailure& f) { return f.time.upper; }
  static void fetch(const ScheduledFailure& f, unsigned bins_ahead) { f.source->fetch(f.slot, bins_ahead); }
  /// -1, 0, 1 by time alone.
  [[nodiscard]] int compare_times(ScheduledFailure& a, ScheduledFailure& b);

  [[nodiscard]] const ComparisonCounts& counts() const { return counts_; }

 private:
  [[nodiscard]] bool before_closely(ScheduledFailure& a, ScheduledFailure& b);
  /// `one_function` becomes true if they are at the same time for being of one function.
  [[nodiscard]] int compare(ScheduledFailure& a, ScheduledFailure& b, bool& one_function);

  ComparisonCounts counts_;
  std::uint32_t next_tie_ = 1;
};

}  // namespace kds
