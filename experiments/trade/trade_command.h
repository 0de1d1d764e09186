#pragma once
// `kds trade`: what speed can be had for what accuracy, on the user's own trajectory.

#include "experiments/output/destinations.h"
#include "experiments/program/command_line.h"
#include "experiments/program/input_options.h"
#include "experiments/trade/measure_trade.h"

namespace kds {

/// Results: trade.json, trade.csv and report.html.
struct TradeOptions : InputOptions, Destinations {
  TradeTask task;
};

/// Throws InputError naming the option and what it takes, HelpRequest for --help. Opens no file.
[[nodiscard]] TradeOptions parse_trade_options(const Arguments& arguments);

/// Throws InputError for what the arguments or inputs are at fault for; returns the exit code.
int trade_command(const Arguments& arguments);

}  // namespace kds
