#pragma once
// One run of a setting, beside the truth: what it got wrong, at frames and between them.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/trade/finest_data.h"
#include "experiments/trade/match_contacts.h"
#include "experiments/trade/match_events.h"
#include "experiments/trade/trade_setting.h"

namespace kds {

/// Errors of a run; none where one does not apply. Lengths are in the input's unit, times in finest frames.
struct TradeErrors {
  std::optional<double> displacement;             ///< largest, of a bead from where it truly is
  std::optional<double> radius_mean, radius_max;  ///< of a node from the smallest, as a share of it
  std::optional<double> radius_frames_mean, radius_frames_max;  ///< the same at frames alone
  std::optional<double> beads_outside;  ///< of their nodes' spheres, mean of the times looked at
  std::optional<double> cells_wrong;    ///< share of cells that are not in the true diagram
  std::optional<double> edges_missed;   ///< share of the true edges shorter than the cutoff
  std::optional<double> events_missed, events_invented;  ///< shares of the exact run's events
  std::optional<double> event_time_mean, event_time_max;
  /// Shares of the true contacts. Of one bead a residue none where there is no true contact of residues.
  std::optional<double> contacts_missed, contacts_spurious;
  std::optional<double> contacts_unsure;  ///< share of the true contacts; of certified runs, as the next
  std::optional<double> sure_wrong;       ///< contacts that are called sure and are none
  std::optional<double> contact_time_mean, contact_time_max;  ///< of their ends
  std::optional<double> closest_distance;  ///< largest error of the closest pair's distance
};
/// By name, in the order of the members.
[[nodiscard]] std::vector<std::pair<std::string, std::optional<double>>> by_name(const TradeErrors& errors);

/// What a run gave out.
struct RunHistory {
  double end = 0;  ///< in frames of the finest data, where the run stops
  std::vector<TimedEvent> events;
  std::vector<ContactTime> contacts;  ///< of the structure contacts; certified: all that are possible
  std::vector<ContactTime> sure;      ///< certified
};

struct SamplingOfTimes {
  std::size_t times = 200;  ///< random ones between frames, and as many frames at the most
  std::uint64_t seed = 1;
};

struct FollowedRun {
  RunHistory history;
  TradeErrors errors;           ///< but those of events and contacts
  std::optional<double> tests;  ///< of two spheres, in a search of each time's hierarchy for contacts; mean
};

/// `cutoff`: for edges_missed.
[[nodiscard]] FollowedRun follow_run(const FinestData& finest, const TradeSetting& setting, Truth& truth,
                                     const SamplingOfTimes& sampling, double cutoff);

/// Adds the errors of events and contacts, by the history of the exact run.
void compare_histories(const RunHistory& exact, FollowedRun& run, const FinestData& finest,
                       const TradeSetting& setting);

}  // namespace kds
