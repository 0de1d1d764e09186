#pragma once
// Reports the rows of `kds stability`: JSON, CSV, a table, and a page that says whether the kernels agree and
// where the arithmetic was hardest.

#include <optional>
#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/stability/stability_command.h"
#include "experiments/stability/stability_row.h"

namespace kds {

/// Returns one object with the members command, settings, rows, holds, version and machine. The text ends
/// with a newline.
[[nodiscard]] std::string stability_json(std::string command, const StabilityOptions& options,
                                         std::span<const StabilityRow> rows);

/// Returns a header and one line per row.
[[nodiscard]] std::string stability_csv(std::span<const StabilityRow> rows);

/// Returns the error message if some row does not hold. The program then exits with code 1.
[[nodiscard]] std::optional<std::string> complaint_about(std::span<const StabilityRow> rows);

/// Returns a name such as "power_test 3D degree 1, scale:2^300".
[[nodiscard]] std::string name_of(const StabilityRow& row);

/// Returns the table. Lines have at most 120 columns, reasons excepted. The text ends with a newline.
[[nodiscard]] std::string stability_table(std::span<const StabilityRow> rows);

/// `page` says how the results were made.
[[nodiscard]] std::string stability_page(std::span<const StabilityRow> rows, Page page);

}  // namespace kds
