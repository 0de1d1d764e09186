#include "experiments/trade/finest_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "motions/base/input_error.h"
#include "motions/curves/positions.h"
#include "motions/frames/trajectory.h"
#include "motions/scene/radii.h"
#include "motions/scene/straightened_frames.h"
#include "structures/collision/auto_detector.h"
#include "structures/collision/brute_force.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "structures/enclosing_sphere/integer_balls.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/session/scene_motion.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

namespace {

double length_of_tolerance(const TradeSetting& setting, const std::vector<double>& radii) {
  return setting.tolerance * *std::min_element(radii.begin(), radii.end());
}

}  // namespace

FinestData::FinestData(std::vector<Trajectory> necklaces, std::vector<double> radii,
                       const std::string& radius)
    : necklaces_(std::move(necklaces)),
      radii_(std::move(radii)),
      calpha_(calpha_model(necklaces_, radii_, radius)) {
  for (const Trajectory& necklace : necklaces_) frames_ = std::max(frames_, necklace.frames.size());
  dimension_ = scene().dimension();
}

FinestData FinestData::first_frames(std::size_t frames) const {
  FinestData some = *this;
  const auto cut = [&](std::vector<Trajectory>& necklaces) {
    for (Trajectory& necklace : necklaces)
      if (necklace.frames.size() > frames) necklace.frames.resize(frames);
  };
  cut(some.necklaces_);
  if (some.calpha_) cut(some.calpha_->necklaces);
  some.frames_ = std::min(frames_, frames);
  some.dimension_ = some.scene().dimension();
  return some;
}

TradeInput FinestData::input() const {
  const auto knows_elements = [](const Trajectory& necklace) {
    return necklace.element_radii.size() == necklace.bead_count();
  };
  std::vector<NecklaceBeads> beads;
  for (const Trajectory& necklace : necklaces_) beads.push_back(beads_of(necklace));
  BeadGroups groups = bead_groups(beads);
  return {frames_,
          static_cast<BeadId>(radii_.size()),
          necklaces_.size(),
          dimension_,
          calpha_ ? static_cast<BeadId>(calpha_->bead.size()) : 0,
          calpha_ ? calpha_->largest_residue() : 0,
          calpha_ ? calpha_->covering_radius : 0,
          std::all_of(necklaces_.begin(), necklaces_.end(), knows_elements),
          false,
          {},
          std::move(groups)};
}

std::vector<double> FinestData::radii_of(const TradeSetting& setting) const {
  if (setting.element_radii) return bead_radii("element", necklaces_);
  if (!setting.calpha) return radii_;
  if (!setting.calpha_radius) return calpha_->radii;
  return std::vector<double>(calpha_->bead.size(), *setting.calpha_radius);
}

Scene FinestData::scene(const TradeSetting& setting) const { return scene(setting, radii_of(setting)); }

Scene FinestData::scene(const TradeSetting& setting, std::vector<double> radii) const {
  std::vector<Trajectory> some = setting.calpha ? calpha_->necklaces : necklaces_;
  const std::vector<double> own = radii_of(setting);
  for (Trajectory& necklace : some) {
    if (setting.projected)
      for (Eigen::Matrix3Xd& frame : necklace.frames) frame.row(2).setZero();
    if (necklace.frames.size() == 1) continue;  // the necklace is at rest
    if (setting.tolerance > 0)
      necklace.frames = straightened(std::move(necklace.frames), length_of_tolerance(setting, own));
    necklace = every_nth(necklace, setting.stride);
  }
  Scene scene(some, std::move(radii), setting.motion);
  if (!setting.projected && scene.dimension() != dimension_)
    throw InputError(fmt::format(
        "the frames at stride {} lie in a plane, but others do not; expected frames of {} dimensions",
        setting.stride, dimension_));
  return scene;
}

StrideDeviation FinestData::deviation(const TradeSetting& setting, const Scene& scene) const {
  MemoryFrames every(necklaces_);
  std::optional<double> most;
  if (setting.tolerance > 0 && setting.stride == 1) most = length_of_tolerance(setting, radii_of(setting));
  return deviation_of_stride(scene, every, setting.stride, most);
}

namespace {

template <int Dimension>
class TruthIn final : public Truth {
 public:
  TruthIn(const Scene& finest, const PairsAsked& asked)
      : scene_(finest), motion_(make_scene_motion(finest)), hierarchy_(finest.necklaces()), asked_(asked) {
    if (asked.groups.empty()) detector_.emplace(asked);
  }

  void move_to(std::size_t time) override {
    const std::size_t step = std::min(time / parts_of_frame, scene_.step_count() - 1);
    if (step_ != step) motion_->load(step);
    step_ = step;
    const auto part = static_cast<double>(time - step * parts_of_frame) / parts_of_frame;
    const Curves<Dimension> curves = std::get<MotionRef<Dimension>>(motion_->ref()).curves();
    positions_ = approximate_positions(curves, part);
    time_ = Dyadic(part);
    wrapped_ = exact_ = has_cells_ = false;
  }

