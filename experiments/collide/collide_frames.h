#pragma once
// The frames that `kds collide` looks at, read one after the other: in memory is one.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/program/input_options.h"
#include "motions/base/bead_range.h"
#include "motions/scene/scene_stream.h"

namespace kds {

class CollideFrames {
 public:
  /// Reads all frames once. Warnings, one line each, go to `warn`. Throws InputError for whatever is wrong
  /// with an input.
  CollideFrames(const InputOptions& options, const std::function<void(const std::string&)>& warn);

  /// The next; false behind the last. Of a planar scene in the plane's coordinates, the third zero.
  [[nodiscard]] bool next(FrameRead& frame);

  /// 2 where all beads keep to one plane x, y or z = constant in all frames.
  [[nodiscard]] int dimension() const { return plane_ ? 2 : 3; }
  [[nodiscard]] std::size_t frame_count() const { return frame_count_; }
  [[nodiscard]] const std::vector<BeadRange>& necklaces() const { return necklaces_; }
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  /// As the files name it; empty where they do not.
  [[nodiscard]] const std::string& bead_name(BeadId bead) const {
    static const std::string unnamed;
    return bead < bead_names_.size() ? bead_names_[bead] : unnamed;
  }

 private:
  SceneStream stream_;
  std::optional<AxisPlane> plane_;
  std::size_t frame_count_ = 0;
  std::vector<BeadRange> necklaces_;
  std::vector<double> radii_;
  std::vector<std::string> bead_names_;  // none, or of all beads
};

}  // namespace kds
