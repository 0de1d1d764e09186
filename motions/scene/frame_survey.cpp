#include "motions/scene/frame_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "motions/base/floating_point_scope.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/frames/periodic.h"
#include "motions/numbers/exact_number.h"
#include "motions/scene/length_unit.h"

namespace kds {

namespace {

using Ends = std::array<Eigen::Vector3d, 2>;

// Returns the plane across an axis, at height 0.
AxisPlane plane_across(std::size_t axis) {
  constexpr std::array<std::array<Eigen::Index, 3>, 3> axes{{{1, 2, 0}, {0, 2, 1}, {0, 1, 2}}};
  return {axes[axis], 0};
}

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

std::optional<Cell> AxisPlane::laid(const Cell& cell) const {
  Cell in_plane = Cell::Zero();
  Eigen::Index count = 0;
  for (Eigen::Index vector = 0; vector < 3; ++vector) {
    const Eigen::Vector3d turned = cell.col(vector)(axes);
    if (turned.isZero(0)) continue;
    if (turned[2] == 0) {
      in_plane.col(count++) = turned;
    } else if (turned[0] != 0 || turned[1] != 0) {
      return std::nullopt;
    }
  }
  return count == 0 ? std::nullopt : std::optional(in_plane);
}

void PlaneSearch::add(const FrameRead& frame, bool with_velocities) {
  if (!begun_ && frame.positions.cols() > 3)
    for (const auto& axes : {std::array<Eigen::Index, 3>{0, 1, 2}, {0, 2, 1}, {1, 2, 0}})
      left_.push_back({axes, frame.positions(axes[2], 0)});
  begun_ = true;
  std::erase_if(left_, [&](const AxisPlane& plane) {
    return !(frame.positions.row(plane.axes[2]).array() == plane.height).all() ||
           (with_velocities && frame.velocities.cols() > 0 &&
            !(frame.velocities.row(plane.axes[2]).array() == 0).all());
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

void CellSurvey::add(const FrameRead& frame) {
  if (!frame.cell) {
    ++without_cell_;
    last_.resize(3, 0);
    last_cell_.reset();
    return;
  }
  ++with_cell_;
  std::array<bool, 3> spans{};
  for (std::size_t vector = 0; vector < 3; ++vector)
    spans[vector] = !frame.cell->col(static_cast<Eigen::Index>(vector)).isZero(0);
  if (!spans_) spans_ = spans;
  alike_ = alike_ && spans == *spans_;
  for (std::size_t across = 0; across < 3; ++across)
    if (!plane_across(across).laid(*frame.cell)) in_plane_[across] = false;
  if (last_.cols() == frame.positions.cols() && frame.stamp.number == last_number_ + 1) {
    const double shortest = Images(*frame.cell).reduced().col(0).norm();
    for (Eigen::Index bead = 0; bead < last_.cols(); ++bead) {
      const double length = (frame.positions.col(bead) - last_.col(bead)).norm();
      if (2 * length <= shortest) continue;
      if (far_.count++ == 0)
        far_ = {1, frame.stamp.number, static_cast<std::size_t>(bead), length, shortest / 2};
    }
  }
  if (last_cell_ && frame.stamp.number == last_number_ + 1) {
    const double change = (*frame.cell - *last_cell_).norm();
    const double shortest = Images(*last_cell_).reduced().col(0).norm();
    if (2 * change > shortest && jumps_.count++ == 0) jumps_ = {1, frame.stamp.number, change, shortest / 2};
  }
  last_cell_ = frame.cell;
  last_ = frame.positions;
  last_number_ = frame.stamp.number;
}

void VelocitySurvey::add(const FrameRead& frame) {
  const bool has_velocities = frame.velocities.cols() > 0;
  any_ = any_ || has_velocities;
  const std::optional<double>& time = frame.stamp.picoseconds;
  const bool is_later = frames_ == 0 || (time && last_time_ && *time > *last_time_);
  if (lacks_.empty() && !(has_velocities && time && is_later))
    lacks_ = fmt::format("frame {} {}", frame.stamp.number,
                         !has_velocities ? "has no velocities"
                         : !time         ? "has no time"
                                         : "is not later than the frame before");
  last_time_ = time;
  ++frames_;
  if (!lacks_.empty()) return recent_.clear();
  recent_.push_back(frame);
  constexpr std::size_t window = 7;
  if (recent_.size() < window) return;
  const auto at = [&](std::size_t k) { return *recent_[k].stamp.picoseconds; };
  const auto velocity = [&](std::size_t k) -> Eigen::Matrix3Xd {
    return (recent_[k + 2].positions - recent_[k - 2].positions) / (at(k + 2) - at(k - 2));
  };
  const double step = at(4) - at(2), u = (at(3) - at(2)) / step;
  const auto error = [&](const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& after) {
    const Eigen::Matrix3Xd move = recent_[4].positions - recent_[2].positions;
    return (recent_[2].positions - recent_[3].positions + u * u * (3 - 2 * u) * move +
            step * u * (1 - u) * ((1 - u) * before - u * after))
        .squaredNorm();
  };
  with_velocities_ += error(recent_[2].velocities, recent_[4].velocities);
  with_differences_ += error(velocity(2), velocity(4));
  recent_.pop_front();
}

double VelocitySurvey::relative_error() const {
  if (with_velocities_ == with_differences_) return 1;     // also for fewer than seven frames
  return std::sqrt(with_velocities_ / with_differences_);  // infinite if differences are exact
}

bool CellSurvey::is_periodic(const std::optional<AxisPlane>& plane) const {
  if (with_cell_ == 0 || without_cell_ > 0 || !alike_) return false;
  return !plane || in_plane_[static_cast<std::size_t>(plane->axes[2])];
}

std::string CellSurvey::why_not() const {
  if (with_cell_ == 0) return "";
  if (without_cell_ > 0)
    return fmt::format("{} of the run {} no cell that all inputs share", counted(without_cell_, "frame"),
                       without_cell_ == 1 ? "has" : "have");
  return alike_ ? "a cell vector lies askew to the plane of the beads"
                : "frames differ in which vectors of the cell are periodic";
}

std::vector<std::string> CellSurvey::guesses(const std::vector<NecklaceBeads>& necklaces) const {
  std::vector<std::string> lines;
  if (far_.count > 0) {
    std::size_t bead = far_.first_bead;
    auto necklace = necklaces.begin();
    for (; bead >= necklace->count; ++necklace) bead -= necklace->count;
    const std::string name = necklace->names.empty() ? "" : fmt::format(" ({})", necklace->names[bead]);
    lines.push_back(fmt::format(
        "{}: frame {}: bead {}{} has moved {:.4g} since the frame before, more than half of the cell's "
        "shortest vector ({:.4g}), so its path is a guess ({})",
        necklace->file, far_.first_frame, far_.first_bead, name, far_.length, far_.half_cell,
        counted(far_.count, "such move")));
  }
  if (jumps_.count > 0)
    lines.push_back(
        fmt::format("{}: frame {}: the cell has changed by {:.4g} since the frame before, more than half of "
                    "its shortest vector ({:.4g}), so the paths of images are a guess ({})",
                    necklaces.front().file, jumps_.first_frame, jumps_.change, jumps_.half_cell,
                    counted(jumps_.count, "such change")));
  return lines;
}

FrameSurvey survey_frames(FrameSource& frames, bool with_bonds,
                          const std::function<void(const std::string&)>& warn) {
  const FloatingPointScope to_nearest;
  const std::vector<NecklaceBeads>& necklaces = frames.necklaces();
  if (frames.is_open())
    throw InputError(
        fmt::format("{}: frames come one by one, and cannot be surveyed before the run; expected a "
                    "file",
                    necklaces.front().file));
  FrameSurvey survey;
  PlaneSearch planes, planes_of_positions;
  CellSurvey cells;
  VelocitySurvey velocities;
  std::string doubt;  // about the first necklace whose unit is doubtful
  for (FrameRead frame; frames.next(frame); ++survey.frame_count) {
    if (survey.frame_count == 0) {
      survey.first = frame.stamp;
      survey.first_positions = frame.positions;
    }
    survey.last = frame.stamp;
    planes.add(frame, true);
    planes_of_positions.add(frame, false);
    cells.add(frame);
    velocities.add(frame);
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
  survey.periodic = cells.is_periodic(survey.plane);
  survey.plane_of_positions = planes_of_positions.plane();
  survey.periodic_in_that_plane = cells.is_periodic(survey.plane_of_positions);
  survey.velocities = velocities.all();
  if (!survey.velocities) survey.leave_velocities(velocities.why_not());
  if (!survey.periodic) survey.lacks_images = cells.why_not();
  survey.error_with_velocities = velocities.relative_error();
  if (!doubt.empty()) warn(doubt);
  if (warn)
    for (const std::string& line : frames.warnings()) warn(line);
  if (warn && survey.periodic)
    for (const std::string& line : cells.guesses(necklaces)) warn(line);
  frames.seek(0);
  return survey;
}

}  // namespace kds
