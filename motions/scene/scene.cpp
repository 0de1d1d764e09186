#include "motions/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "motions/base/input_error.h"

namespace kds {

namespace {

// Throws if a coordinate is not finite, since exact numbers cannot represent it. Readers also reject such
// coordinates, naming the line; this check covers all motions.
void check_frame(const Trajectory& necklace, std::size_t frame) {
  const Eigen::Matrix3Xd& centers = necklace.frames[frame];
  if (centers.allFinite()) return;
  for (Eigen::Index bead = 0; bead < centers.cols(); ++bead) {
    if (centers.col(bead).allFinite()) continue;
    throw InputError(fmt::format("{}: frame {}, bead {}: expected finite coordinates, found {}, {}, {}",
                                 necklace.file, necklace.frame_number(frame), bead, centers(0, bead),
                                 centers(1, bead), centers(2, bead)));
  }
}

void check_radii(const std::vector<double>& radii) {
  for (std::size_t bead = 0; bead < radii.size(); ++bead) {
    if (std::isfinite(radii[bead] * radii[bead])) continue;
    throw InputError(
        fmt::format("bead {}: expected a radius with a finite square, found {}", bead, radii[bead]));
  }
}

void check_control_points(const Instance& instance) {
  for (std::size_t point = 0; point < instance.point_count(); ++point) {
    for (int column = 0; column < instance.columns; ++column) {
      for (int k = 0; k <= instance.degree; ++k) {
        if (std::isfinite(instance.control_point(point, column, k))) continue;
        throw InputError(fmt::format("{}: bead {}, column {}: expected finite control points, found {}",
                                     instance.file, point, column, instance.control_point(point, column, k)));
      }
    }
  }
}

}  // namespace

Scene::Scene(std::span<const Trajectory> necklaces, std::vector<double> radii, FrameMotion motion)
    : radii_(std::move(radii)) {
  const Trajectory* longest = nullptr;
  std::vector<std::size_t> bead_counts;
  for (const Trajectory& necklace : necklaces) {
    if (longest == nullptr || necklace.frames.size() > longest->frames.size()) longest = &necklace;
    bead_counts.push_back(necklace.bead_count());
  }
  frame_count_ = longest == nullptr ? 0 : longest->frames.size();
  begin(motion, bead_counts, longest == nullptr ? "no input" : longest->file);
  name_beads(necklaces);
  held_.resize(frame_count_);
  for (std::size_t k = 0; k < frame_count_; ++k) {
    held_[k].stamp.number = longest->frame_number(k);
    if (k < longest->times.size()) held_[k].stamp.picoseconds = longest->times[k];
    held_[k].positions.resize(3, static_cast<Eigen::Index>(necklaces_.back().last) + 1);
  }
  first_ = held_.front().stamp;
  last_ = held_.back().stamp;
  for (std::size_t n = 0; n < necklaces.size(); ++n) {
    const auto& frames = necklaces[n].frames;
    if (frames.size() != frame_count_ && frames.size() != 1) {
      throw InputError(fmt::format(
          "{}: {} frames, but {} has {}; necklaces of a run need equal frame counts (or one frame: at rest)",
          necklaces[n].file, frames.size(), longest->file, frame_count_));
    }
    for (std::size_t k = 0; k < frames.size(); ++k) check_frame(necklaces[n], k);
    for (std::size_t k = 0; k < frame_count_; ++k) {
      const auto& frame = frames[frames.size() == 1 ? 0 : k];
      held_[k].positions.middleCols(necklaces_[n].first, frame.cols()) = frame;
    }
  }
  check_radii(radii_);
  PlaneSearch planes;
  for (const FrameRead& frame : held_) planes.add(frame.positions);
  lay_in_plane(planes.plane());
  for (FrameRead& frame : held_) lay_in_plane(frame.positions);
}

Scene::Scene(std::unique_ptr<SceneStream> frames, const SceneSurvey& survey, std::vector<double> radii,
             FrameMotion motion)
    : frame_count_(survey.frame_count),
      radii_(std::move(radii)),
      first_(survey.first),
      last_(survey.last),
      stream_(std::move(frames)),
      most_held_(motion == FrameMotion::hermite ? 4 : 2) {
  std::vector<std::size_t> bead_counts;
  for (const Trajectory& necklace : survey.necklaces) bead_counts.push_back(necklace.bead_count());
  begin(motion, bead_counts, survey.necklaces.empty() ? "no input" : survey.necklaces.front().file);
  name_beads(survey.necklaces);
  check_radii(radii_);
  lay_in_plane(survey.plane);
}

void Scene::begin(FrameMotion motion, const std::vector<std::size_t>& bead_counts,
                  const std::string& longest) {
  degree_ = motion == FrameMotion::hermite ? 3 : 1;
  is_lifted_ = motion == FrameMotion::lifted;
  set_necklaces(bead_counts);
  if (frame_count_ < 2)
    throw InputError(
        fmt::format("{}: a run needs at least two frames, this input has {}", longest, frame_count_));
  if (necklaces_.empty() || necklaces_.back().last + 1 == 0)
    throw InputError(fmt::format("{}: expected beads, found none", longest));
}

void Scene::set_necklaces(const std::vector<std::size_t>& bead_counts) {
  BeadId beads = 0;
  for (const std::size_t count : bead_counts) {
    necklaces_.push_back({beads, beads + static_cast<BeadId>(count) - 1});
    beads += static_cast<BeadId>(count);
  }
}

Scene::Scene(PushedFrames frames)
    : dimension_(frames.dimension),
      degree_(frames.motion == FrameMotion::hermite ? 3 : 1),
      is_lifted_(frames.motion == FrameMotion::lifted),
      has_radii_(!frames.radii.empty()),
      radii_(std::move(frames.radii)),
      pushed_(true),
      most_held_(frames.motion == FrameMotion::hermite ? 4 : 2) {
  if (dimension_ < 1 || dimension_ > 3)
    throw InputError(fmt::format("frames in {} dimensions: expected 1, 2 or 3", dimension_));
  if (is_lifted_ && dimension_ == 1)
    throw InputError("lifted motion in 1 dimension: expected 2 or 3, or another kind of motion");
  for (std::size_t n = 0; n < frames.necklaces.size(); ++n)
    if (frames.necklaces[n] == 0) throw InputError(fmt::format("necklace {}: expected beads, found none", n));
  if (frames.necklaces.empty()) throw InputError("frames of no necklace: expected beads, found none");
  set_necklaces(frames.necklaces);
  const std::size_t beads = std::size_t{necklaces_.back().last} + 1;
  if (radii_.size() == 1) radii_.resize(beads, radii_.front());
  if (has_radii_ && radii_.size() != beads)
    throw InputError(fmt::format("{} beads: expected as many radii, or one, found {}", beads, radii_.size()));
  for (std::size_t bead = 0; bead < radii_.size(); ++bead)
    if (radii_[bead] < 0)
      throw InputError(
          fmt::format("bead {}: expected a radius that is not negative, found {}", bead, radii_[bead]));
  check_radii(radii_);
  radii_.resize(beads, 0);
}

void Scene::push(std::span<const double> coordinates, std::optional<double> picoseconds) {
  if (!pushed_ || ended_)
    throw std::logic_error(pushed_ ? "a frame is pushed after the last one"
                                   : "a frame is pushed to a scene that has frames of its own");
  const auto columns = static_cast<std::size_t>(dimension_);
  if (coordinates.size() != columns * bead_count())
    throw InputError(fmt::format("frame {}: expected {} of {} beads, {} numbers, found {}", frame_count_,
                                 columns == 1 ? "1 coordinate" : fmt::format("{} coordinates each", columns),
                                 bead_count(), columns * bead_count(), coordinates.size()));
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (std::isfinite(coordinates[i])) continue;
    throw InputError(fmt::format("frame {}, bead {}: expected finite coordinates, found {}", frame_count_,
                                 i / columns, coordinates[i]));
  }
  FrameRead frame;
  if (held_.size() == most_held_) {  // reuse the memory of the oldest frame
    frame = std::move(held_.front());
    held_.erase(held_.begin());
    ++first_held_;
  }
  frame.stamp = {frame_count_, picoseconds};
  frame.positions.setZero(3, static_cast<Eigen::Index>(bead_count()));
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    frame.positions(static_cast<Eigen::Index>(i % columns), static_cast<Eigen::Index>(i / columns)) =
        coordinates[i];
  if (frame_count_ == 0) first_ = frame.stamp;
  last_ = frame.stamp;
  held_.push_back(std::move(frame));
  ++frame_count_;
}

