#pragma once
// The models by name, as `kds generate` offers them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "motions/frames/trajectory.h"

namespace kds::models {

/// How a shape moves.
enum class ShapeMotion { rest, rotate, wander };
/// Names, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> shape_motion_names{"rest", "rotate", "wander"};
[[nodiscard]] constexpr std::string_view name_of(ShapeMotion motion) {
  return shape_motion_names[static_cast<std::size_t>(motion)];
}

/// A value at the first frame and one at the last, interpolated linearly.
struct Span {
  double first, last;
};

/// The settings of a model. Each model uses some of them and has its own defaults.
struct Settings {
  std::size_t beads = 2;   ///< at least 2
  std::size_t frames = 1;  ///< at least 1
  std::uint64_t seed = 1;
  std::optional<ShapeMotion> motion = {};
  std::optional<double> step = {};    ///< radii per frame
  std::optional<double> bond = {};    ///< in diameters
  std::optional<double> turns = {};   ///< turns of a helix or spiral
  std::optional<double> pitch = {};   ///< pitch of a helix, in bonds
  std::optional<double> gap = {};     ///< between rows, in diameters
  std::optional<int> dimension = {};  ///< 2 or 3
  std::optional<double> jitter = {};  ///< radii
  std::optional<double> fill = {};    ///< share of the volume that is filled
  std::optional<Span> rolled = {};    ///< 0: straight, 1: rolled up
  std::optional<Span> distance = {};  ///< distance of two spirals, in chain lengths
};

/// The settings that not every model uses.
enum class Setting { motion, step, bond, turns, pitch, gap, dimension, jitter, fill, rolled, distance };

struct Model {
  std::string_view name;
  std::string_view about;             ///< a few words
  std::span<const Setting> settings;  ///< settings that it uses, besides beads, frames and seed
  /// Makes one or two necklaces of radius 1. Every setting that the model uses must be given.
  std::vector<Trajectory> (*make)(const Settings&);
  Settings defaults;  ///< defaults of the settings that it uses
  /// Returns the largest number of turns for which this many beads have room; the default does not exceed it.
  /// Null: no limit.
  double (*most_turns)(std::size_t beads) = nullptr;

  [[nodiscard]] bool takes(Setting setting) const;
};

[[nodiscard]] std::span<const Model> all_models();

/// Returns the model of this name, or null.
[[nodiscard]] const Model* find_model(std::string_view name);

/// Returns the settings with the model's defaults in place of missing ones.
[[nodiscard]] Settings completed(const Model& model, const Settings& settings);

/// Generates the model. Equal settings give the same bits on every platform. Throws InputError naming the
/// option if no such model exists.
[[nodiscard]] std::vector<Trajectory> generate(const Model& model, const Settings& settings);

}  // namespace kds::models
