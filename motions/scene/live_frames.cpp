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
  ++open_;
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
    bool has_frame = true;
    if (next_ == 0)
      frame = std::move(first_);
    else
      has_frame = source_->next(frame);
    if (!has_frame) {
      end();
      return false;
    }
    cells_.add(frame);
    if (next_ > 0 && last_.picoseconds && !(frame.stamp.picoseconds > last_.picoseconds))
      throw InputError(fmt::format(
          "{}: frame {} has {}, which is not later than the {} ps of the frame before",
          necklaces().front().file, frame.stamp.number,
          frame.stamp.picoseconds ? fmt::format("the time {} ps", *frame.stamp.picoseconds) : "no time",
          *last_.picoseconds));
    last_ = frame.stamp;
    if (periodic_ && !cells_.is_periodic({})) throw InputError(cells_.why_not());
  } catch (const InputError& error) {
    if (next_ < 2) throw;
    end();
    fault_ = error.what();
    return false;
  }
  ++next_;
  return true;
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
