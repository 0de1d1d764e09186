#pragma once
// What `kds trade` found, for programs and for people.

#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/trade/measure_trade.h"

namespace kds {

[[nodiscard]] Json trade_rows_json(std::span<const TradeRow> rows);
/// A header and one line a row.
[[nodiscard]] std::string trade_csv(std::span<const TradeRow> rows);
/// A block a group; what is on the front is marked.
[[nodiscard]] std::string trade_table(std::span<const TradeRow> rows);
/// `page` says how it was made.
[[nodiscard]] std::string trade_page(std::span<const TradeRow> rows, const std::string& input, Page page);

}  // namespace kds
