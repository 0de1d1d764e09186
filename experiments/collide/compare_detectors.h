#pragma once
// Runs every method over every frame, checks that the methods agree, and measures their times.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/collide/collide_frames.h"
#include "experiments/collide/methods.h"
#include "experiments/program/timing.h"

namespace kds {

struct ClosestInFrame {
  FrameStamp frame;
  ClosestPair pair;
};

/// The results of one method over all frames: sums, and the closest pair of all.
struct CollideRow {
  std::string_view method;
  std::size_t colliding_frames = 0;
  std::optional<std::uint64_t> pairs = 0;  ///< empty if the method does not count pairs
  std::optional<ClosestInFrame> closest;   ///< empty if the method does not report it for some frame
  std::optional<std::uint64_t> family;
  Spread seconds;  ///< time over all rounds to find the collisions in all frames
  /// Additional time for the closest pairs. It is nearly zero if that needs no separate search, and empty if
  /// `closest` is empty.
  std::optional<Spread> closest_seconds;
};

/// The findings in one frame, combined from all methods.
struct FrameFound {
  FrameStamp stamp;
  bool collide = false;
  std::optional<std::uint64_t> pairs;
  std::optional<ClosestPair> closest;
};

struct CollideReport {
  std::vector<CollideRow> rows;
  std::size_t frames = 0, colliding_frames = 0;
};

/// Called for each frame with its findings, and with all pairs if some method lists them.
using OnFrame =
    std::function<void(const FrameRead&, const FrameFound&, std::optional<std::span<const BeadPair>>)>;

struct CollideTask {
  std::vector<const Method*> methods;
  CollisionQuery query;
  std::size_t rounds = 1;           ///< repetitions of each method in each frame, in turn
  bool leave_out_refusing = false;  ///< a method that refuses the input is left out, with a warning
};

/// Compares the methods. Throws InputError if a method refuses the input, and std::runtime_error if two
/// methods disagree.
[[nodiscard]] CollideReport compare_detectors(CollideFrames& frames, const CollideTask& task,
                                              const OnFrame& on_frame,
                                              const std::function<void(const std::string&)>& warn,
                                              const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
