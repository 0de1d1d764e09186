#pragma once
// The options and the input of commands that look at the union of balls: `kds surface` and `kds voids`.

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "experiments/program/input_options.h"
#include "motions/scene/scene.h"

namespace kds {

/// By default, all atoms are balls with their van der Waals radii.
struct UnionTask : InputOptions {
  std::optional<double> probe;  ///< --probe; empty if not given
  FrameMotion motion = FrameMotion::linear;

  UnionTask() {
    radius = "element";
    reading.selection = Selection::all;
  }
  /// Returns --probe or its default: 1.4, the radius of water in angstrom, for van der Waals radii; otherwise
  /// 0.
  [[nodiscard]] double probe_length() const { return probe.value_or(radius == "element" ? 1.4 : 0); }
};

[[nodiscard]] const OptionList<UnionTask>& union_options();
/// Returns "volume (angstrom^3)" for the power 3, or the quantity alone if lengths have no unit.
[[nodiscard]] std::string in_unit(const std::string& quantity, const std::string& unit, int power);

/// Reads the scene, whose radii get the probe, for a command of this name ("kds surface"). Each warning goes
/// to `warn` as one line. Sets `lone_frame` as load_necklaces does. Throws InputError, also if all beads stay
/// in one plane.
[[nodiscard]] Scene load_union(const UnionTask& task, std::string_view command,
                               const std::function<void(const std::string&)>& warn,
                               bool* lone_frame = nullptr);

}  // namespace kds
