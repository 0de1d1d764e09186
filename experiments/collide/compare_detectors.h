#pragma once
// The experiment behind `kds collide`: runs every method of collision detection over every frame, checks that
// the methods agree, and measures their times.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/program/input_options.h"
#include "experiments/program/timing.h"
#include "motions/base/bead.h"
#include "motions/frames/periodic.h"
#include "motions/scene/frame_survey.h"
#include "structures/collision/closest_pair.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

struct CollisionQuery {
  PairsAsked asked;
  double distance = 0;  ///< pairs with at most this distance count as colliding
};

/// The results of a method for one frame. All methods that report a result report the same one, except for
/// `family`.
struct Detection {
  std::vector<BeadPair> pairs;          ///< all colliding pairs, ascending
  std::optional<ClosestPair> closest;   ///< among all pairs asked for
  std::optional<std::uint64_t> family;  ///< number of pairs of bead groups that prove the other pairs apart
};

template <int Dimension>
class Detector {
 public:
  virtual ~Detector() = default;
  /// Returns a sentence that says why the method cannot handle these balls, or nothing if it can.
  [[nodiscard]] virtual std::optional<std::string> refusal(const Balls<Dimension>&) const {
    return std::nullopt;
  }
  /// Sets the cell of the next frame, for methods that take images.
  virtual void set_cell(const std::optional<Cell>&) {}
  /// Finds the collisions of the next frame. The method may keep data from one frame to the next.
  virtual void detect(const Balls<Dimension>& balls, Detection& found) = 0;
  /// Finds the closest pair, if that needs a separate search. Call `detect` with these balls first.
  virtual void find_closest(const Balls<Dimension>&, Detection&) {}
};

/// The frames that `kds collide` examines. The frames are read one after the other, with one frame in memory.
class CollideFrames {
 public:
  /// Reads all frames once. Each warning goes to `warn` as one line. Throws InputError for any fault of an
  /// input.
  CollideFrames(const InputOptions& options, const std::function<void(const std::string&)>& warn);

  /// Reads the next frame. Returns false after the last frame. For a planar scene, positions and cell are in
  /// the plane's coordinates and the third coordinate is zero. The frame has a cell if images of beads are
  /// looked at.
  [[nodiscard]] bool next(FrameRead& frame);

  /// Returns 2 if all beads stay in one plane x, y or z = constant in all frames, else 3.
  [[nodiscard]] int dimension() const { return plane_ ? 2 : 3; }
  [[nodiscard]] std::size_t frame_count() const { return frame_count_; }
  [[nodiscard]] bool is_truncated() const { return truncated_; }
  /// Returns whether the first frame has a time.
  [[nodiscard]] bool has_times() const { return first_.picoseconds.has_value(); }
  [[nodiscard]] const FrameStamp& first_frame() const { return first_; }
  [[nodiscard]] const FrameStamp& last_frame() const { return last_; }
  /// Returns the groups of each bead, or an empty vector if none were asked for.
  [[nodiscard]] const BeadGroups& bead_groups() const { return bead_groups_; }
  [[nodiscard]] const std::vector<BeadRange>& necklaces() const { return necklaces_; }
  /// Returns whether each necklace is at rest, as Scene::at_rest does.
  [[nodiscard]] const std::vector<bool>& at_rest() const { return at_rest_; }
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  /// Returns the bead's name in the file, or an empty text if the file has no names.
  [[nodiscard]] const std::string& bead_name(BeadId bead) const {
    static const std::string unnamed;
    return bead < bead_names_.size() ? bead_names_[bead] : unnamed;
  }

 private:
  std::unique_ptr<FrameSource> frames_;
  std::optional<AxisPlane> plane_;
  bool periodic_ = false;
  std::size_t frame_count_ = 0;
  FrameStamp first_, last_;
  bool truncated_ = false;
  BeadGroups bead_groups_;
  std::vector<BeadRange> necklaces_;
  std::vector<bool> at_rest_;
  std::vector<double> radii_;
  std::vector<std::string> bead_names_;  // empty, or a name for every bead
};

// The methods of `kds collide` by name.

struct Method {
  std::string_view name;
  std::string_view about;  ///< a short description
  bool takes_groups;       ///< can look at pairs of two groups of beads only
  bool takes_images;       ///< finds images in a periodic cell
  std::unique_ptr<Detector<2>> (*in_plane)(const CollisionQuery&);
  std::unique_ptr<Detector<3>> (*in_space)(const CollisionQuery&);

  template <int Dimension>
  [[nodiscard]] std::unique_ptr<Detector<Dimension>> make(const CollisionQuery& query) const {
    if constexpr (Dimension == 2) {
      return in_plane(query);
    } else {
      return in_space(query);
    }
  }
};

/// Returns the methods in the order in which they run and are listed.
[[nodiscard]] std::span<const Method> collision_methods();

struct ClosestInFrame {
  FrameStamp frame;
  ClosestPair pair;
};

/// The results of one method over all frames: sums, and the closest pair of all.
struct CollideRow {
  std::string_view method;
  std::size_t colliding_frames = 0;
  std::uint64_t pairs = 0;
  std::optional<ClosestInFrame> closest;  ///< empty if the method does not report it for some frame
  std::optional<std::uint64_t> family;
  Spread seconds;  ///< time over all rounds to find the collisions in all frames
  /// Additional time for the closest pairs. The time is nearly zero if no separate search is necessary, and
  /// empty if `closest` is empty.
  std::optional<Spread> closest_seconds;
};

/// The findings in one frame, combined from all methods.
struct FrameFound {
  FrameStamp stamp;
  std::uint64_t pairs = 0;
  std::optional<ClosestPair> closest;
};

struct CollideReport {
  std::vector<CollideRow> rows;
  bool timed = false;  ///< the input has times
  std::size_t frames = 0, colliding_frames = 0;
};

/// Called for each frame with its findings and all pairs.
using OnFrame = std::function<void(const FrameRead&, const FrameFound&, std::span<const BeadPair>)>;

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
