#pragma once
// The frames that the errors of a trade are measured against, and the scenes that settings make of them.

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
#include "structures/collision/pairs_asked.h"
#include "structures/necklace/node_sphere.h"
#include "structures/session/structure_spec.h"

namespace kds {

/// Times are whole numbers of this part of the way from one of the finest frames to the next.
inline constexpr std::size_t parts_of_frame = 64;

class FinestData {
 public:
  /// `radius`: the policy by which beads have got their radii.
  FinestData(std::vector<Trajectory> necklaces, std::vector<double> radii, const std::string& radius);

  /// So many of them alone, at least two.
  [[nodiscard]] FinestData first_frames(std::size_t frames) const;

  /// Of the first necklace, for messages.
  [[nodiscard]] const std::string& file() const { return necklaces_.front().file; }
  [[nodiscard]] std::size_t frame_count() const { return frames_; }
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  [[nodiscard]] TradeInput input() const;
  /// Null where there is none.
  [[nodiscard]] const CalphaModel* calpha() const { return calpha_ ? &*calpha_ : nullptr; }
  /// All frames, linear motion between them.
  [[nodiscard]] Scene scene() const { return {necklaces_, radii_, FrameMotion::linear}; }
  /// As the setting has it, which leaves two frames. Throws InputError naming the stride where they lie in a
  /// plane and others do not.
  [[nodiscard]] Scene scene(const TradeSetting& setting) const;
  /// The same with other radii.
  [[nodiscard]] Scene scene(const TradeSetting& setting, std::vector<double> radii) const;
  /// How far beads are from where the setting's scene has them, in the frames that it leaves out or
  /// straightens.
  [[nodiscard]] StrideDeviation deviation(const TradeSetting& setting, const Scene& scene) const;

 private:
  [[nodiscard]] std::vector<double> radii_of(const TradeSetting& setting) const;

  std::vector<Trajectory> necklaces_;
  std::vector<double> radii_;
  std::optional<CalphaModel> calpha_;
  std::size_t frames_ = 1;
  int dimension_ = 3;
};

/// Where the beads truly are at a time, that is on straight lines between the finest frames, and what is
/// right for them there.
class Truth {
 public:
  virtual ~Truth() = default;
  /// Goes to a time, in parts of a frame.
  virtual void move_to(std::size_t time) = 0;

  /// Each coordinate rounded to a double a few times.
  [[nodiscard]] virtual const Eigen::Matrix3Xd& positions() const = 0;
  /// The radius of the smallest sphere around these balls of one necklace, right to 1e-12 of its size.
  [[nodiscard]] virtual double smallest_radius(const BeadRange& node) = 0;
  /// How many of these balls are not in this sphere, as it stands. Exact.
  [[nodiscard]] virtual std::size_t balls_outside(const NodeSphere& node) = 0;
  /// Cells of the power diagram of the positions, ids ascending, in order.
  [[nodiscard]] virtual const std::vector<std::vector<BeadId>>& cells() = 0;
  /// Of all pairs asked about, with the beads here, how far the closest are apart; none where none are asked.
  [[nodiscard]] virtual std::optional<double> closest_distance(const Eigen::Matrix3Xd& positions) = 0;
};

/// `finest` must outlive it and is its own.
[[nodiscard]] std::unique_ptr<Truth> make_truth(const Scene& finest, const PairsAsked& asked);

/// Where a setting's beads are, each coordinate rounded a few times; `step` is its scene's.
class FollowedMotion {
 public:
  explicit FollowedMotion(const Scene& scene) : motion_(make_scene_motion(scene)) {}
  [[nodiscard]] Eigen::Matrix3Xd positions(std::size_t step, double u);

 private:
  std::unique_ptr<SceneMotion> motion_;
  std::optional<std::size_t> loaded_;
};

}  // namespace kds
