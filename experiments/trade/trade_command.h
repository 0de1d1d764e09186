#pragma once
// The options of `kds trade`.

#include "experiments/output/output_files.h"
#include "experiments/program/command_line.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option.h"
#include "experiments/trade/measure_trade.h"

namespace kds {

/// The results are trade.json, trade.csv and report.html.
struct TradeOptions : InputOptions, Destinations {
  TradeTask task;
};

[[nodiscard]] const OptionList<TradeOptions>& trade_options();

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] TradeOptions parse_trade_options(const Arguments& arguments);

}  // namespace kds
