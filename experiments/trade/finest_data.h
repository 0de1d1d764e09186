#pragma once
// The frames that serve as the reference for the errors of a trade, and the scenes that settings derive from
// them.

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/trade/calpha_model.h"
#include "experiments/trade/trade_setting.h"
#include "motions/frames/trajectory.h"
#include "motions/scene/scene.h"
#include "motions/scene/stride_deviation.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"
#include "structures/session/structure_spec.h"

namespace kds {

/// Times are integers. The unit is the time between two of the finest frames divided by this number.
inline constexpr std::size_t parts_of_frame = 64;

class FinestData {
 public:
  /// `radius` is the policy that gave the beads their radii.
  FinestData(std::vector<Trajectory> necklaces, std::vector<double> radii, const std::string& radius);

  /// Returns the data restricted to the first `frames` frames, at least two.
  [[nodiscard]] FinestData first_frames(std::size_t frames) const;

  /// The file of the first necklace, for messages.
  [[nodiscard]] const std::string& file() const { return necklaces_.front().file; }
  [[nodiscard]] std::size_t frame_count() const { return frames_; }
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  [[nodiscard]] TradeInput input() const;
  /// Returns null if there is no such model.
  [[nodiscard]] const CalphaModel* calpha() const { return calpha_ ? &*calpha_ : nullptr; }
  /// Returns the scene of all frames with linear motion between them.
  [[nodiscard]] Scene scene() const { return {necklaces_, radii_, FrameMotion::linear}; }
  /// Returns the scene that the setting asks for. The setting must leave at least two frames. Throws an
  /// InputError that names the stride if its frames lie in a plane and others do not.
  [[nodiscard]] Scene scene(const TradeSetting& setting) const;
  /// Returns the setting's scene with other radii.
  [[nodiscard]] Scene scene(const TradeSetting& setting, std::vector<double> radii) const;
  /// Returns how far beads are from their positions in the setting's scene, in the frames that the setting
  /// leaves out or straightens.
  [[nodiscard]] StrideDeviation deviation(const TradeSetting& setting, const Scene& scene) const;

 private:
  [[nodiscard]] std::vector<double> radii_of(const TradeSetting& setting) const;

  std::vector<Trajectory> necklaces_;
  std::vector<double> radii_;
  std::optional<CalphaModel> calpha_;
  std::size_t frames_ = 1;
  int dimension_ = 3;
};

/// The true positions of the beads at a time, on straight lines between the finest frames, and the correct
/// structures for these positions.
class Truth {
 public:
  virtual ~Truth() = default;
  /// Moves to a time, given in parts of a frame.
  virtual void move_to(std::size_t time) = 0;

  /// Returns the positions. Each coordinate has a few rounding errors.
  [[nodiscard]] virtual const Eigen::Matrix3Xd& positions() const = 0;
  /// Returns the radius of the smallest sphere that encloses these balls of one necklace. The relative error
  /// is at most 1e-12.
  [[nodiscard]] virtual double smallest_radius(const BeadRange& node) = 0;
  /// Returns exactly how many of the node's balls are not inside its sphere.
  [[nodiscard]] virtual std::size_t balls_outside(const NodeSphere& node) = 0;
  /// Returns the cells of the power diagram of the positions, in order. Each cell has ascending ids.
  [[nodiscard]] virtual const std::vector<std::vector<BeadId>>& cells() = 0;
  /// Returns the least distance of all pairs asked about, with the beads at `positions`. Returns nothing if
  /// no pair is asked about.
  [[nodiscard]] virtual std::optional<double> closest_distance(const Eigen::Matrix3Xd& positions) = 0;
};

/// `finest` must outlive the result and be used for no other truth.
[[nodiscard]] std::unique_ptr<Truth> make_truth(const Scene& finest, const PairsAsked& asked);

/// The positions of a setting's beads. Each coordinate has a few rounding errors. `step` is a step of the
/// setting's scene.
class FollowedMotion {
 public:
  explicit FollowedMotion(const Scene& scene) : motion_(make_scene_motion(scene)) {}
  [[nodiscard]] Eigen::Matrix3Xd positions(std::size_t step, double u);

 private:
  std::unique_ptr<SceneMotion> motion_;
  std::optional<std::size_t> loaded_;
};

}  // namespace kds