std::size_t Scene::known_steps() const {
  const std::size_t steps = step_count();
  return pushed_ && degree_ == 3 && !ended_ && steps > 0 ? steps - 1 : steps;
}

void Scene::name_beads(std::span<const Trajectory> necklaces) {
  for (std::size_t n = 0; n < necklaces.size(); ++n) {
    const std::vector<std::string>& names = necklaces[n].bead_names;
    if (names.empty()) continue;
    bead_names_.resize(bead_count());
    std::copy(names.begin(), names.end(), bead_names_.begin() + necklaces_[n].first);
  }
}

void Scene::lay_in_plane(const std::optional<AxisPlane>& plane) {
  plane_ = plane;
  if (plane_) dimension_ = 2;
}

void Scene::lay_in_plane(Eigen::Matrix3Xd& frame) const {
  if (!plane_) return;
  frame = frame(plane_->axes, Eigen::all).eval();
  frame.row(2).setZero();
}

void Scene::hold(std::size_t first, std::size_t last) const {
  if (pushed_ && (first < first_held_ || last >= first_held_ + held_.size()))
    throw InputError(fmt::format("frame {} {}: of frames that are pushed those of one step are kept",
                                 first < first_held_ ? first : last,
                                 first < first_held_ ? "is gone" : "has not come"));
  if (!stream_) return;
  if (first < first_held_) {
    stream_->rewind();
    held_.clear();
    first_held_ = 0;
  }
  while (first_held_ + held_.size() <= last) {
    FrameRead next;
    if (held_.size() == most_held_) {  // reuse the memory of the oldest frame
      next = std::move(held_.front());
      held_.erase(held_.begin());
      ++first_held_;
    }
    if (!stream_->next(next) || next.positions.cols() != static_cast<Eigen::Index>(bead_count()))
      throw InputError(fmt::format("frame {} of {} is gone since the input was first read",
                                   first_held_ + held_.size(), frame_count_));
    lay_in_plane(next.positions);
    held_.push_back(std::move(next));
  }
}

