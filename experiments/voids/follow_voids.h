#pragma once
// Follows the voids of a union of balls through a trajectory for `kds voids`.
//
// A void is a part of space that the balls enclose. With a probe, the probe's centre cannot leave it. A void
// opens to the outside when a gate between three balls opens, and may close again later. It is then the same
// cavity if at least half of the beads around both are common to them (the Jaccard index of the beads when it
// opened and when it closed). So a cavity has stretches of time in which it is closed, and openings between
// them. A void that is filled, or merges with another one, does not come back: a void that begins or splits
// off is a new cavity. Each closing is compared with all cavities that are open. On request, also finds how
// long each tunnel lasts, by zigzag persistence of the complex.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/surface/union_task.h"
#include "motions/frames/frame_stamp.h"
#include "motions/scene/scene.h"
#include "structures/dual_complex/dual_topology.h"

namespace kds {

struct VoidsTask : UnionTask {
  /// --persistence, in picoseconds if the frames have times, otherwise in frames. Shorter openings are
  /// bridged, and cavities without a longer stretch are not listed.
  double persistence = 0;
  bool tunnels = false;  ///< --tunnels: find how long each tunnel lasts
};

struct VoidMoment {
  double frame = 0;  ///< number in the file, with a fraction between frames
  std::optional<double> picoseconds;

  /// Returns the time in picoseconds if it is known, otherwise in frames.
  [[nodiscard]] double clock() const { return picoseconds.value_or(frame); }
};

/// An end of a closed stretch or of a tunnel: when and how it came about, and by which simplex.
struct VoidEnd {
  VoidMoment at;
  std::string how;            ///< a word such as "closed"; see docs/formats.md
  std::vector<BeadId> beads;  ///< of the simplex; empty at the first and the last frame, and if none changed
};

struct ClosedStretch {
  /// Number of the void; the first one if openings are bridged. 0 for a tunnel.
  DualTopology<3>::Number number = 0;
  VoidEnd begin, end;
  bool is_seen = false;  ///< whether a frame that was read lies in it

  [[nodiscard]] double length() const { return end.at.clock() - begin.at.clock(); }
  /// Returns whether it begins and ends within the run.
  [[nodiscard]] bool is_complete() const { return begin.how != "start" && end.how != "last frame"; }
};

/// A cavity at a frame in which it is closed. Lengths are in the input's unit.
struct VoidSample {
  std::size_t frame = 0;  ///< counted in frames that are read
  double volume = 0, area = 0;
};

struct Cavity {
  std::vector<ClosedStretch> stretches;  ///< ascending; at least one
  std::set<BeadId> beads;                ///< around it, at any time in which it is closed
  std::vector<VoidSample> samples;
};

/// The topology at a frame.
struct TopologyAtFrame {
  VoidMoment at;
  std::array<std::int64_t, 3> betti{};  ///< components, tunnels, voids
  double volume = 0;                    ///< of all voids
  std::size_t zigzag_lines = 0;         ///< lines of the zigzag up to this frame
};

struct VoidsReport {
  std::unique_ptr<const Scene> scene;
  std::string unit;                ///< of lengths; empty if they have none
  bool has_times = false;          ///< whether moments have picoseconds
  std::vector<Cavity> cavities;    ///< in the order in which they were first closed; short ones left out
  std::size_t short_ones = 0;      ///< cavities that were left out
  std::vector<ClosedStretch> all;  ///< of all cavities, before openings are bridged
  std::vector<TopologyAtFrame> frames;
  std::uint64_t tunnels_begun = 0, tunnels_ended = 0;
  /// The lives of tunnels by zigzag persistence, in the order of their begins, if the task asks for them;
  /// short ones left out.
  std::vector<ClosedStretch> tunnels;
  /// The complex as a zigzag filtration, if it is kept: a line "i 3 7" inserts the simplex of beads 3 and 7,
  /// "d 3 7" deletes it. Begins with the simplices of the first frame.
  std::string zigzag;
};

/// Reads the inputs and follows all voids on one thread. Keeps the zigzag in memory if `keep_zigzag`. Each
/// warning goes to `warn` as one line. Throws InputError.
[[nodiscard]] VoidsReport follow_voids(const VoidsTask& task, bool keep_zigzag,
                                       const std::function<void(std::size_t, std::size_t)>& progress,
                                       const std::function<void(const std::string&)>& warn);

}  // namespace kds
