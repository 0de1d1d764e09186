#pragma once
// What one subject did in one extreme: a row of `kds stability`.

#include <cstdint>
#include <string>
#include <vector>

#include "certificates/base/stage_counts.h"
#include "experiments/stability/event_difference.h"

namespace kds {

struct KernelSeconds {
  double fast = 0, filtered = 0, exact = 0;
};

struct StabilityRow {
  std::string subject;
  bool structure = false;  ///< else a certificate type
  int dimension = 0;
  int degree = 0;           ///< of the motion
  int function_degree = 0;  ///< of the certificate; a structure has several: 0
  std::string extreme;
  bool must_refuse = false;  ///< numbers without an exact value

  std::uint64_t cases = 0;
  std::uint64_t events = 0;         ///< exact ones, of all cases
  std::uint64_t signs = 0;          ///< compared, certificates only
  std::uint64_t disagreements = 0;  ///< cases in which `filtered` is not `exact`
  std::uint64_t refused = 0;        ///< cases that both refuse
  std::uint64_t failed = 0;         ///< cases that end in an internal failure, a failed audit too
  std::string reason;               ///< the first refusal, or failure, or disagreement, in words
  std::string motion;               ///< of the first failure or disagreement, as an instance file

  std::uint64_t wrong_signs = 0;  ///< of `fast`, likewise the next
  EventDifference fast;
  std::uint64_t fast_gave_up = 0;  ///< cases in which `fast` answers by an error, and `exact` does not
  std::string fast_reason;         ///< the first such error
  StageCounts stages;              ///< of `filtered`
  std::uint64_t rebuilds = 0;      ///< of `filtered`
  std::uint64_t audits_run = 0, audits_failed = 0;
  KernelSeconds seconds;  ///< medians over cases: a certificate's search, a structure's run

  [[nodiscard]] bool holds() const {
    return disagreements == 0 && failed == 0 && audits_failed == 0 && (!must_refuse || refused == cases);
  }
};

/// 0 of none.
[[nodiscard]] double median(std::vector<double> values);

void add(EventDifference& sum, const EventDifference& difference);

/// The first trouble of a row is kept in words, and how to see it again.
void note_trouble(StabilityRow& row, std::size_t number, const std::string& reason,
                  const std::string& motion);

}  // namespace kds
