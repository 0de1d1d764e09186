#include "motions/scene/straightened_frames.h"

#include <limits>
#include <utility>

#include "motions/base/floating_point_guard.h"

namespace kds {

namespace {

constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// Puts a bead's frames between two onto the chord, or halves.
void straighten_bead(const std::vector<FrameRead>& samples, Eigen::Index bead, std::size_t first,
                     std::size_t last, double tolerance, std::vector<FrameRead>& straight) {
  if (last - first < 2) return;
  const Eigen::Vector3d from = samples[first].positions.col(bead), to = samples[last].positions.col(bead);
  const auto point_at = [&](std::size_t k) -> Eigen::Vector3d {
    const double share = static_cast<double>(k - first) / static_cast<double>(last - first);
    return from + share * (to - from);  // at rest where it is
  };
  for (std::size_t k = first + 1; k < last; ++k) {
    // A difference is rounded by 2^-53 of itself in each coordinate, its length by little more, and near the
    // smallest doubles by one of these.
    const double apart = (point_at(k) - samples[k].positions.col(bead)).stableNorm();
    if (apart == 0 || apart * (1 + 0x1p-45) + smallest <= tolerance) continue;
    const std::size_t middle = first + (last - first) / 2;
    straighten_bead(samples, bead, first, middle, tolerance, straight);
    straighten_bead(samples, bead, middle, last, tolerance, straight);
    return;
  }
  for (std::size_t k = first + 1; k < last; ++k) straight[k].positions.col(bead) = point_at(k);
}

}  // namespace

void StraightenedFrames::rewind() {
  ready_.clear();
  place_ = 0;
}

void StraightenedFrames::straighten(std::vector<FrameRead>& samples, std::size_t begun) {
  const FloatingPointGuard to_nearest;
  ready_ = samples;
  place_ = begun;
  if (samples.size() == begun) return;
  const Eigen::Index beads = samples.front().positions.cols();
  for (Eigen::Index bead = 0; bead < beads; ++bead)
    straighten_bead(samples, bead, 0, samples.size() - 1, tolerance_, ready_);
  last_ = std::move(samples.back());
}

}  // namespace kds
