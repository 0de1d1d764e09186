#pragma once
// The experiment behind `kds trade`. It measures the cost of every setting, running the settings in turn, and
// the error of each against the truth.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/trade/finest_data.h"
#include "experiments/trade/follow_run.h"
#include "experiments/trade/trade_setting.h"

namespace kds {

struct TradeTask {
  std::vector<Want> wants{Want::contacts, Want::cages, Want::diagram};
  BeadId apart = 2;
  std::size_t rounds = 5;
  SamplingOfTimes sampling;
  std::optional<double> cutoff;  ///< limit for short edges; empty for four times the largest radius
  /// Adds rows for the exact kernel: the same events, 100 to thousands of times the cost.
  bool exact_kernel = true;
};

struct TradeCost {
  double seconds = 0;                ///< processor time after the first build: median of the rounds
  double quickest = 0, slowest = 0;  ///< least and most of the rounds
  double ratio = 1;                  ///< to the exact run's time for the same number of frames
  std::uint64_t certificates = 0, events = 0;
  std::optional<double> tests;  ///< FollowedRun::tests
  std::uint64_t memory = 0;     ///< bytes in use at the end of the run; the maximum if there are several runs
};

struct TradeRow {
  Want want;
  TradeSetting setting;
  TradeCost cost;
  TradeErrors errors;
  bool is_exact = false;  ///< true for the exact run of all frames, which begins its group
  bool on_front = false;  ///< true if no other row of its group has lower cost and lower errors
};

/// Returns the errors that compare the rows of a group. Returns an empty list if one of them is unknown, and
/// for scenes.
[[nodiscard]] std::vector<double> main_errors(const TradeRow& row);

/// Returns the rows in the order of the settings. A setting that does not fit the trajectory is left out and
/// `warn` gets a line that says so; for example, the frames of a stride may lie in a plane when other frames
/// do not. Throws InputError if the exact run of a want does not fit.
[[nodiscard]] std::vector<TradeRow> measure_trade(
    const FinestData& finest, const TradeTask& task,
    const std::function<void(std::size_t, std::size_t)>& progress,
    const std::function<void(const std::string&)>& warn);

}  // namespace kds
