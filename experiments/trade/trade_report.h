#pragma once
// Reports the results of `kds trade` to programs and people, with a recommendation in words.

#include <span>
#include <string>

#include "experiments/output/result_json.h"
#include "experiments/trade/measure_trade.h"

namespace kds {

[[nodiscard]] Json trade_rows_json(std::span<const TradeRow> rows);
/// Returns a header and one line per row.
[[nodiscard]] std::string trade_csv(std::span<const TradeRow> rows);
/// Returns a block per group. Rows on the Pareto front are marked.
[[nodiscard]] std::string trade_table(std::span<const TradeRow> rows);

/// Returns one or two sentences per group: the quickest setting whose main errors are small, its errors and
/// its gain. `rows` are in the order of measure_trade.
[[nodiscard]] std::string recommendation(std::span<const TradeRow> rows);
/// Returns {sentence, row} for each group. `row` is the index of the setting to take, or null.
[[nodiscard]] Json recommendations_json(std::span<const TradeRow> rows);

}  // namespace kds
