#pragma once
// The experiment behind `kds trade`. The experiment measures the cost of every setting, running the settings
// in turn, and the error of each against the truth at frames and between them.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/trade/finest_data.h"
#include "experiments/trade/match_events.h"
#include "experiments/trade/trade_setting.h"

namespace kds {

/// The errors of a run. Means over time, and shares of cells and edges, are those over the random times: at
/// frames many errors are 0 by construction, and would make the mean too small. An error that does not apply
/// is empty. Lengths are in the input's unit, times in finest frames.
struct TradeErrors {
  std::optional<double> displacement;  ///< largest distance of a bead from its true position
  /// Relative difference of a node's radius from the smallest radius.
  std::optional<double> radius_mean, radius_max;
  std::optional<double> radius_frames_mean, radius_frames_max;  ///< the same at frames only
  std::optional<double> beads_outside;  ///< beads outside their nodes' spheres, mean over the times examined
  std::optional<double> cells_wrong;    ///< share of cells that the true diagram does not have
  std::optional<double> edges_missed;   ///< share of the true edges shorter than the cutoff
  std::optional<double> events_missed, events_invented;  ///< shares of the exact run's events
  std::optional<double> event_time_mean, event_time_max;
  /// Shares of the true contacts. Empty for the model with one bead per residue if no residues are truly in
  /// contact.
  std::optional<double> contacts_missed, contacts_spurious;
  std::optional<double> contacts_unsure;  ///< share of the true contacts; only for certified runs
  /// Number of contacts that are called sure but are not true; only for certified runs.
  std::optional<double> sure_wrong;
  /// Error of the times at which contacts begin and end.
  std::optional<double> contact_time_mean, contact_time_max;
  std::optional<double> closest_distance;  ///< largest error of the closest pair's distance
};
/// Returns the errors with their names, in the order of the members.
[[nodiscard]] std::vector<std::pair<std::string, std::optional<double>>> by_name(const TradeErrors& errors);

/// The output of a run.
struct RunHistory {
  double end = 0;  ///< time at which the run stops, in frames of the finest data
  std::vector<TimedEvent> events;
  std::vector<ContactTime> contacts;  ///< contacts of the run; for a certified run all possible contacts
  std::vector<ContactTime> sure;      ///< only for a certified run
};

struct SamplingOfTimes {
  std::size_t times = 200;  ///< number of random times between frames, and at most as many frames
  std::uint64_t seed = 1;
};

struct FollowedRun {
  RunHistory history;
  TradeErrors errors;  ///< all errors except those of events and contacts
  /// Sphere pairs tested by a contact search in the hierarchy, mean over the times examined.
  std::optional<double> tests;
  std::size_t threads = 1;  ///< number of threads that ran parts of the run
};

/// Runs the setting on at most `threads` threads, on which the result does not depend. The caller's thread
/// compares with the truth. `cutoff` is the length limit for edges_missed.
[[nodiscard]] FollowedRun follow_run(const FinestData& finest, const TradeSetting& setting, Truth& truth,
                                     const SamplingOfTimes& sampling, double cutoff, std::size_t threads);

/// Adds the errors of events and contacts, computed from the history of the exact run.
void compare_histories(const RunHistory& exact, FollowedRun& run, const FinestData& finest,
                       const TradeSetting& setting);

struct TradeTask {
  std::vector<Want> wants{Want::contacts, Want::cages, Want::diagram};
  BeadId apart = 2;
  std::size_t rounds = 5;
  SamplingOfTimes sampling;
  std::optional<double> cutoff;  ///< limit for short edges; empty for four times the largest radius
  /// Adds rows for the exact kernel: the same events, 100 to thousands of times the cost.
  bool exact_kernel = true;
  FrameRange frames{};                   ///< the frames that were read
  std::optional<std::size_t> threads{};  ///< of the runs that measure errors; empty for all cores
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
