#include "motions/scene/frame_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "motions/base/floating_point_scope.h"
#include "motions/base/input_error.h"
#include "motions/numbers/exact_number.h"
#include "motions/scene/length_unit.h"

namespace kds {

namespace {

using Ends = std::array<Eigen::Vector3d, 2>;

// Returns whether two balls of this radius meet, decided exactly.
bool balls_meet(const Ends& centers, double radius) {
  Rational rest = 4 * Dyadic(radius).rational() * Dyadic(radius).rational();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational d = Dyadic(centers[1][axis]).rational() - Dyadic(centers[0][axis]).rational();
    rest -= d * d;
  }
  return rest >= 0;
}

}  // namespace

void AxisPlane::lay(Eigen::Matrix3Xd& frame) const {
  frame = frame(axes, Eigen::all).eval();
  frame.row(2).setZero();
}

void PlaneSearch::add(const Eigen::Matrix3Xd& frame) {
  if (!begun_ && frame.cols() > 3)
    for (const auto& axes : {std::array<Eigen::Index, 3>{0, 1, 2}, {0, 2, 1}, {1, 2, 0}})
      left_.push_back({axes, frame(axes[2], 0)});
  begun_ = true;
  std::erase_if(left_, [&](const AxisPlane& plane) {
    return !(frame.row(plane.axes[2]).array() == plane.height).all();
  });
}

std::optional<AxisPlane> PlaneSearch::plane() const {
  return left_.empty() ? std::nullopt : std::optional(left_.front());
}

void LongestBond::add(const Eigen::Ref<const Eigen::Matrix3Xd>& frame,
                      const std::vector<std::size_t>& breaks) {
  constexpr double rounding = 0x1p-48;  // well above the relative error of a length
  for (Eigen::Index i = 0; i + 1 < frame.cols(); ++i) {
    if (std::binary_search(breaks.begin(), breaks.end(), static_cast<std::size_t>(i))) continue;
    any_ = true;
    const Ends ends{frame.col(i), frame.col(i + 1)};
    const double length = (ends[1] - ends[0]).stableNorm();
    longest_ = std::isfinite(length) ? std::max(longest_, length) : std::numeric_limits<double>::infinity();
    if (!std::isfinite(longest_)) return;
    if (length / 2 < radius_ * (1 - rounding) || balls_meet(ends, radius_)) continue;
    // Half of a rounded length may leave a gap of half an ulp.
    radius_ = std::max(radius_, length / 2 * (1 - 4 * std::numeric_limits<double>::epsilon()));
    while (!balls_meet(ends, radius_))
      radius_ = std::nextafter(radius_, std::numeric_limits<double>::infinity());
  }
}

double LongestBond::radius() const {
  if (!(longest_ > 0))
    throw InputError("--radius",
                     fmt::format("auto is half the longest bond, and here {}; give {} NUMBER",
                                 any_ ? "no bond is longer than 0" : "no two consecutive beads are bonded",
                                 "--radius"_arg));
  if (!std::isfinite(longest_))
    throw InputError(
        "--radius",
        fmt::format("auto is half the longest bond, which is too large for a double here; give {} NUMBER",
                    "--radius"_arg));
  return radius_;
}

FrameSurvey survey_frames(FrameSource& frames, bool with_bonds,
                          const std::function<void(const std::string&)>& warn) {
  const FloatingPointScope to_nearest;
  const std::vector<NecklaceBeads>& necklaces = frames.necklaces();
  FrameSurvey survey;
  PlaneSearch planes;
  std::string doubt;  // about the first necklace whose unit is doubtful
  for (FrameRead frame; frames.next(frame); ++survey.frame_count) {
    if (survey.frame_count == 0) {
      survey.first = frame.stamp;
      survey.first_positions = frame.positions;
    }
    survey.last = frame.stamp;
    planes.add(frame.positions);
    Eigen::Index begin = 0;
    for (const NecklaceBeads& necklace : necklaces) {
      const auto beads = static_cast<Eigen::Index>(necklace.count);
      if (with_bonds) survey.bonds.add(frame.positions.middleCols(begin, beads), necklace.breaks);
      if (survey.frame_count == 0 && warn && doubt.empty()) {
        doubt = nanometres_doubt(frame.positions.middleCols(begin, beads), necklace.breaks);
        if (!doubt.empty()) doubt = fmt::format("{}: {}", necklace.file, doubt);
      }
      begin += beads;
    }
  }
  survey.truncated = frames.is_truncated();
  survey.plane = planes.plane();
  if (!doubt.empty()) warn(doubt);
  if (warn)
    for (const std::string& line : frames.warnings()) warn(line);
  frames.seek(0);
  return survey;
}

}  // namespace kds