void Scene::hold_for_step(std::size_t step) const {
  if (degree_ == 3) {
    hold(step == 0 ? 0 : step - 1, std::min(step + 2, frame_count_ - 1));
  } else {
    hold(step, step + 1);
  }
}

FrameStamp Scene::stamp(std::size_t frame) const {
  require_index("frame", frame, frame_count_);
  if (!is_sampled()) return {frame, std::nullopt};
  if (frame == 0) return first_;
  if (frame + 1 == frame_count_) return last_;
  hold(frame, frame);
  return held_[frame - first_held_].stamp;
}

Eigen::Vector3d Scene::in_input(const Eigen::Vector3d& point) const {
  const AxisPlane plane = plane_.value_or(AxisPlane{});
  Eigen::Vector3d there = Eigen::Vector3d::Constant(plane.height);
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimension_); ++k)
    there[plane.axes[k]] = point[static_cast<Eigen::Index>(k)];
  return there;
}

Scene::Scene(Instance instance, std::vector<double> radii)
    : dimension_(instance.dimension()),
      degree_(instance.degree),
      has_radii_(!radii.empty()),
      frame_count_(2),
      radii_(std::move(radii)),
      instance_(std::move(instance)) {
  check_control_points(*instance_);
  const std::size_t points = instance_->point_count();
  necklaces_.push_back({0, static_cast<BeadId>(points - 1)});
  if (has_radii_) {
    if (radii_.size() != points) {
      throw InputError(fmt::format("{}: {} points, expected as many radii, found {}", instance_->file, points,
                                   radii_.size()));
    }
    check_radii(radii_);
    return;
  }
  radii_.assign(points, 0);
  if (instance_->weighted()) {
    for (std::size_t p = 0; p < points; ++p)
      radii_[p] = std::sqrt(std::max(0.0, instance_->control_point(p, 3, 0)));
  }
}

