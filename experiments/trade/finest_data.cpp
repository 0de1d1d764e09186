#include "experiments/trade/finest_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "motions/base/input_error.h"
#include "motions/curves/positions.h"
#include "motions/readers/every_nth.h"
#include "motions/scene/straightened_frames.h"
#include "structures/collision/auto_detector.h"
#include "structures/enclosing_sphere/integer_balls.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/session/scene_motion.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

namespace {

void straighten(Trajectory& necklace, double tolerance) {
  StraightenedFrames straight(tolerance);
  std::size_t read = 0;
  const std::vector<Eigen::Matrix3Xd> frames = std::move(necklace.frames);
  necklace.frames.clear();
  const auto read_next = [&](FrameRead& frame) {
    if (read == frames.size()) return false;
    frame.stamp = {necklace.frame_number(read), std::nullopt};
    frame.positions = frames[read++];
    return true;
  };
  for (FrameRead frame; straight.next(frame, read_next);)
    necklace.frames.push_back(std::move(frame.positions));
}

}  // namespace

FinestData::FinestData(std::vector<Trajectory> necklaces, std::vector<double> radii)
    : necklaces_(std::move(necklaces)), radii_(std::move(radii)) {
  for (const Trajectory& necklace : necklaces_) frames_ = std::max(frames_, necklace.frames.size());
  dimension_ = scene().dimension();
}

FinestData FinestData::first_frames(std::size_t frames) const {
  std::vector<Trajectory> some = necklaces_;
  for (Trajectory& necklace : some)
    if (necklace.frames.size() > frames) necklace.frames.resize(frames);
  return {std::move(some), radii_};
}

Scene FinestData::scene(const TradeSetting& setting) const {
  std::vector<Trajectory> some = necklaces_;
  for (Trajectory& necklace : some) {
    if (necklace.frames.size() == 1) continue;  // at rest
    if (setting.tolerance > 0)
      straighten(necklace, setting.tolerance * *std::min_element(radii_.begin(), radii_.end()));
    necklace = every_nth(necklace, setting.stride);
  }
  Scene scene(some, radii_, setting.motion);
  if (scene.dimension() != dimension_)
    throw InputError(
        fmt::format("frames of a stride of {} lie in a plane, as others do not; expected frames of {} "
                    "dimensions",
                    setting.stride, dimension_));
  return scene;
}

namespace {

template <int Dimension>
class TruthIn final : public Truth {
 public:
  TruthIn(const Scene& finest, const PairsAsked& asked)
      : scene_(finest),
        motion_(make_scene_motion(finest)),
        hierarchy_(finest.necklaces()),
        detector_(asked) {}

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
    return hierarchy_.sphere(hierarchy_.tree().find(node).value()).radius;
  }

  [[nodiscard]] std::size_t balls_outside(const NodeSphere& node) override {
    std::size_t outside = 0;
    const auto& [center, radius] = node.sphere;
    for (BeadId b = node.range.first; b <= node.range.last; ++b) {
      // Far from doubtful, whatever all the roundings.
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
    const auto closest = detector_.closest_pair(Balls<Dimension>(positions, scene_.radii()));
    return closest ? std::optional(closest->distance) : std::nullopt;
  }

 private:
  [[nodiscard]] bool sticks_out(BeadId bead, const Sphere& sphere) {
    if (!exact_) {
      whole_ = integer_balls_at(std::get<MotionRef<Dimension>>(motion_->ref()).curves(), time_);
      exact_ = true;
    }
    // The sphere in the same units, or both in its own finer ones.
    int unit = whole_.unit;
    for (int axis = 0; axis < Dimension; ++axis) unit = std::min(unit, unit_of(sphere.center[axis]));
    unit = std::min(unit, unit_of(sphere.radius));
    const auto finer = static_cast<unsigned>(whole_.unit - unit);
    const IntegerBall<Dimension>& ball = whole_.balls[bead];
    const Integer slack = whole(sphere.radius, unit) - (ball.radius << finer);
    if (slack < 0) return true;
    Integer square = 0;
    for (int axis = 0; axis < Dimension; ++axis) {
      const Integer d =
          (ball.center[static_cast<std::size_t>(axis)] << finer) - whole(sphere.center[axis], unit);
      square += d * d;
    }
    return square > slack * slack;
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
  AutoDetector<Dimension> detector_;
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