  [[nodiscard]] const Eigen::Matrix3Xd& positions() const override { return positions_; }

  [[nodiscard]] double smallest_radius(const BeadRange& node) override {
    if (!wrapped_) {
      balls_.emplace(positions_, scene_.radii());
      if (built_) {
        hierarchy_.update(*balls_);
      } else {
        hierarchy_.build(*balls_);
      }
      built_ = wrapped_ = true;
    }
    const auto id = hierarchy_.tree().find(node);
    return id ? hierarchy_.sphere(*id).radius : smallest_sphere(*balls_, node.first, node.last).sphere.radius;
  }

  [[nodiscard]] std::size_t balls_outside(const NodeSphere& node) override {
    std::size_t outside = 0;
    const auto& [center, radius] = node.sphere;
    for (BeadId b = node.range.first; b <= node.range.last; ++b) {
      // The ball is inside by more than all rounding errors, so no exact test is needed.
      const double reach = (positions_.col(b) - center).norm() + scene_.radii()[b];
      const double size = reach + positions_.col(b).norm() + center.norm();
      if (radius - reach > 0x1p-40 * size) continue;
      outside += reach - radius > 0x1p-40 * size || sticks_out(b, node.sphere) ? 1 : 0;
    }
    return outside;
  }

  [[nodiscard]] const std::vector<std::vector<BeadId>>& cells() override {
    if (has_cells_) return cells_;
    cells_.clear();
    std::vector<double> weights;
    for (const double radius : scene_.radii()) weights.push_back(radius * radius);
    for (auto cell : static_triangulation<Dimension>(positions_, weights).cells) {
      std::sort(cell.begin(), cell.end());
      cells_.emplace_back(cell.begin(), cell.end());
    }
    std::sort(cells_.begin(), cells_.end());
    has_cells_ = true;
    return cells_;
  }

  [[nodiscard]] std::optional<double> closest_distance(const Eigen::Matrix3Xd& positions) override {
    const Balls<Dimension> balls(positions, scene_.radii());
    const auto closest = detector_ ? detector_->closest_pair(balls) : closest_pair_by_force(balls, asked_);
    return closest ? std::optional(closest->distance) : std::nullopt;
  }

 private:
  [[nodiscard]] bool sticks_out(BeadId bead, const Sphere& sphere) {
    if (!exact_) {
      whole_ = integer_balls_at(std::get<MotionRef<Dimension>>(motion_->ref()).curves(), time_);
      exact_ = true;
    }
    // Expresses sphere and ball in a common unit, the finest of their units.
    int unit = whole_.unit;
    for (int axis = 0; axis < Dimension; ++axis) unit = std::min(unit, unit_of(sphere.center[axis]));
    unit = std::min(unit, unit_of(sphere.radius));
    const auto finer = static_cast<unsigned>(whole_.unit - unit);
    const IntegerBall<Dimension>& ball = whole_.balls[bead];
    const Integer excess = whole(sphere.radius, unit) - (ball.radius << finer);
    if (excess < 0) return true;
    Integer square = 0;
    for (int axis = 0; axis < Dimension; ++axis) {
      const Integer d =
          (ball.center[static_cast<std::size_t>(axis)] << finer) - whole(sphere.center[axis], unit);
      square += d * d;
    }
    return square > excess * excess;
  }
  static int unit_of(double x) {
    const SplitDouble parts = split(x);
    return parts.mantissa == 0 ? std::numeric_limits<int>::max() : parts.exponent;
  }
  static Integer whole(double x, int unit) {
    const SplitDouble parts = split(x);
    if (parts.mantissa == 0) return 0;
    return Integer(parts.mantissa) << static_cast<unsigned>(parts.exponent - unit);
  }

  const Scene& scene_;
  std::unique_ptr<SceneMotion> motion_;
  StaticWrappedHierarchy<Dimension> hierarchy_;
  PairsAsked asked_;
  std::optional<AutoDetector<Dimension>> detector_;  // empty if there are groups, which it does not take
  std::optional<std::size_t> step_;
  Dyadic time_;
  Eigen::Matrix3Xd positions_;
  std::optional<Balls<Dimension>> balls_;
  IntegerBalls<Dimension> whole_;
  std::vector<std::vector<BeadId>> cells_;
  bool built_ = false, wrapped_ = false, exact_ = false, has_cells_ = false;
};

}  // namespace

std::unique_ptr<Truth> make_truth(const Scene& finest, const PairsAsked& asked) {
  if (finest.dimension() == 2) return std::make_unique<TruthIn<2>>(finest, asked);
  return std::make_unique<TruthIn<3>>(finest, asked);
}

Eigen::Matrix3Xd FollowedMotion::positions(std::size_t step, double u) {
  if (loaded_ != step) motion_->load(step);
  loaded_ = step;
  return std::visit([&](const auto& motion) { return approximate_positions(motion.curves(), u); },
                    motion_->ref());
}

}  // namespace kds
