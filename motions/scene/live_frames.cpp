#include "motions/scene/live_frames.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "motions/base/floating_point_scope.h"
#include "motions/base/input_error.h"

namespace kds {

LiveFrames::LiveFrames(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {
  if (!source_->is_open()) throw std::logic_error("live frames of a source that has all its frames");
  if (!source_->next(first_))
    throw InputError(fmt::format("{}: has ended before its first frame", necklaces().front().file));
  periodic_ = first_.cell.has_value();
}

FrameSurvey LiveFrames::survey() const {
  FrameSurvey survey;
  survey.first = survey.last = first_.stamp;
  survey.first_positions = first_.positions;
  survey.periodic = periodic_;
  survey.velocities = first_.velocities.cols() > 0 && first_.stamp.picoseconds.has_value();
  return survey;
}

bool LiveFrames::next(FrameRead& frame) {
  if (ended_) return false;
  const FloatingPointScope to_nearest;
  try {
    if (next_ == 0) {
      frame = std::move(first_);
    } else if (!source_->next(frame)) {
      ended_ = true;
      return false;
    }
    check(frame);
  } catch (const InputError& error) {
    close();
    if (next_ < 2) throw;
    ended_ = true;
    fault_ = error.what();
    return false;
  }
  ++next_;
  return true;
}

void LiveFrames::check(const FrameRead& frame) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: frame {}: {}", necklaces().front().file, frame.stamp.number, what));
  };
  if (last_.picoseconds && !(frame.stamp.picoseconds > last_.picoseconds))
    refuse(fmt::format(
        "{}, expected one later than the {} ps of the frame before",
        frame.stamp.picoseconds ? fmt::format("has the time {} ps", *frame.stamp.picoseconds) : "has no time",
        *last_.picoseconds));
  last_ = frame.stamp;
  if (!periodic_) return;
  cells_.add(frame);
  if (!cells_.is_periodic({}))
    refuse(frame.cell ? "other vectors of its cell are periodic than before"
                      : "has no cell, unlike the frames before");
}

void LiveFrames::seek(std::size_t k) {
  if (k != next_)
    throw InputError(
        fmt::format("{}: gives each frame once, and frame {} has passed; expected a file, which "
                    "can be read again",
                    necklaces().front().file, k));
}

std::vector<std::string> LiveFrames::warnings() const {
  std::vector<std::string> lines = source_->warnings();
  if (periodic_)
    for (std::string& line : cells_.guesses(necklaces())) lines.push_back(std::move(line));
  if (!fault_.empty()) lines.push_back(fmt::format("{}; the run ends with the frame before", fault_));
  return lines;
}

}  // namespace kds
