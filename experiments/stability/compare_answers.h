#pragma once
// Compares the answers of two kernels for one certificate, and counts the errors of the approximate kernel.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "experiments/stability/event_difference.h"
#include "experiments/stability/follow_certificate.h"

namespace kds {

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
