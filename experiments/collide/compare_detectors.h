#pragma once
// Every method over every frame: what they tell, that they agree, and how long they take.

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

/// One method over all frames: sums, and the closest pair of all.
struct CollideRow {
  std::string_view method;
  std::size_t colliding_frames = 0;
  std::optional<std::uint64_t> pairs = 0;  ///< none where a method does not tell them
  std::optional<ClosestInFrame> closest;   ///< none where it does not tell of some frame
  std::optional<std::uint64_t> family;
  Spread seconds;  ///< of the rounds: to find collisions in all frames
  /// And then the closest pairs, next to nothing where that is no other search; none where `closest` is none.
  std::optional<Spread> closest_seconds;
};

/// What was found in one frame, by all methods that tell.
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
  std::size_t rounds = 1;           ///< each method so often in each frame, in turn
  bool leave_out_refusing = false;  ///< a method that cannot answer goes, with a warning
};

/// Throws InputError with the refusal of a method, and std::runtime_error where two methods disagree.
[[nodiscard]] CollideReport compare_detectors(CollideFrames& frames, const CollideTask& task,
                                              const OnFrame& on_frame,
                                              const std::function<void(const std::string&)>& warn,
                                              const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
