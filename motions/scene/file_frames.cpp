#include "motions/scene/file_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "motions/base/text_input.h"
#include "motions/frames/periodic.h"

namespace kds {

FileFrames::FileFrames(std::vector<NecklaceStream> files, bool last_is_obstacle)
    : files_(std::move(files)), present_(files_.size()), first_cells_(files_.size()), read_(files_.size()) {
  const bool some_move = std::any_of(files_.begin(), files_.end(),
                                     [](const NecklaceStream& file) { return !file.holds_one_frame(); });
  for (NecklaceStream& file : files_) {
    at_rest_.push_back(files_.size() > 1 && file.holds_one_frame());
    if (file.is_live()) live_ = static_cast<std::size_t>(&file - files_.data());
    const bool is_obstacle = last_is_obstacle && &file == &files_.back();
    for (const Trajectory& head : file.heads()) {
      necklaces_.push_back(beads_of(head));
      necklaces_.back().chain_like = file.chain_like();
      necklaces_.back().at_rest = is_obstacle || (at_rest_.back() && some_move);
    }
  }
  for (std::size_t f = 0; live_ && f < files_.size(); ++f)
    if (f != *live_ && !at_rest_[f])
      throw InputError(
          fmt::format("{}: has several frames; beside the running simulation {} expected inputs "
                      "of one frame",
                      files_[f].heads().front().file, files_[*live_].heads().front().file));
}

bool FileFrames::next(FrameRead& frame) {
  InterruptionCheck::ask();
  std::optional<std::size_t> more, truncated;  // files that give a frame, or have lost it
  for (std::size_t f = 0; f < files_.size(); ++f) {
    if (files_[f].next(present_[f])) {
      ++read_[f];
      more = more.value_or(f);
      if (next_ == 0) first_cells_[f] = present_[f].cell;
    } else if (!at_rest_[f] && files_[f].is_truncated()) {
      truncated = truncated.value_or(f);
    }
  }
  if (!more || truncated) {
    all_ = read_;
    for (std::size_t& frames : all_) frames = std::min(frames, next_);
    if (more)
      early_end_ = fmt::format("{}: frames are missing after frame {}, so later frames of {} are left out",
                               files_[*truncated].heads().front().file, last_number_,
                               files_[*more].heads().front().file);
    check_frame_counts();
    return false;
  }
  frame.stamp = stamp();
  last_number_ = frame.stamp.number;
  ++next_;
  frame.cell = common_cell();
  frame.positions.resize(3, static_cast<Eigen::Index>(count_beads(necklaces_)));
  bool have_velocities = false;  // all files that move
  for (std::size_t f = 0; f < files_.size(); ++f)
    if (!at_rest_[f] && !(have_velocities = present_[f].velocities.cols() > 0)) break;
  frame.velocities.setZero(3, have_velocities ? frame.positions.cols() : 0);
  Eigen::Index begin = 0;
  for (std::size_t f = 0; f < files_.size(); ++f) {
    const FrameRead& of_file = present_[f];
    const Eigen::Index beads = of_file.positions.cols();
    frame.positions.middleCols(begin, beads) = of_file.positions;
    if (frame.velocities.cols() > 0 && !at_rest_[f])
      frame.velocities.middleCols(begin, beads) = of_file.velocities;
    begin += beads;
  }
  return true;
}

std::optional<Cell> FileFrames::common_cell() {
  std::optional<std::size_t> first;
  for (std::size_t f = 0; f < files_.size(); ++f) {
    if (at_rest_[f]) continue;
    first = first.value_or(f);
    if (present_[f].cell == present_[*first].cell) continue;
    if (cells_differ_.empty())
      cells_differ_ = fmt::format(
          "{}: frame {}: its periodic cell is not that of {}, so beads have no images across the walls",
          files_[f].heads().front().file, present_[f].stamp.number, files_[*first].heads().front().file);
    return std::nullopt;
  }
  return first ? present_[*first].cell : std::nullopt;
}

FrameStamp FileFrames::stamp() {
  // Programs round times differently, and formats have single precision.
  const auto differ = [](double a, double b) {
    return std::abs(a - b) > 1e-5 + 1e-6 * std::max(std::abs(a), std::abs(b));
  };
  std::optional<std::size_t> first, timed;
  bool differs = false;
  for (std::size_t f = 0; f < files_.size(); ++f) {
    const FrameStamp& own = present_[f].stamp;
    if (at_rest_[f] || read_[f] != next_ + 1) continue;
    if (!first) first = f;
    if (!own.picoseconds) continue;
    if (!timed) timed = f;
    const FrameStamp& other = present_[*timed].stamp;
    if (differs || !differ(*own.picoseconds, *other.picoseconds)) continue;
    differs = true;
    if (times_differ_++ == 0)
      first_difference_ = fmt::format(
          "{}: frame {} has the time {} ps, frame {} of {} beside it {} ps; the times of {} are used",
          files_[f].heads().front().file, own.number, *own.picoseconds, other.number,
          files_[*timed].heads().front().file, *other.picoseconds, files_[*timed].heads().front().file);
  }
  if (!first) return present_.front().stamp;
  FrameStamp stamp = present_[*first].stamp;
  if (timed) stamp.picoseconds = present_[*timed].stamp.picoseconds;
  return stamp;
}

void FileFrames::seek(std::size_t k) {
  if (k < next_) {
    for (NecklaceStream& file : files_) file.rewind();
    std::fill(read_.begin(), read_.end(), 0);
    next_ = times_differ_ = 0;
    cells_differ_.clear();
  }
  FrameRead passed;
  while (next_ < k && next(passed)) {
  }
}

void FileFrames::check_frame_counts() const {
  const auto longest = static_cast<std::size_t>(std::max_element(all_.begin(), all_.end()) - all_.begin());
  for (std::size_t f = 0; f < files_.size(); ++f) {
    if (all_[f] == all_[longest] || at_rest_[f]) continue;
    throw InputError(fmt::format(
        "{}: {}, but {} has {}; necklaces of a run need equal frame counts (or one frame: at rest)",
        files_[f].heads().front().file, counted(all_[f], "frame"), files_[longest].heads().front().file,
        all_[longest]));
  }
}

std::vector<std::string> FileFrames::warnings() const {
  std::vector<std::string> lines;
  if (!early_end_.empty()) lines.push_back(early_end_);
  if (times_differ_ > 0)
    lines.push_back(fmt::format("{} ({}; {} PS replaces times)", first_difference_,
                                counted(times_differ_, "frame"), "--dt"_arg));
  if (!cells_differ_.empty()) lines.push_back(cells_differ_);
  add_nearer_images(lines);
  for (const NecklaceStream& file : files_)
    for (std::size_t n = 0; n < file.heads().size(); ++n)
      for (std::string& line : file.warnings(n)) lines.push_back(std::move(line));
  return lines;
}

bool FileFrames::is_truncated() const {
  return std::any_of(files_.begin(), files_.end(),
                     [](const NecklaceStream& file) { return file.is_truncated(); });
}

void FileFrames::add_nearer_images(std::vector<std::string>& lines) const {
  if (files_.size() == 1) return;
  EarlierNecklaces earlier;
  for (std::size_t f = 0; f < files_.size(); ++f) {
    for (const Trajectory& head : files_[f].heads()) {
      const Eigen::Matrix3Xd& chain = head.frames.front();
      // The chains of the first file have been placed next to each other.
      const auto beside = f == 0 ? std::nullopt : earlier.nearer_image(chain, first_cells_[f]);
      if (beside && beside->is_much_nearer())
        lines.push_back(
            fmt::format("{}: has a periodic image much nearer to the necklaces before it ({:.4g} away, not "
                        "{:.4g}), left where it is",
                        head.file, beside->distance, beside->present));
      earlier.add(chain, first_cells_[f]);
    }
  }
}

std::vector<Trajectory> FileFrames::heads() const {
  std::vector<Trajectory> heads;
  for (const NecklaceStream& file : files_)
    heads.insert(heads.end(), file.heads().begin(), file.heads().end());
  return heads;
}

std::vector<std::size_t> FileFrames::frame_counts() const {
  std::vector<std::size_t> counts;
  for (std::size_t f = 0; f < files_.size(); ++f)
    counts.insert(counts.end(), files_[f].heads().size(), all_.at(f));
  return counts;
}

}  // namespace kds
