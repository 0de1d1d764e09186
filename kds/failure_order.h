#pragma once
// The total order of failures within a step: by exact time, then by the certificate's identity, then by its
// structure and its place there. The order never depends on addresses or on the order of creation, so it is
// the same for every kernel and every run, and also for a run that starts at a later step.

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "certificates/base/certificate.h"
#include "certificates/exact/instant.h"

namespace kds {

/// Orders simultaneous failures of one function. Depends on the structure's state, not on the events that led
/// to this state.
struct TiePlace {
  std::uint32_t table = 0;  ///< of all tables of the run
  std::uint64_t place = 0;  ///< among the certificates of the table (KineticStructure::tie_of)

  friend auto operator<=>(const TiePlace&, const TiePlace&) = default;
};

/// The engine's side of a certificate table: an owner of certificates whose failures are in the queue.
class FailureSource : public CertificateSource {
 public:
  /// Handles the failure of the certificate in `slot`, which is the present event.
  virtual void fail(std::uint32_t slot) = 0;
  /// Called when the failure's time is past: the slot may be reused.
  virtual void retire(std::uint32_t slot) = 0;
  /// Called at the end of a step: discards all certificates.
  virtual void clear() = 0;
  [[nodiscard]] virtual std::size_t structure() const = 0;
  [[nodiscard]] virtual Identity identity(std::uint32_t slot) const = 0;
  /// Returns the sign of its identity's function that the certificate requires: true for positive.
  [[nodiscard]] virtual bool side(std::uint32_t) const { return true; }
  /// Breaks ties between certificates of one function. Unique among the live certificates of this function.
  [[nodiscard]] virtual TiePlace place(std::uint32_t slot) const = 0;
  /// Prefetches data of a failure that comes near; see EventQueue.
  virtual void fetch(std::uint32_t slot, unsigned bins_ahead) const {
    static_cast<void>(slot);
    static_cast<void>(bins_ahead);
  }
};

struct ScheduledFailure {
  FailureTime time;
  std::uint32_t tie = 0;  ///< failures with the same non-zero number are known to be at the same time
  std::uint32_t slot = 0;
  FailureSource* source = nullptr;

  [[nodiscard]] Identity identity() const { return source->identity(slot); }
};

struct ComparisonCounts {
  std::uint64_t by_identity = 0;  ///< overlapping brackets of one function: the same time
  std::uint64_t exact = 0;        ///< overlapping brackets settled on integers
  std::uint64_t ties = 0;         ///< exact comparisons that found equal times of different functions
};

class FailureOrder {
 public:
  /// Returns whether a is strictly before b. Narrows both times if their brackets overlap.
  [[nodiscard]] bool before(ScheduledFailure& a, ScheduledFailure& b) {
    // The brackets are nearly always disjoint. Which one is earlier cannot be predicted, so the comparison
    // does not branch on it.
    if (std::max(a.time.lower, b.time.lower) > std::min(a.time.upper, b.time.upper)) [[likely]]
      return a.time.lower < b.time.lower;
    return before_closely(a, b);
  }
  [[nodiscard]] static double earliest(const ScheduledFailure& f) { return f.time.lower; }
  [[nodiscard]] static double latest(const ScheduledFailure& f) { return f.time.upper; }
  static void fetch(const ScheduledFailure& f, unsigned bins_ahead) { f.source->fetch(f.slot, bins_ahead); }
  /// Returns -1, 0 or 1 by time alone.
  [[nodiscard]] int compare_times(ScheduledFailure& a, ScheduledFailure& b);

  [[nodiscard]] const ComparisonCounts& counts() const { return counts_; }
  void add(const ComparisonCounts& counts) {
    counts_.by_identity += counts.by_identity;
    counts_.exact += counts.exact;
    counts_.ties += counts.ties;
  }

 private:
  [[nodiscard]] bool before_closely(ScheduledFailure& a, ScheduledFailure& b);
  /// Sets `one_function` to true if both times are equal because both certificates have the same function.
  [[nodiscard]] int compare(ScheduledFailure& a, ScheduledFailure& b, bool& one_function);

  ComparisonCounts counts_;
  std::uint32_t next_tie_ = 1;
};

}  // namespace kds
