#pragma once
// The experiment behind `kds compare`. The experiment runs the same structures over the same inputs at
// several strides and with several motions. Net changes are counted between frames, whatever happened in
// between.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/compare/compare_command.h"
#include "experiments/program/live_output.h"
#include "experiments/program/mean_interval.h"
#include "experiments/program/timing.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/structure_spec.h"

namespace kds {

/// Returns the number of places (CombinatorialElements) whose content differs or that only one of the two
/// frames has. The places depend on the structure:
/// - wrapped hierarchy: nodes with another basis;
/// - hierarchy of boxes: sides of nodes with another support;
/// - power diagram: cells of one frame that the other does not have;
/// - contacts: pairs that meet in only one of the frames;
/// - sorted list: ranks with another bead;
/// - box: ends with another bead;
/// - hull: corners of only one frame;
/// - closest pair: another pair.
[[nodiscard]] std::uint64_t net_changes(CombinatorialElements before, CombinatorialElements after);

/// Sums the net changes over the frames of a run. Keeps only the last frame.
class NetChanges {
 public:
  /// Adds the next frame. No value means that this structure is not compared.
  void add(std::optional<CombinatorialElements> frame);
  /// Returns the sum, or nothing if a frame could not be compared.
  [[nodiscard]] std::optional<std::uint64_t> count() const {
    return last_ ? std::optional(count_) : std::nullopt;
  }

 private:
  std::optional<CombinatorialElements> last_;
  std::uint64_t count_ = 0;
};

/// The work of a structure at the times of its events, without the starts of steps. The structure handles all
/// failures of one time together.
struct EventCosts {
  std::uint64_t events = 0;         ///< internal ones included
  std::uint64_t created = 0;        ///< certificates
  std::uint64_t touched = 0;        ///< certificates that were created or ended: failed, cancelled or dropped
  std::uint64_t touched_most = 0;   ///< at one time
  std::uint64_t per_bead_most = 0;  ///< most certificates that name one bead, at all times
  double seconds = 0;
  double seconds_most = 0;  ///< at one time
};

/// Runs the structures event by event, and returns the costs of each structure. The events are those of a
/// plain run. `step_done` is called after each step.
[[nodiscard]] std::vector<EventCosts> costs_of_events(KineticRun& run,
                                                      const std::function<void()>& step_done);

/// The results of one structure in one run.
struct CompareRow {
  std::string input;  ///< the input's name
  std::size_t stride = 1;
  std::optional<FrameMotion> motion;  ///< empty for an instance file, which has its own motion
  std::size_t beads = 0, steps = 0;
  std::optional<double> picoseconds;  ///< from the first frame to the last, if the file has times
  StructureReport structure;
  std::optional<std::uint64_t> net_changes;  ///< empty if the structure cannot be compared between frames
  Spread seconds;                            ///< time of this structure over all rounds
  EventCosts costs;  ///< `seconds` is the median of the rounds, `seconds_most` the least of their worst times
  std::vector<double> events_of_steps, net_changes_of_steps;

