#pragma once
// Turns the JSON that a command printed into flat rows: one for each structure of `kds run`, one of totals
// for `kds contacts`, otherwise one for each item of `rows`. Nested names are joined by dots. Arrays and
// fields without a value are left out.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/result_json.h"

namespace kds {

/// Fields of a row, in the order of the JSON.
using RowFields = std::vector<std::pair<std::string, Json>>;

struct ResultRow {
  RowFields fields;  ///< the same on every machine, at any time
  RowFields times;   ///< depend on the machine and its load
};

/// Returns whether a field is a time, a ratio of times or memory, or follows from times, as `pareto` does.
[[nodiscard]] bool is_time(std::string_view name);

/// Returns the rows of a command's result.
[[nodiscard]] std::vector<ResultRow> rows_of_result(const Json& result);

/// Returns the text that distinguishes a row from the others of its task: its texts and keys such as
/// `stride`, but none of `others`.
[[nodiscard]] std::string identity_of(const ResultRow& row, const std::vector<std::string>& others = {});
/// Returns whether a field belongs to the identity of its row.
[[nodiscard]] bool is_identity(const std::string& name, const Json& value);

}  // namespace kds
