#pragma once
// The findings of one run: the numbers behind the table, summary.json and events.csv.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/events/closest_approach.h"
#include "experiments/events/event_distribution.h"
#include "experiments/program/live_output.h"
#include "experiments/program/timing.h"
#include "experiments/run/certify_stride.h"
#include "experiments/run/run_options.h"
#include "motions/frames/frame_reader.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/parallel_run.h"

namespace kds {

using NamedCounts = std::vector<std::pair<std::string, std::uint64_t>>;  ///< in the order of printing

struct StructureReport {
  std::string name;                ///< such as sorted, wrapped or power
  std::uint64_t events_total = 0;  ///< number of external events
  NamedCounts events_by_kind;      ///< external kinds first, then internal kinds, which the total excludes
  std::optional<std::uint64_t> contacts_at_start, contacts_at_end;  ///< numbers of pairs of beads
  std::vector<std::string> internal_kinds;                          ///< the internal kinds of events_by_kind
  EventCourse course;                                               ///< external events, step by step
  std::uint64_t created = 0, never_failing = 0, cancelled = 0, failed = 0, touched = 0, peak = 0,
                per_bead_max = 0;
  NamedCounts stages;  ///< number of certificates that each stage of the cascade settled
  double seconds = 0;  ///< time for this structure and its certificates after the first build
  double build_seconds = 0;
  double static_seconds = 0;  ///< time to build the same structure statically at every frame (CGAL)
  /// Over all rounds. `seconds` and `static_seconds` are the medians.
  Spread of_seconds, of_static_seconds;
  Spread of_ratio;  ///< `seconds` divided by `static_seconds`, round by round; 0 if `static_seconds` is 0
  std::uint64_t rebuilds = 0;
  std::uint64_t audits_run = 0, audits_failed = 0;
  EventDistribution distribution;  ///< empty if the run does not record it

  /// Returns the name of the kind, with " (internal)" appended for an internal kind, as in "overtake
  /// (internal)".
  [[nodiscard]] std::string label_of(const std::string& kind) const;
};

struct RunReport {
  std::vector<std::string> files;
  std::uint64_t beads = 0, frames = 0;
  std::optional<FrameStamp> first_frame, last_frame;  ///< their numbers in the file, and their times
  int dimension = 3;
  bool truncated = false;  ///< frames are missing at the end of the input
  double radius_min = 0, radius_max = 0;
  std::string length_unit;                   ///< of the input; empty if it has none
  std::optional<VelocitySource> velocities;  ///< of Hermite motion (Scene::velocities)
  std::vector<std::pair<std::string, std::string>>
      settings;  ///< motion, kernel, audit, select, chain, frames, radius, ...
  std::vector<StructureReport> structures;
  std::size_t rounds = 1;        ///< number of rounds behind the times
  double engine_seconds = 0;     ///< time of the event queue and the clock
  double listeners_seconds = 0;  ///< time for writing and counting events
  NamedCounts comparisons;       ///< failure times with overlapping brackets, by the method that settled them
  std::uint64_t exact_work = 0;  ///< limb operations of exact arithmetic
  std::size_t threads = 1;       ///< threads that ran parts of the run
  PartCounts parts;
  std::uint64_t fingerprint = 0;            ///< printed as 16 hex digits
  std::optional<StrideCertificate> stride;  ///< from --certify
  std::optional<ClosestApproach> approach;  ///< only if the run has the closest pair
  /// The least distance over all frames. Known with --certify, or with --tolerance if no frame is left out.
  std::optional<DistanceRange> approach_in_all_frames;
  std::optional<LiveRun> live;          ///< only if the input is a running simulation
  std::string command_line;             ///< asks for the same run, without outputs
  std::vector<std::string> bead_names;  ///< an unknown name is an empty text
};

/// The result of a replay.
struct ReplayReport {
  RunReport run;                         ///< the result of the new run
  std::uint64_t logged_fingerprint = 0;  ///< from the last line of the log
  std::uint64_t events = 0;              ///< number of events in the log
  /// A sentence that describes the first difference between log and run. Empty if every event is in both at
  /// the same time.
  std::optional<std::string> difference = {};

  [[nodiscard]] bool same() const { return !difference && run.fingerprint == logged_fingerprint; }
};

class StepCounts;  // run_scene.h
/// Collects the counts of the structures of a run at the frame that it has reached.
[[nodiscard]] RunReport report_of(KineticRun& run, const Scene& scene, const RunOptions& options,
                                  const StepCounts& counts);

/// Returns the members `skipped` and `deviation` of a certificate.
[[nodiscard]] Json deviation_json(const StrideDeviation& deviation);

/// Returns JSON text that ends with a newline.
[[nodiscard]] std::string report_json(const RunReport& report);

/// Returns the JSON of report_json with an additional object `replay`. The members of `replay` are log,
/// events, logged_fingerprint, same and difference (null if there is no difference).
[[nodiscard]] std::string replay_json(const ReplayReport& replay, const std::filesystem::path& log);

/// Returns a table with one column per structure and one row per figure. The fingerprint comes last. The
/// text ends with a newline.
[[nodiscard]] std::string comparison_table(const RunReport& report);

}  // namespace kds
