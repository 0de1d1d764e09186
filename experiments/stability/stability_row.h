#pragma once
// The results of one subject in one extreme: a row of `kds stability`.

#include <cstdint>
#include <string>
#include <vector>

#include "certificates/base/kernel.h"

namespace kds {

struct KernelSeconds {
  double filtered = 0, exact = 0;
};

struct StabilityRow {
  std::string subject;
  bool structure = false;  ///< a structure rather than a certificate type
  int dimension = 0;
  int degree = 0;           ///< the motion's degree
  int function_degree = 0;  ///< the certificate's degree; 0 for a structure, which has several functions
  std::string extreme;
  bool must_refuse = false;  ///< the extreme has numbers without an exact value

  std::uint64_t cases = 0;
  std::uint64_t events = 0;         ///< exact events over all cases
  std::uint64_t signs = 0;          ///< signs compared; certificates only
  std::uint64_t disagreements = 0;  ///< cases in which `filtered` differs from `exact`
  std::uint64_t refused = 0;        ///< cases that both kernels refuse
  std::uint64_t failed = 0;         ///< cases that end in an internal error or a failed audit
  std::string reason;               ///< description of the first refusal, failure or disagreement
  std::string motion;               ///< instance file of the first failure or disagreement

  StageCounts stages;          ///< of `filtered`
  std::uint64_t rebuilds = 0;  ///< of `filtered`
  std::uint64_t audits_run = 0, audits_failed = 0;
  KernelSeconds seconds;  ///< medians over cases: search of a certificate, run of a structure

  [[nodiscard]] bool holds() const {
    return disagreements == 0 && failed == 0 && audits_failed == 0 && (!must_refuse || refused == cases);
  }
};

/// Returns the median, or 0 if there are no values.
[[nodiscard]] double median(std::vector<double> values);

/// Keeps the first problem of a row: its description, and the data to reproduce it.
void note_trouble(StabilityRow& row, std::size_t number, const std::string& reason,
                  const std::string& motion);

}  // namespace kds