  [[nodiscard]] std::uint64_t events() const { return structure.events_total; }
  /// Returns the name of the motion, "own" for an instance file.
  [[nodiscard]] std::string motion_name() const;
  [[nodiscard]] std::uint64_t internal() const;
  /// Returns the number of all events per external event, or nothing if there is no external event: the
  /// efficiency of a kinetic structure (Basch, Guibas and Hershberger, 1999).
  [[nodiscard]] std::optional<double> efficiency() const;
  /// Returns the number of events per net change, or nothing if there is no net change or the number is
  /// unknown.
  [[nodiscard]] std::optional<double> events_per_net_change() const;
  [[nodiscard]] double events_per_step() const;
  /// Return the intervals of events_per_step and of events_per_net_change: mean_over_time and
  /// ratio_over_time, above 0 (above_zero).
  [[nodiscard]] std::optional<MeanInterval> events_per_step_interval() const;
  [[nodiscard]] std::optional<MeanInterval> events_per_net_change_interval() const;
  /// Returns the mean over the first or the last quarter of the steps, at least one step. They differ if the
  /// run drifts, and then the mean of all steps depends on how long the run is.
  [[nodiscard]] double events_per_step_in_first_quarter() const;
  [[nodiscard]] double events_per_step_in_last_quarter() const;
  [[nodiscard]] std::optional<double> events_per_picosecond() const;
  [[nodiscard]] double events_per_bead_and_step() const;
  [[nodiscard]] std::optional<double> events_per_bead_and_picosecond() const;
  /// Each of these returns nothing if there are no events at times within steps.
  [[nodiscard]] std::optional<double> created_per_event() const;
  [[nodiscard]] std::optional<double> touched_per_event() const;
  /// Returns the mean seconds per event at the times of events, internal events included.
  [[nodiscard]] std::optional<double> responsiveness() const;
};

/// An input of the comparison.
struct ComparedInput {
  std::string file;
  /// The name in results, which no other input has: the path, followed by the chains if several inputs are of
  /// one file.
  std::string name;
  /// The name on pages: without the folder, if the file names of all inputs differ.
  std::string short_name;
  std::size_t beads = 0, frames = 0;
  int dimension = 3;
  bool truncated = false;  ///< frames are missing at the end
  double radius_min = 0, radius_max = 0;
  std::vector<std::string> bead_names = {};       ///< empty names if the file has none
  std::optional<VelocitySource> velocities = {};  ///< of Hermite motion, if it is compared
  std::optional<double> frame_picoseconds =
      {};  ///< from one frame to the next, on average; empty without times
};
/// Returns "108 beads, 1,000 frames 0.02 ps apart".
[[nodiscard]] std::string size_text(const ComparedInput& input);

/// A mean over inputs. The interval is above 0 (above_zero). It is missing for two inputs
/// (least_pooled), and if all inputs have one value.
struct PooledMean {
  double mean = 0;
  std::optional<MeanInterval> interval;
};

/// Means over all inputs of a structure, at one stride and with one motion. Each input counts alike, and the
/// intervals come from the spread between inputs. The intervals are wide for few inputs.
struct PooledRow {
  std::string structure;
  std::size_t stride = 1;
  std::string motion;  ///< name of the motion, "own" for instance files
  std::size_t inputs = 0;
  /// Empty if fewer than two inputs have the quantity.
  std::optional<PooledMean> events_per_step = {}, events_per_bead_and_step = {},
                            events_per_bead_and_picosecond = {}, events_per_net_change = {};
};

struct Comparison {
  std::vector<ComparedInput> inputs;
  std::vector<CompareRow> rows;  ///< ordered by input, motion, stride and structure
  std::optional<LiveRun> live;   ///< if the input is a running simulation
};

/// Returns a row for each structure, stride and motion; none if there is only one input.
[[nodiscard]] std::vector<PooledRow> pooled_rows(const Comparison& comparison);

/// Runs the structures that the options name over a scene, `rounds` times plainly for the times and as often
/// event by event for the costs of events. Returns a row for each structure, with stride 1 and without the
/// name of an input. `step_done` is called 2 * rounds times for each step.
[[nodiscard]] std::vector<CompareRow> measure_runs(const Scene& scene, const RunOptions& options,
                                                   std::size_t rounds,
                                                   const std::function<void()>& step_done);

/// Returns the options of the first run of a comparison: the first input with the smallest stride and the
/// first motion in the order of FrameMotion.
[[nodiscard]] RunOptions first_run(const CompareOptions& options, const Comparison& comparison);

/// Runs the comparison. All radii come from the frames that the options ask for, whatever the stride. Finds
/// all errors that the user can fix before the first run and throws InputError. Each warning about an input
/// goes to `warn` as one line.
[[nodiscard]] Comparison compare_runs(const CompareOptions& options,
                                      const std::function<void(std::size_t, std::size_t)>& progress,
                                      const std::function<void(const std::string&)>& warn);

}  // namespace kds
