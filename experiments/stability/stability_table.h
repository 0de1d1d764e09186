#pragma once
// Shows the rows of `kds stability` on a terminal: a block per subject, a line per extreme.

#include <span>
#include <string>

#include "experiments/stability/stability_row.h"

namespace kds {

/// Returns the table. Lines have at most 120 columns, reasons excepted. The text ends with a newline.
[[nodiscard]] std::string stability_table(std::span<const StabilityRow> rows);

}  // namespace kds
