#pragma once
// The properties of a scene that are known without a run: its necklaces, and the conditions of a proper
// necklace that they violate, with the frames.

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/run/count_crossings.h"
#include "motions/frames/frame_reader.h"
#include "motions/frames/frame_source.h"
#include "motions/frames/trajectory.h"
#include "structures/necklace/necklace.h"

namespace kds {

struct NecklaceInfo {
  std::string file;
  BeadRange beads;  ///< in the numbering of the scene
  std::size_t frames = 0;
  Necklace::Extent radii{}, bonds{};  ///< bonds over all frames, rounded
  std::vector<std::size_t> breaks;    ///< b: the necklace joins the beads b and b+1 across a chain break
  LaterBreaks later_breaks{};         ///< as in Trajectory
  std::size_t residues = 0, residues_read = 0;  ///< as in Trajectory
};

struct ConditionInfo {
  Condition condition{};
  std::size_t violations = 0;    ///< over all frames
  std::size_t frames = 0;        ///< number of frames with a violation
  std::size_t first_frame = 0;   ///< number in the file of the first frame with a violation
  std::vector<Violation> first;  ///< the first violations in that frame
  /// The amount by which each of `first` violates the condition, rounded: a length for a gap or a depth, a
  /// ratio for uniformity.
  std::vector<double> by;

  [[nodiscard]] bool holds() const { return violations == 0; }
};

struct SceneInfo {
  std::size_t beads = 0, frames = 0;
  double radius_min = 0, radius_max = 0;
  /// Times of the first and the last frame, in picoseconds; none if the file has no times.
  std::optional<double> first_time = {}, last_time = {};
  bool truncated = false;        ///< frames are missing at the end (FrameSource::is_truncated)
  std::string length_unit = {};  ///< empty if lengths have none
  std::vector<NecklaceInfo> necklaces;
  std::array<ConditionInfo, kConditions.size()> conditions;
  std::optional<CrossingCounts> crossings = {};  ///< on straight paths; empty if there are no bonds in space
  std::string why_no_crossings = {};             ///< a message, if they could not be counted

  [[nodiscard]] bool proper() const;
};

/// Checks the conditions at every frame, with one frame in memory. `necklaces` need only their first frames,
/// and `frames` has all frames of all beads. `radii` has one radius per bead in scene order. Throws
/// InputError if a number is not finite.
[[nodiscard]] SceneInfo describe_frames(std::span<const Trajectory> necklaces,
                                        std::span<const std::size_t> frames_of_necklaces, FrameSource& frames,
                                        std::span<const double> radii, const ValidateOptions& options,
                                        const std::function<void(std::size_t, std::size_t)>& progress);
/// Checks the conditions at every frame, with all frames in memory. A necklace with one frame is at rest.
/// Otherwise throws InputError if frame counts differ. Throws InputError also if a number is not finite.
[[nodiscard]] SceneInfo describe_scene(std::span<const Trajectory> necklaces, std::span<const double> radii,
                                       const ValidateOptions& options,
                                       const std::function<void(std::size_t, std::size_t)>& progress);

/// Returns a short description for tables, such as "beads that follow each other touch".
[[nodiscard]] std::string_view about(Condition condition);

/// Adds `input`, `necklaces`, `rows` (one per condition), `proper` and `crossings`.
void add_scene(Json& json, const SceneInfo& info);

/// Returns a header and one line per condition.
[[nodiscard]] std::string conditions_csv(const SceneInfo& info);

/// Returns the scene, its necklaces, a table of the conditions, and a line about crossings.
[[nodiscard]] std::string scene_table(const SceneInfo& info);

}  // namespace kds
