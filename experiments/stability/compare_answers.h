#pragma once
// Compares the answers of the kernels for one certificate.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "certificates/exact/exact_time.h"
#include "certificates/search/certificate_search.h"

namespace kds {

/// One answer of a kernel.
struct Answer {
  Failure failure;
  bool opposite = false;  ///< whether the opposite certificate gave the answer
};

/// A bound that exceeds the number of roots of every function here.
inline constexpr std::size_t most_answers = 64;

/// Returns the exact function of the certificate (false) or of its opposite (true).
using FunctionOfSide = std::function<ExactPolynomial(bool opposite)>;

/// Describes the first answer in which two histories differ, or returns nothing. Times are compared exactly.
[[nodiscard]] std::optional<std::string> disagreement(std::span<const Answer> filtered,
                                                      std::span<const Answer> exact,
                                                      const FunctionOfSide& function);

/// Returns the number of failures among the answers. An answer at the start of a step is no failure.
[[nodiscard]] std::uint64_t count_of_events(std::span<const Answer> answers);

}  // namespace kds
