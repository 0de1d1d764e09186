#pragma once
// Whether two kernels said the same of one certificate, and what the approximate one got wrong.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "experiments/stability/event_difference.h"
#include "experiments/stability/follow_certificate.h"

namespace kds {

/// The exact function of the certificate (false) or its opposite (true).
using FunctionOfSide = std::function<ExactPolynomial(bool opposite)>;

/// In which answer two histories differ, in words, or nothing. Times are compared exactly.
[[nodiscard]] std::optional<std::string> disagreement(std::span<const Answer> filtered,
                                                      std::span<const Answer> exact,
                                                      const FunctionOfSide& function);

/// The failures among the answers, their brackets as they are.
[[nodiscard]] std::vector<TimedChange> failures_of(std::span<const Answer> answers);

/// The same, each narrowed to 2^-60 or less.
[[nodiscard]] std::vector<TimedChange> sharp_failures_of(std::span<const Answer> answers,
                                                         const FunctionOfSide& function);

}  // namespace kds
