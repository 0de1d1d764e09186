#pragma once
// What `kds run` was asked to do. parse_run_options.cpp declares the options.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/base/kernel.h"
#include "experiments/output/destinations.h"
#include "experiments/program/input_options.h"
#include "kds/audit.h"
#include "motions/scene/scene.h"
#include "structures/session/structure_spec.h"

namespace kds {

/// How far from where the frames have them beads may be: a length, or a multiple of the smallest radius.
struct MotionTolerance {
  double amount = 0;
  bool of_radius = false;

  /// Returns it as --tolerance takes it.
  [[nodiscard]] std::string text() const { return fmt::format("{}{}", amount, of_radius ? "r" : ""); }
  [[nodiscard]] double length(std::span<const double> radii) const {
    return of_radius ? amount * *std::min_element(radii.begin(), radii.end()) : amount;
  }
};

struct RunOptions : InputOptions, Destinations {
  std::vector<std::string> structures;  ///< by name, in their order; empty: the input's default
  FrameMotion motion = FrameMotion::linear;
  Kernel kernel = Kernel::filtered;
  AuditMode audit = AuditMode::none;
  NodeSelection nodes;                          ///< --levels, --nodes
  std::optional<BeadId> apart;                  ///< --apart; none: not given
  std::optional<Between> between;               ///< --between; none: not given
  std::optional<double> tightness;              ///< --tightness; none: not given
  std::optional<double> relax;                  ///< --relax; none: not given
  std::optional<MotionTolerance> tolerance;     ///< --tolerance; none: not given
  bool certify = false;                         ///< --certify
  std::optional<std::filesystem::path> dump;    ///< directory for the structures at every frame
  std::optional<std::filesystem::path> events;  ///< file for every event
  std::optional<std::filesystem::path> log;     ///< event log, for `kds replay`
  std::size_t rounds = 1;                       ///< the run so often, for its times
  std::optional<std::uint64_t> work;            ///< most limb operations of exact arithmetic
};

}  // namespace kds
