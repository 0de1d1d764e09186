#pragma once
// The experiment behind `kds compare`: the same structures over the same inputs, at several strides and on
// several motions, and what differs between frames whatever happens in between.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/compare/compare_options.h"
#include "experiments/program/timing.h"
#include "experiments/run/run_report.h"

namespace kds {

/// One structure in one run.
struct CompareRow {
  std::string input;
  std::size_t stride = 1;
  FrameMotion motion = FrameMotion::linear;
  std::size_t steps = 0;
  std::optional<double> picoseconds;  ///< from the first frame to the last, where the file has times
  StructureReport structure;
  std::optional<std::uint64_t> net_changes;  ///< none where the structure is not compared from frame to frame
  Spread seconds;                            ///< of the rounds, on this structure

  [[nodiscard]] std::uint64_t events() const { return structure.events_total; }
  [[nodiscard]] std::uint64_t internal() const;
  /// Events a net change; none where nothing differs, or it is not known.
  [[nodiscard]] std::optional<double> efficiency() const;
  [[nodiscard]] double events_per_step() const;
  [[nodiscard]] std::optional<double> events_per_picosecond() const;
  /// Seconds an event, internal ones too; none without events.
  [[nodiscard]] std::optional<double> seconds_per_event() const;
};

/// What was read.
struct ComparedInput {
  std::string file;
  std::size_t beads = 0, frames = 0;
  int dimension = 3;
  double radius_min = 0, radius_max = 0;
  std::vector<std::string> bead_names;  ///< empty ones where the file does not tell
};

struct Comparison {
  std::vector<ComparedInput> inputs;
  std::vector<CompareRow> rows;  ///< by input, motion, stride and structure
};

/// All radii are those of the frames that are asked for, whatever the stride. Everything that a user can mend
/// is found before the first run: throws InputError. Warnings of inputs go to `warn`, one line each.
[[nodiscard]] Comparison compare_runs(const CompareOptions& options,
                                      const std::function<void(std::size_t, std::size_t)>& progress,
                                      const std::function<void(const std::string&)>& warn);

}  // namespace kds
