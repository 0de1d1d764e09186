#pragma once
// The experiment behind `kds missed`. It computes all contacts of a run with their exact times, and counts
// the contacts that are seen if only frames are examined: every frame, every second frame, every fourth
// frame, and so on. A contact that begins and ends between two examined frames is missed.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/table.h"
#include "experiments/program/command_line.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option.h"
#include "motions/base/bead.h"
#include "motions/scene/scene.h"

namespace kds {

struct MissedTask : InputOptions {
  FrameMotion motion = FrameMotion::linear;
  std::vector<double> factors{1};  ///< factors of the radii; each is a run
  /// Ascending; empty for those of 1, 2, 4 ... 64 that examine at least two frames.
  std::vector<std::size_t> strides;
  BeadId apart = 2;
};

/// The result of one stride of one run.
struct MissedRow {
  double factor = 1;
  std::size_t stride = 1;
  std::size_t frames = 0;  ///< number of frames examined
  std::uint64_t contacts = 0, found = 0;

  [[nodiscard]] std::uint64_t missed() const { return contacts - found; }
};

/// Description of the input. Radii are those of the radius policy, without the factor.
struct MissedInput {
  std::size_t beads = 0, necklaces = 0, frames = 0;
  int dimension = 3;
  double radius_min = 0, radius_max = 0;
};

struct MissedReport {
  MissedInput input;
  std::vector<MissedRow> rows;  ///< ordered by factor, then by stride
};

/// Counts the missed contacts. Each warning about the input goes to `warn` as one line. Throws InputError for
/// any fault of the input, and if a requested stride examines only one frame.
[[nodiscard]] MissedReport count_missed(const MissedTask& task,
                                        const std::function<void(const std::string&)>& warn,
                                        const std::function<void(std::size_t, std::size_t)>& progress);

struct MissedOptions {
  MissedTask task;
  Destinations destinations;
};

/// Returns the options that appear as settings in the JSON.
[[nodiscard]] const OptionList<MissedTask>& missed_task_options();

/// Parses the options. Throws an InputError that names the option and what it takes. Throws HelpRequest for
/// --help. Opens no file.
[[nodiscard]] MissedOptions parse_missed_options(const Arguments& arguments);

/// Returns the columns of missed.json and missed.csv, of the terminal and of the page.
[[nodiscard]] const Table<MissedRow>& missed_columns();
/// `page` says how the results were made.
[[nodiscard]] std::string missed_page(std::span<const MissedRow> rows, const std::string& input, Page page);

}  // namespace kds
