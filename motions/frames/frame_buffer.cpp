#include "motions/frames/frame_buffer.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "motions/base/interruption.h"

namespace kds {

bool FrameBuffer::next(FrameRead& frame) {
  if (next_ >= first_kept_ && next_ - first_kept_ < kept_.size()) {
    const auto& kept = kept_[next_ - first_kept_];
    if (kept == nullptr) return false;
    frame = *kept;
    ++next_;
    return true;
  }
  if (source_next_ != next_) {
    source_->seek(next_);
    source_next_ = next_;
  }
  if (!source_->next(frame)) return false;
  ++next_;
  ++source_next_;
  return true;
}

void FrameBuffer::seek(std::size_t k) { next_ = k; }

SharedFrames FrameBuffer::read_ahead(std::size_t first, std::size_t last) {
  if (first < first_kept_ || (kept_.empty() && !error_)) {  // another pass over the frames
    kept_.clear();
    error_ = {};
    first_kept_ = first;
  }
  while (!error_ && first_kept_ + kept_.size() <= last) {
    const std::size_t k = first_kept_ + kept_.size();
    try {
      if (source_next_ != k) source_->seek(k);
      source_next_ = k;
      auto frame = std::make_shared<FrameRead>();
      const bool there = source_->next(*frame);
      source_next_ = k + 1;
      kept_.push_back(there ? std::move(frame) : nullptr);
    } catch (...) {
      InterruptionCheck::ask();  // an interruption is no error of a frame
      error_ = std::current_exception();
    }
  }
  SharedFrames range{first, {}, {}};
  for (std::size_t k = first; k <= last && k < first_kept_ + kept_.size(); ++k)
    range.frames.push_back(kept_[k - first_kept_]);
  if (range.frames.size() < last - first + 1) range.error = error_;
  return range;
}

void FrameBuffer::release(std::size_t below) {
  while (!kept_.empty() && first_kept_ < below) {
    kept_.pop_front();
    ++first_kept_;
  }
}

void FrameRanges::add(const SharedFrames& range) {
  if (held_.frames.empty()) {
    held_ = range;
    return;
  }
  const std::size_t end = held_.first + held_.frames.size();
  if (range.first > end) throw std::logic_error("frames are missing between two ranges");
  for (std::size_t k = end - range.first; k < range.frames.size(); ++k)
    held_.frames.push_back(range.frames[k]);
  held_.error = range.error;
}

void FrameRanges::release(std::size_t below) {
  const std::size_t count = std::min(below - std::min(below, held_.first), held_.frames.size());
  held_.frames.erase(held_.frames.begin(), held_.frames.begin() + static_cast<std::ptrdiff_t>(count));
  held_.first += count;
}

bool FrameRanges::next(FrameRead& frame) {
  if (next_ < held_.first) throw std::logic_error("a frame before those of the part is asked for");
  if (next_ - held_.first >= held_.frames.size()) {
    if (held_.error) std::rethrow_exception(held_.error);
    return false;
  }
  const auto& held = held_.frames[next_ - held_.first];
  if (held == nullptr) return false;
  frame = *held;
  ++next_;
  return true;
}

}  // namespace kds
