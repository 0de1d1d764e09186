#pragma once
// What is known of a scene before anything runs over it: its necklaces, and which conditions of a proper
// necklace they violate in which frames.

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"
#include "motions/frames/trajectory.h"
#include "structures/necklace/necklace.h"

namespace kds {

struct NecklaceInfo {
  std::string file;
  BeadRange beads;  ///< of the scene
  std::size_t frames = 0;
  Necklace::Extent radii{}, bonds{};  ///< the bonds over all frames, rounded
  std::vector<std::size_t> breaks;    ///< b: beads b and b+1 of the necklace are joined across a chain break
  LaterBreaks later_breaks{};         ///< as in Trajectory
  std::size_t residues = 0, residues_read = 0;  ///< as in Trajectory
};

struct ConditionInfo {
  Condition condition{};
  std::size_t violations = 0;    ///< over all frames
  std::size_t frames = 0;        ///< in which it is violated
  std::size_t first_frame = 0;   ///< of these, by its number in the file
  std::vector<Violation> first;  ///< the first in that frame
  /// How far each is from holding, rounded: a gap or a depth as a length, uniformity as a ratio.
  std::vector<double> by;

  [[nodiscard]] bool holds() const { return violations == 0; }
};

struct SceneInfo {
  std::size_t beads = 0, frames = 0;
  double radius_min = 0, radius_max = 0;
  std::vector<NecklaceInfo> necklaces;
  std::array<ConditionInfo, kConditions.size()> conditions;

  [[nodiscard]] bool proper() const;
};

/// Judges the conditions at every frame, with one frame in memory. `necklaces` need only their first
/// frames, and `next` reads the next frame of all beads. `radii` has one radius a bead in scene order.
/// Throws InputError if a number is not finite.
[[nodiscard]] SceneInfo describe_frames(std::span<const Trajectory> necklaces,
                                        std::span<const std::size_t> frames_of_necklaces,
                                        const std::function<bool(FrameRead&)>& next,
                                        std::span<const double> radii, const ValidateOptions& options,
                                        const std::function<void(std::size_t, std::size_t)>& progress);
/// Judges frames in memory likewise. A necklace of one frame is at rest. Throws InputError if frame counts
/// differ otherwise, or a number is not finite.
[[nodiscard]] SceneInfo describe_scene(std::span<const Trajectory> necklaces, std::span<const double> radii,
                                       const ValidateOptions& options,
                                       const std::function<void(std::size_t, std::size_t)>& progress);

/// A few words for tables: "beads that follow each other touch".
[[nodiscard]] std::string_view about(Condition condition);

}  // namespace kds
