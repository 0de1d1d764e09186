#pragma once
// The rows of `kds stability` on a terminal: a block a subject, a line an extreme.

#include <span>
#include <string>

#include "experiments/stability/stability_row.h"

namespace kds {

/// At most 120 columns but for reasons; ends with a newline.
[[nodiscard]] std::string stability_table(std::span<const StabilityRow> rows);

}  // namespace kds