void Scene::require_weights() const {
  if (!has_radii_ || equal_radii()) return;
  for (std::size_t bead = 0; bead < radii_.size(); ++bead) {
    const double radius = radii_[bead];
    if (radius == 0 || radius * radius >= std::numeric_limits<double>::min()) continue;
    throw InputError(
        fmt::format("bead {}: the square of its radius, {}, is too small a number for a power diagram; "
                    "give all lengths in a smaller unit",
                    bead, radius));
  }
}

bool Scene::equal_radii() const {
  if (!has_radii_ && instance_ && instance_->weighted()) {
    for (BeadId b = 0; b < bead_count(); ++b) {
      for (int k = 0; k <= degree_; ++k) {
        if (weight(b, k) != weight(0, k)) return false;
      }
    }
    return true;
  }
  return std::all_of(radii_.begin(), radii_.end(), [&](double r) { return r == radii_.front(); });
}

double Scene::coordinate(std::size_t step, BeadId bead, int k, int axis) const {
  if (!is_sampled()) return instance_->control_point(bead, axis, k);
  if (k == 0) return frame(step)(axis, bead);
  if (k == degree_) return frame(step + 1)(axis, bead);
  const double point = k == 1 ? frame(step)(axis, bead) + third_of_velocity(step, bead, axis)
                              : frame(step + 1)(axis, bead) - third_of_velocity(step + 1, bead, axis);
  if (!std::isfinite(point)) {
    throw InputError(fmt::format(
        "bead {}, between frames {} and {}: moves too far for a Hermite curve in doubles; expected "
        "finite control points",
        bead, frame_number(step), frame_number(step + 1)));
  }
  return point;
}

double Scene::third_of_velocity(std::size_t frame, BeadId bead, int axis) const {
  const std::size_t before = frame == 0 ? 0 : frame - 1;
  const std::size_t after = std::min(frame + 1, frame_count_ - 1);
  return (this->frame(after)(axis, bead) - this->frame(before)(axis, bead)) /
         (3.0 * static_cast<double>(after - before));
}

double Scene::weight(BeadId bead, int k) const {
  if (!has_radii_ && instance_ && instance_->weighted()) return instance_->control_point(bead, 3, k);
  return radii_[bead] * radii_[bead];
}

Eigen::Matrix3Xd Scene::centers(std::size_t frame) const {
  require_index("frame", frame, frame_count_);
  if (is_sampled()) {
    hold(frame, frame);
    return this->frame(frame);
  }
  Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(bead_count()));
  for (BeadId b = 0; b < bead_count(); ++b) {
    for (int axis = 0; axis < dimension_; ++axis)
      centers(axis, b) = instance_->control_point(b, axis, frame == 0 ? 0 : degree_);
  }
  return centers;
}

std::vector<double> Scene::weights(std::size_t frame) const {
  require_index("frame", frame, frame_count_);
  std::vector<double> weights(bead_count());
  for (BeadId b = 0; b < bead_count(); ++b) weights[b] = weight(b, frame == 0 ? 0 : degree_);
  return weights;
}

}  // namespace kds
