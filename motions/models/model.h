#pragma once
// The models by name: what `kds generate` offers.

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
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 3> shape_motion_names{"rest", "rotate", "wander"};
[[nodiscard]] constexpr std::string_view name_of(ShapeMotion motion) {
  return shape_motion_names[static_cast<std::size_t>(motion)];
}

/// From the first frame to the last, linearly.
struct Span {
  double first, last;
};

/// What a model may be asked for; each takes some of these, with a default of its own where none is given.
struct Settings {
  std::size_t beads = 2;   ///< at least 2
  std::size_t frames = 1;  ///< at least 1
  std::uint64_t seed = 1;
  std::optional<ShapeMotion> motion = {};
  std::optional<double> step = {};    ///< radii a frame
  std::optional<double> bond = {};    ///< in diameters
  std::optional<double> turns = {};   ///< of a helix or spiral
  std::optional<double> pitch = {};   ///< of a helix, in bonds
  std::optional<double> gap = {};     ///< between rows, in diameters
  std::optional<int> dimension = {};  ///< 2 or 3
  std::optional<double> jitter = {};  ///< radii
  std::optional<double> fill = {};    ///< share of the volume
  std::optional<Span> rolled = {};    ///< 0: straight, 1: rolled up
  std::optional<Span> distance = {};  ///< of two spirals, in chain lengths
};

/// The names of settings that not every model takes.
enum class Setting { motion, step, bond, turns, pitch, gap, dimension, jitter, fill, rolled, distance };

struct Model {
  std::string_view name;
  std::string_view about;             ///< a few words
  std::span<const Setting> settings;  ///< that it takes, besides beads, frames and seed
  /// One necklace or two of radius 1, every setting that it takes given.
  std::vector<Trajectory> (*make)(const Settings&);
  Settings defaults;  ///< of the settings that it takes
  /// Returns the most turns that this many beads have room for, which the default does not exceed. Null: no
  /// limit.
  double (*most_turns)(std::size_t beads) = nullptr;

  [[nodiscard]] bool takes(Setting setting) const;
};

[[nodiscard]] std::span<const Model> all_models();

/// Null where there is none of that name.
[[nodiscard]] const Model* find_model(std::string_view name);

/// The settings with the model's defaults for what is not given.
[[nodiscard]] Settings completed(const Model& model, const Settings& settings);

/// The same settings give the same bits on every platform. Throws InputError naming the option where no such
/// model exists.
[[nodiscard]] std::vector<Trajectory> generate(const Model& model, const Settings& settings);

}  // namespace kds::models
