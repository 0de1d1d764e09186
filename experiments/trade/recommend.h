#pragma once
// Turns the measured rows into a recommendation in words.

#include <span>
#include <string>

#include "experiments/trade/measure_trade.h"

namespace kds {

/// Returns one or two sentences per group: the quickest setting whose main errors are small, its errors and
/// its gain. `rows` are in the order of measure_trade.
[[nodiscard]] std::string recommendation(std::span<const TradeRow> rows);

/// Returns the errors in words: "radii 0.02% larger on average, 0.5% at most".
[[nodiscard]] std::string losses_of(const TradeRow& row);

}  // namespace kds
