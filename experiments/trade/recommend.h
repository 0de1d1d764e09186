#pragma once
// What the measured rows say to do, in words.

#include <span>
#include <string>

#include "experiments/trade/measure_trade.h"

namespace kds {

/// For each group a sentence or two: the quickest setting whose main errors are small, what it loses and what
/// it gains. Rows as measure_trade gives them.
[[nodiscard]] std::string recommendation(std::span<const TradeRow> rows);

/// What is lost, in words: "radii 0.02% larger on average, 0.5% at most".
[[nodiscard]] std::string losses_of(const TradeRow& row);

}  // namespace kds
