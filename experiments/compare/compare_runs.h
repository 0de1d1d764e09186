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
#include "experiments/program/timing.h"
#include "experiments/run/run_report.h"
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

/// The results of one structure in one run.
struct CompareRow {
  std::string input;
  std::size_t stride = 1;
  FrameMotion motion = FrameMotion::linear;
  std::size_t steps = 0;
  std::optional<double> picoseconds;  ///< from the first frame to the last, if the file has times
  StructureReport structure;
  std::optional<std::uint64_t> net_changes;  ///< empty if the structure cannot be compared between frames
  Spread seconds;                            ///< time of this structure over all rounds

  [[nodiscard]] std::uint64_t events() const { return structure.events_total; }
  [[nodiscard]] std::uint64_t internal() const;
  /// Returns the number of events per net change, or nothing if there is no net change or the number is
  /// unknown.
  [[nodiscard]] std::optional<double> efficiency() const;
  [[nodiscard]] double events_per_step() const;
  [[nodiscard]] std::optional<double> events_per_picosecond() const;
  /// Returns the seconds per event, internal events included, or nothing if there are no events.
  [[nodiscard]] std::optional<double> seconds_per_event() const;
};

/// An input of the comparison.
struct ComparedInput {
  std::string file;
  std::size_t beads = 0, frames = 0;
  int dimension = 3;
  bool truncated = false;  ///< frames are missing at the end
  double radius_min = 0, radius_max = 0;
  std::vector<std::string> bead_names;  ///< empty names if the file has none
};

struct Comparison {
  std::vector<ComparedInput> inputs;
  std::vector<CompareRow> rows;  ///< ordered by input, motion, stride and structure
};

/// Runs the comparison. All radii come from the frames that the options ask for, whatever the stride. Finds
/// all errors that the user can fix before the first run and throws InputError. Each warning about an input
/// goes to `warn` as one line.
[[nodiscard]] Comparison compare_runs(const CompareOptions& options,
                                      const std::function<void(std::size_t, std::size_t)>& progress,
                                      const std::function<void(const std::string&)>& warn);

}  // namespace kds
