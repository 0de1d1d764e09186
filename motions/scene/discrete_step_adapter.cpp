#include "motions/scene/discrete_step_adapter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "motions/base/input_error.h"

namespace kds {

DiscreteStepAdapter::DiscreteStepAdapter(std::unique_ptr<FrameSource> frames, const FrameSurvey& survey,
                                         FrameMotion motion)
    : source_(std::move(frames)),
      motion_(motion),
      velocities_(motion == FrameMotion::hermite && survey.velocities),
      plane_(survey.plane),
      periodic_(survey.periodic),
      dimension_(survey.plane ? 2 : 3),
      beads_(count_beads(source_->necklaces())),
      frame_count_(survey.frame_count),
      first_(survey.first),
      last_(survey.last) {}

DiscreteStepAdapter::DiscreteStepAdapter(std::unique_ptr<FrameSource> frames, int dimension,
                                         FrameMotion motion, bool periodic)
    : source_(std::move(frames)),
      motion_(motion),
      periodic_(periodic),
      dimension_(dimension),
      beads_(count_beads(source_->necklaces())) {}

DiscreteStepAdapter::DiscreteStepAdapter(std::unique_ptr<FrameSource> frames, const DiscreteStepAdapter& like)
    : source_(std::move(frames)),
      motion_(like.motion_),
      velocities_(like.velocities_),
      plane_(like.plane_),
      periodic_(like.periodic_),
      dimension_(like.dimension_),
      beads_(like.beads_),
      frame_count_(like.frame_count_),
      first_(like.first_),
      last_(like.last_) {}

FrameBuffer* DiscreteStepAdapter::buffer() {
  if (source_->is_open()) return nullptr;  // frames are pushed, or come from a simulation
  if (buffer_ == nullptr) {
    auto buffer = std::make_unique<FrameBuffer>(std::move(source_), first_held_ + window_.size());
    buffer_ = buffer.get();
    source_ = std::move(buffer);
  }
  return buffer_;
}

std::unique_ptr<StepSource> DiscreteStepAdapter::over(std::unique_ptr<FrameSource> frames) const {
  return std::unique_ptr<StepSource>(new DiscreteStepAdapter(std::move(frames), *this));
}

std::size_t DiscreteStepAdapter::known_steps() const {
  const std::size_t steps = frame_count_ == 0 ? 0 : frame_count_ - 1;
  return source_->is_open() ? steps - std::min(steps, reach()) : steps;
}

std::optional<VelocitySource> DiscreteStepAdapter::velocities() const {
  if (motion_ != FrameMotion::hermite) return std::nullopt;
  return velocities_ ? VelocitySource::file : VelocitySource::differences;
}

bool DiscreteStepAdapter::read_next() {
  if (!source_->next(spare_) || spare_.positions.cols() != static_cast<Eigen::Index>(beads_)) return false;
  if (plane_) plane_->lay(spare_.positions);
  if (velocities_) {
    if (spare_.velocities.cols() != spare_.positions.cols() || !spare_.stamp.picoseconds)
      throw InputError(
          fmt::format("frame {} has lost its velocities or its time since the input was first read",
                      spare_.stamp.number));
    if (plane_) plane_->lay(spare_.velocities);
  }
  if (window_.size() < 2 + 2 * reach()) {
    window_.push_back(std::exchange(spare_, {}));
  } else {  // the memory of the oldest frame serves the next one
    std::rotate(window_.begin(), window_.begin() + 1, window_.end());
    std::swap(window_.back(), spare_);
    ++first_held_;
  }
  return true;
}

bool DiscreteStepAdapter::read_new() {
  if (!read_next()) return false;
  if (frame_count_++ == 0) first_ = window_.back().stamp;
  last_ = window_.back().stamp;
  return true;
}

void DiscreteStepAdapter::read_on() {
  while (read_new()) {
  }
}

bool DiscreteStepAdapter::has_step(std::size_t k) {
  while (known_steps() <= k && source_->is_open() && read_new()) {
  }
  return k < known_steps();
}

void DiscreteStepAdapter::hold(std::size_t first, std::size_t last) {
  if (first < first_held_ || first > first_held_ + window_.size()) {
    source_->seek(first);
    window_.clear();
    first_held_ = first;
  }
  while (first_held_ + window_.size() <= last) {
    const std::size_t next = first_held_ + window_.size();
    if (!read_next())
      throw InputError(
          fmt::format("frame {} of {} is gone since the input was first read", next, frame_count_));
  }
}

void DiscreteStepAdapter::go_to(std::size_t k) {
  step_ = k;
  hold(k - std::min(k, reach()), std::min(k + 1 + reach(), frame_count_ - 1));
}

FrameStamp DiscreteStepAdapter::stamp(std::size_t frame) {
  if (frame == 0) return first_;
  if (frame + 1 == frame_count_) return last_;
  hold(frame, frame);
  return held(frame).stamp;
}

Eigen::Matrix3Xd DiscreteStepAdapter::centers(std::size_t frame) {
  hold(frame, frame);
  return held(frame).positions;
}

double DiscreteStepAdapter::coordinate(BeadId bead, int k, int axis) const {
  if (k == 0) return position(step_, bead, axis);
  if (k == degree()) return position(step_ + 1, bead, axis);
  const double point = k == 1 ? position(step_, bead, axis) + third_of_velocity(step_, bead, axis)
                              : position(step_ + 1, bead, axis) - third_of_velocity(step_ + 1, bead, axis);
  if (!std::isfinite(point))
    throw InputError(fmt::format(
        "bead {}, between frames {} and {}: moves too far for a Hermite curve in doubles; expected "
        "finite control points",
        bead, held(step_).stamp.number, held(step_ + 1).stamp.number));
  return point;
}

double DiscreteStepAdapter::third_of_velocity(std::size_t frame, BeadId bead, int axis) const {
  if (velocities_) {
    const double picoseconds = *held(step_ + 1).stamp.picoseconds - *held(step_).stamp.picoseconds;
    return held(frame).velocities(axis, static_cast<Eigen::Index>(bead)) * picoseconds / 3;
  }
  const std::size_t before = frame == 0 ? 0 : frame - 1;
  const std::size_t after = std::min(frame + 1, frame_count_ - 1);
  return (position(after, bead, axis) - position(before, bead, axis)) /
         (3.0 * static_cast<double>(after - before));
}

std::optional<LinearEnds> DiscreteStepAdapter::ends() const {
  if (degree() != 1) return std::nullopt;
  return LinearEnds{held(step_).positions.data(), held(step_ + 1).positions.data()};
}

std::optional<CellEnds> DiscreteStepAdapter::cells() const {
  if (!periodic_) return std::nullopt;
  const auto cell_of = [this](std::size_t frame) {
    const std::optional<Cell>& read = held(frame).cell;
    const std::optional<Cell> cell = read && plane_ ? plane_->laid(*read) : read;
    if (!cell)
      throw InputError(
          fmt::format("frame {} has lost its cell since the input was first read", held(frame).stamp.number));
    return *cell;
  };
  return CellEnds{cell_of(step_), cell_of(step_ + 1)};
}

Eigen::Vector3d DiscreteStepAdapter::mean_displacement() const {
  return (held(step_ + 1).positions - held(step_).positions).rowwise().mean();
}

}  // namespace kds
