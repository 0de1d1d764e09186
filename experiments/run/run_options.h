#pragma once
// The options of `kds run` and the values that each accepts.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/base/kernel.h"
#include "experiments/output/output_files.h"
#include "experiments/program/contact_options.h"
#include "experiments/program/input_options.h"
#include "experiments/program/live_output.h"
#include "experiments/program/option.h"
#include "kds/kinetic_structure.h"
#include "motions/scene/scene.h"
#include "structures/session/structure_spec.h"

namespace kds {

/// The largest distance that beads may have from their positions in the frames: a length, or a multiple of
/// the smallest radius.
struct MotionTolerance {
  double amount = 0;
  bool of_radius = false;

  /// Returns the text that --tolerance takes.
  [[nodiscard]] std::string text() const { return fmt::format("{}{}", amount, of_radius ? "r" : ""); }
  [[nodiscard]] double length(std::span<const double> radii) const {
    return of_radius ? amount * *std::min_element(radii.begin(), radii.end()) : amount;
  }
};

struct RunOptions : InputOptions, Destinations, LiveOutput {
  std::vector<std::string> structures;  ///< names in the order of the registry; empty for the input's default
  FrameMotion motion = FrameMotion::linear;
  Kernel kernel = Kernel::filtered;
  AuditMode audit = AuditMode::none;
  NodeSelection nodes;                          ///< --levels, --nodes
  std::optional<BeadId> apart;                  ///< --apart; empty if not given
  ContactDistances distances;                   ///< --cutoff and --surface
  std::optional<Between> between;               ///< --between; empty if not given
  std::optional<double> tightness;              ///< --tightness; empty if not given
  std::optional<int> directions;                ///< --directions; empty if not given
  std::optional<double> stretch;                ///< --stretch; empty if not given
  std::optional<double> probe;                  ///< --probe; empty if not given
  std::optional<MotionTolerance> tolerance;     ///< --tolerance; empty if not given
  bool certify = false;                         ///< --certify
  std::optional<std::filesystem::path> dump;    ///< directory for the structures at every frame
  std::optional<std::filesystem::path> events;  ///< file that gets every event
  std::optional<std::filesystem::path> log;     ///< event log, for `kds replay`
  std::optional<std::filesystem::path> view;    ///< page that shows the run
  std::size_t rounds = 1;                       ///< number of rounds that are timed
  std::optional<std::size_t> threads;           ///< --threads; empty for all cores
  std::optional<std::uint64_t> work;            ///< limit on the limb operations of exact arithmetic

  /// Returns whether the run has a dual complex.
  [[nodiscard]] bool has_dual() const {
    return std::ranges::count(structures, "dual") + std::ranges::count(structures, "voids") > 0;
  }
  /// Returns --probe or its default: 1.4, the radius of water in angstrom, for the dual complex of van der
  /// Waals balls; otherwise 0.
  [[nodiscard]] double probe_length() const {
    const bool is_default = has_dual() && radius == "element";
    return probe.value_or(is_default ? 1.4 : 0);
  }
};

/// Returns the options --out, --replace, --json and --quiet of a run. The replay of a run has the same
/// options.
[[nodiscard]] OptionList<Destinations> run_destination_options();

/// Returns the help of --structures.
[[nodiscard]] std::string structures_help();
/// Returns `kds help structures`, with lines of at most `width` characters.
[[nodiscard]] std::string structures_table(std::size_t width = help_width());

/// Returns the options that say what is run: inputs, motion and structures.
[[nodiscard]] const OptionList<RunOptions>& motion_and_structure_options();

/// Returns the option --view.
template <class Options>
[[nodiscard]] Option<Options> view_option(
    std::optional<std::filesystem::path> Options::*view,
    const std::string& help =
        "write the run as a page that shows it in a browser to FILE; kds view has more "
        "options (default: none)") {
  return of_output(path_option({"--view", "FILE", help}, view));
}

/// Returns all options of `kds run`.
[[nodiscard]] const OptionList<RunOptions>& run_options();

/// Parses the arguments of `kds run`. Throws an InputError that names the option and what it takes. Throws
/// HelpRequest for --help. Opens no file.
[[nodiscard]] RunOptions parse_run_options(const Arguments& arguments);

/// Returns the arguments that ask for the same run, without its outputs, from any directory.
[[nodiscard]] Arguments repeating_arguments(const RunOptions& options);

}  // namespace kds
