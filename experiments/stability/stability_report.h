#pragma once
// The rows of `kds stability` for programs: JSON and CSV. For people: stability_table.h.

#include <optional>
#include <span>
#include <string>

#include "experiments/output/result_json.h"
#include "experiments/stability/stability_options.h"
#include "experiments/stability/stability_row.h"

namespace kds {

[[nodiscard]] Json stability_settings(const StabilityOptions& options);

/// One object: command, settings, rows, holds, version, machine. Ends with a newline.
[[nodiscard]] std::string stability_json(std::string command, const StabilityOptions& options,
                                         std::span<const StabilityRow> rows);

/// One line a row, under a header.
[[nodiscard]] std::string stability_csv(std::span<const StabilityRow> rows);

/// What to say, and end with exit code 1, where some row does not hold.
[[nodiscard]] std::optional<std::string> complaint_about(std::span<const StabilityRow> rows);

/// As in "power_test 3D degree 1, scale:2^300".
[[nodiscard]] std::string name_of(const StabilityRow& row);

}  // namespace kds
