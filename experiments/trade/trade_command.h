#pragma once
// The measurements of `kds trade` for callers that print nothing.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "experiments/program/command_line.h"
#include "experiments/trade/measure_trade.h"

namespace kds {

/// Measures the settings that these arguments of `kds trade` ask for. Options of output have no effect. Each
/// warning about the input goes to `warn` as one line. Throws InputError for faults of arguments and input.
[[nodiscard]] std::vector<TradeRow> measure_trade_of(
    const Arguments& arguments, const std::function<void(std::size_t, std::size_t)>& progress,
    const std::function<void(const std::string&)>& warn);

}  // namespace kds
