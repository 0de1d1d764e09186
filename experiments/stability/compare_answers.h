#pragma once
// Counts the errors of an approximate history, and of the answers for one certificate, against the exact
// kernel.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "certificates/search/certificate_search.h"
#include "kds/kinetic_structure.h"

namespace kds {

struct TimedChange {
  Change change;
  double lower = 0, upper = 0;  ///< the time lies strictly between both, or equals both
};

struct EventDifference {
  std::uint64_t missed = 0;     ///< events only in the exact history
  std::uint64_t extra = 0;      ///< events only in the other history
  double worst_time_error = 0;  ///< largest error of the matched events outside the exact bracket
};

/// Matches each event with an event of the same change, in order. Leaves as few events as possible unmatched,
/// then minimizes the errors. Both histories are in order of time.
[[nodiscard]] EventDifference event_difference(std::span<const TimedChange> exact,
                                               std::span<const TimedChange> other);

/// One answer of a kernel.
struct Answer {
  Failure failure;
  bool opposite = false;  ///< whether the opposite certificate gave the answer
};

/// Returns the exact function of the certificate (false) or of its opposite (true).
using FunctionOfSide = std::function<ExactPolynomial(bool opposite)>;

/// Describes the first answer in which two histories differ, or returns nothing. Times are compared exactly.
[[nodiscard]] std::optional<std::string> disagreement(std::span<const Answer> filtered,
                                                      std::span<const Answer> exact,
                                                      const FunctionOfSide& function);

/// Returns the failures among the answers with their brackets unchanged.
[[nodiscard]] std::vector<TimedChange> failures_of(std::span<const Answer> answers);

/// Returns the failures among the answers with each bracket narrowed to at most 2^-60.
[[nodiscard]] std::vector<TimedChange> sharp_failures_of(std::span<const Answer> answers,
                                                         const FunctionOfSide& function);

}  // namespace kds
