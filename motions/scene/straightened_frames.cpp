#include "motions/scene/straightened_frames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "motions/base/floating_point_scope.h"

namespace kds {

namespace {

constexpr double smallest = std::numeric_limits<double>::denorm_min();

}  // namespace

StraightenedFrames::StraightenedFrames(std::unique_ptr<FrameSource> samples, double tolerance)
    : source_(std::move(samples)), tolerance_(tolerance), most_square_(0) {
  if (source_->is_open()) throw std::logic_error("frames are straightened before the last one has come");
  // Differences, squares and sums are rounded by less than 2^-49 in total, unless a number is close to
  // underflow.
  if (tolerance > 0x1p-400 && tolerance < 0x1p400) most_square_ = tolerance * tolerance * (1 - 0x1p-45);
}

bool StraightenedFrames::next(FrameRead& frame) {
  if (next_ready_ == ready_.size()) fill();
  if (next_ready_ == ready_.size()) return false;
  frame.stamp = ready_[next_ready_].stamp;
  frame.cell = ready_[next_ready_].cell;
  frame.positions = ready_[next_ready_++].positions;
  ++next_;
  return true;
}

void StraightenedFrames::seek(std::size_t k) {
  if (k < next_) {
    source_->seek(0);
    samples_.clear();
    ready_.clear();
    begin_ = next_ready_ = next_ = 0;
    grid_ = 0;
  }
  FrameRead passed;
  while (next_ < k && next(passed)) {
  }
}

void StraightenedFrames::fill() {
  go_to_next_block();
  for (FrameRead frame; samples_.size() <= begin_ + block + reach && source_->next(frame);)
    samples_.push_back({frame.stamp, std::move(frame.positions), frame.cell});
  straighten_block();
}

void StraightenedFrames::go_to_next_block() {
  if (ready_.empty()) return;
  begin_ += ready_.size() - 1;
  const std::size_t past = begin_ - std::min(begin_, reach);
  samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(past));
  begin_ -= past;
}

void StraightenedFrames::straighten_block() {
  const FloatingPointScope to_nearest;
  if (samples_.empty()) return;
  const std::size_t end = std::min(begin_ + block + 1, samples_.size());
  std::vector<FrameRead> straight(samples_.begin() + static_cast<std::ptrdiff_t>(begin_),
                                  samples_.begin() + static_cast<std::ptrdiff_t>(end));
  const bool first = ready_.empty();
  if (first) {
    const double farthest = straight.front().positions.cwiseAbs().maxCoeff();
    const double length = std::min(tolerance_, farthest);
    grid_ = length > 0x1p-900 && length < 0x1p900 ? std::ldexp(1.0, std::ilogb(length) - 20) : 0;
  } else {
    straight.front().positions = ready_.back().positions;
  }
  next_ready_ = first ? 0 : 1;
  ready_ = std::move(straight);
  const Eigen::Index beads = ready_.front().positions.cols();
  for (Eigen::Index bead = 0; bead < beads; ++bead) {
    if (first) ready_.front().positions.col(bead) = knot(begin_, bead);
    straighten_bead(bead, 0, block);
  }
}

/// Straightens the bead's frames after `first`, which is done, over at most `length` frames, a power of two.
void StraightenedFrames::straighten_bead(Eigen::Index bead, std::size_t first, std::size_t length) {
  const std::size_t last = first + length;
  if (last < ready_.size()) {
    const Eigen::Vector3d from = ready_[first].positions.col(bead), to = knot(begin_ + last, bead);
    const auto point_at = [&](std::size_t k) -> Eigen::Vector3d {
      const double share = static_cast<double>(k - first) / static_cast<double>(length);
      return from + share * (to - from);  // unchanged if at rest
    };
    bool within = true;
    for (std::size_t k = first + 1; k < last && within; ++k)
      within = is_within(point_at(k), samples_[begin_ + k].positions.col(bead));
    if (within) {
      for (std::size_t k = first + 1; k < last; ++k) ready_[k].positions.col(bead) = point_at(k);
      ready_[last].positions.col(bead) = to;
      return;
    }
  }
  if (length == 1) return;
  straighten_bead(bead, first, length / 2);
  straighten_bead(bead, first + length / 2, length / 2);
}

bool StraightenedFrames::is_within(const Eigen::Vector3d& point, const Eigen::Vector3d& sample) const {
  const Eigen::Vector3d apart = point - sample;
  if (most_square_ > 0) return apart.squaredNorm() <= most_square_;
  if (!apart.allFinite()) return false;
  // The relative rounding of each coordinate's difference is 2^-53, that of the length little more. Near
  // underflow, the rounding error is at most the smallest double.
  const double length = apart.stableNorm();
  return length == 0 || length * (1 + 0x1p-45) + smallest <= tolerance_;
}

Eigen::Vector3d StraightenedFrames::on_grid(const Eigen::Vector3d& point) const {
  Eigen::Vector3d rounded = point;
  for (double& x : rounded) {
    const double steps = x / grid_;
    if (std::abs(steps) < 0x1p52)
      x = std::nearbyint(steps) * grid_;  // otherwise, or without a grid, x is unchanged
  }
  return rounded;
}

Eigen::Vector3d StraightenedFrames::knot(std::size_t sample, Eigen::Index bead) const {
  const auto at = [&](std::size_t k) { return samples_[k].positions.col(bead); };
  const Eigen::Vector3d here = at(sample);
  if (tolerance_ == 0) return here;
  const std::size_t before = std::min(reach, sample), after = std::min(reach, samples_.size() - 1 - sample);
  Eigen::Array<bool, 3, 1> stays(true, true, true);
  for (std::size_t k = sample - before; k <= sample + after; ++k)
    stays = stays && at(k).array() == here.array();
  const auto settled = [&](const Eigen::Vector3d& point) -> Eigen::Vector3d {
    return stays.select(here.array(), on_grid(point).array());
  };
  // Nearer samples have larger weights, which decrease linearly.
  const std::size_t around = std::min(before, after);
  const auto all = static_cast<double>((around + 1) * (around + 1));
  Eigen::Vector3d mean = static_cast<double>(around + 1) / all * here;
  for (std::size_t k = 1; k <= around; ++k)
    mean += static_cast<double>(around + 1 - k) / all * (at(sample - k) + at(sample + k));
  const Eigen::Vector3d at_mean = settled(mean);
  if (is_within(at_mean, here)) return at_mean;
  const Eigen::Vector3d away = mean - here;
  const Eigen::Vector3d pulled = settled(here + (1 - 0x1p-10) * tolerance_ / away.stableNorm() * away);
  if (is_within(pulled, here)) return pulled;
  const Eigen::Vector3d at_sample = settled(here);
  return is_within(at_sample, here) ? at_sample : here;
}

std::vector<Eigen::Matrix3Xd> straightened(std::vector<Eigen::Matrix3Xd> frames, double tolerance) {
  Trajectory samples;
  samples.frames = std::move(frames);
  auto source = std::make_unique<MemoryFrames>(std::span(&samples, 1));
  StraightenedFrames straight(std::move(source), tolerance);
  std::vector<Eigen::Matrix3Xd> straightened;
  for (FrameRead frame; straight.next(frame);) straightened.push_back(std::move(frame.positions));
  return straightened;
}

}  // namespace kds
