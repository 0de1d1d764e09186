#pragma once
// The experiment behind `kds trade`: every setting's cost, in runs by turns, and its error beside the truth.

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
  std::optional<double> cutoff;  ///< for short edges; none: four times the largest radius
  bool exact_kernel = true;      ///< has rows: the same events, at a hundred to thousands of times the cost
};

struct TradeCost {
  double seconds = 0;                ///< of the processor, after the first build: median of the rounds
  double quickest = 0, slowest = 0;  ///< of them
  double ratio = 1;                  ///< to the exact run's, for as many frames
  std::uint64_t certificates = 0, events = 0;
  std::optional<double> tests;  ///< FollowedRun::tests
  std::uint64_t memory = 0;     ///< bytes that the run holds at its end, or of several the largest
};

struct TradeRow {
  Want want;
  TradeSetting setting;
  TradeCost cost;
  TradeErrors errors;
  bool is_exact = false;  ///< the exact run of all frames, which begins its group
  bool on_front = false;  ///< no other row of its group costs less and errs less
};

/// The errors by which rows of a group are compared; empty where one of them is not known, and of scenes.
[[nodiscard]] std::vector<double> main_errors(const TradeRow& row);

/// In the order of the settings. A setting that does not fit the trajectory, as a stride whose frames lie in
/// a plane where others do not, is left out, and `warn` gets a line that says so. Throws InputError where the
/// exact run of what is wanted does not fit.
[[nodiscard]] std::vector<TradeRow> measure_trade(
    const FinestData& finest, const TradeTask& task,
    const std::function<void(std::size_t, std::size_t)>& progress,
    const std::function<void(const std::string&)>& warn);

}  // namespace kds
