#include "motions/scene/scene_stream.h"

#include <fmt/format.h>

#include <algorithm>

#include "motions/base/floating_point_guard.h"
#include "motions/base/input_error.h"

namespace kds {

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

SceneSurvey SceneStream::survey(bool with_bonds, const std::function<void(const std::string&)>& warn) {
  const FloatingPointGuard to_nearest;
  SceneSurvey survey;
  std::vector<std::size_t> file_of;
  for (std::size_t f = 0; f < files_.size(); ++f)
    for (const Trajectory& head : files_[f].heads()) {
      survey.necklaces.push_back(head);
      file_of.push_back(f);
    }
  PlaneSearch planes;
  for (FrameRead frame; next(frame); ++survey.frame_count) {
    if (survey.frame_count == 0) {
      survey.first = frame.stamp;
      tell_of_nearer_images(warn);
    }
    survey.last = frame.stamp;
    planes.add(frame.positions);
    Eigen::Index begin = 0;
    for (const Trajectory& necklace : survey.necklaces) {
      const auto beads = static_cast<Eigen::Index>(necklace.bead_count());
      if (with_bonds) survey.bonds.add(frame.positions.middleCols(begin, beads), necklace.breaks);
      begin += beads;
    }
  }
  for (std::size_t f = 0, n = 0; f < files_.size(); ++f)
    for (const Trajectory& head : files_[f].heads()) survey.necklaces[n++].later_breaks = head.later_breaks;
  survey.plane = planes.plane();
  const auto longest = std::max_element(frames_.begin(), frames_.end()) - frames_.begin();
  for (std::size_t n = 0; n < file_of.size(); ++n) {
    const std::size_t frames = frames_[file_of[n]];
    survey.frames_of_necklaces.push_back(frames);
    if (frames == survey.frame_count || frames == 1) continue;
    throw InputError(fmt::format(
        "{}: {} frames, but {} has {}; necklaces of a run need equal frame counts (or one frame: at rest)",
        survey.necklaces[n].file, frames, files_[static_cast<std::size_t>(longest)].heads().front().file,
        survey.frame_count));
  }
  for (const NecklaceStream& file : files_)
    for (std::size_t n = 0; n < file.heads().size(); ++n)
      for (const std::string& warning : file.warnings(n)) warn(warning);
  rewind();
  return survey;
}

void SceneStream::tell_of_nearer_images(const std::function<void(const std::string&)>& warn) const {
  if (files_.size() == 1) return;
  EarlierNecklaces earlier;
  for (std::size_t f = 0; f < files_.size(); ++f) {
    Eigen::Index begin = 0;
    for (const Trajectory& head : files_[f].heads()) {
      const auto beads = static_cast<Eigen::Index>(head.bead_count());
      const Eigen::Matrix3Xd chain = present_[f].positions.middleCols(begin, beads);
      begin += beads;
      // The chains of the first file have been placed beside each other.
      const auto beside = f == 0 ? std::nullopt : earlier.nearer_image(chain, present_[f].cell);
      if (beside && beside->is_much_nearer())
        warn(
            fmt::format("{}: has a periodic image much nearer to the necklaces before it ({:.4g} away, not "
                        "{:.4g}), left where it is; contacts across the walls of the cell are not found",
                        head.file, beside->distance, beside->present));
      earlier.add(chain, present_[f].cell);
    }
  }
}

bool SceneStream::next(FrameRead& frame) {
  return straight_ ? straight_->next(frame, [this](FrameRead& of_files) { return read(of_files); })
                   : read(frame);
}

bool SceneStream::read(FrameRead& frame) {
  present_.resize(files_.size());
  frames_.resize(files_.size(), 0);
  bool more = false;
  std::size_t longest = 0;
  for (std::size_t f = 0; f < files_.size(); ++f) {
    if (files_[f].next(present_[f])) {
      ++frames_[f];
      more = true;
    }
    if (frames_[f] > frames_[longest]) longest = f;
  }
  if (!more) return false;
  Eigen::Index beads = 0;
  for (const FrameRead& of_file : present_) beads += of_file.positions.cols();
  frame.stamp = present_[longest].stamp;
  frame.cell.reset();
  frame.positions.resize(3, beads);
  Eigen::Index begin = 0;
  for (const FrameRead& of_file : present_) {
    frame.positions.middleCols(begin, of_file.positions.cols()) = of_file.positions;
    begin += of_file.positions.cols();
  }
  return true;
}

void SceneStream::rewind() {
  for (NecklaceStream& file : files_) file.rewind();
  if (straight_) straight_->rewind();
  std::fill(frames_.begin(), frames_.end(), 0);
}

}  // namespace kds
