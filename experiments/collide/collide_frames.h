#pragma once
// The frames that `kds collide` examines. They are read one after the other, with one frame in memory.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/program/input_options.h"
#include "motions/base/bead_range.h"
#include "motions/frames/frame_source.h"
#include "motions/scene/frame_survey.h"

namespace kds {

class CollideFrames {
 public:
  /// Reads all frames once. Each warning goes to `warn` as one line. Throws InputError for any fault of an
  /// input.
  CollideFrames(const InputOptions& options, const std::function<void(const std::string&)>& warn);

  /// Reads the next frame. Returns false after the last frame. For a planar scene, the positions are in the
  /// plane's coordinates and the third coordinate is zero.
  [[nodiscard]] bool next(FrameRead& frame);

  /// Returns 2 if all beads stay in one plane x, y or z = constant in all frames, else 3.
  [[nodiscard]] int dimension() const { return plane_ ? 2 : 3; }
  [[nodiscard]] std::size_t frame_count() const { return frame_count_; }
  [[nodiscard]] const std::vector<BeadRange>& necklaces() const { return necklaces_; }
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  /// Returns the bead's name in the file, or an empty text if the file has no names.
  [[nodiscard]] const std::string& bead_name(BeadId bead) const {
    static const std::string unnamed;
    return bead < bead_names_.size() ? bead_names_[bead] : unnamed;
  }

 private:
  std::unique_ptr<FrameSource> frames_;
  std::optional<AxisPlane> plane_;
  std::size_t frame_count_ = 0;
  std::vector<BeadRange> necklaces_;
  std::vector<double> radii_;
  std::vector<std::string> bead_names_;  // empty, or a name for every bead
};

}  // namespace kds
