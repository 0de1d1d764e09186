#include "motions/frames/frame_fan.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "motions/base/interruption.h"

namespace kds {

class FrameFan::Branch final : public FrameSource {
 public:
  Branch(FrameFan& fan, std::size_t stride) : fan_(fan), stride_(stride) {
    const std::lock_guard lock(fan_.mutex_);
    fan_.branches_.push_back(this);
  }
  ~Branch() override {
    const std::lock_guard lock(fan_.mutex_);
    std::erase(fan_.branches_, this);
    fan_.changed_.notify_all();
  }

  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override {
    return fan_.source_.necklaces();
  }
  [[nodiscard]] bool next(FrameRead& frame) override {
    std::shared_ptr<const FrameRead> next;
    {
      std::unique_lock lock(fan_.mutex_);
      fan_.changed_.wait(lock, [&] { return !waiting_.empty() || fan_.stopped_; });
      if (waiting_.empty()) {
        ended_ = true;
        return false;
      }
      next = std::move(waiting_.front());
      waiting_.pop_front();
      fan_.changed_.notify_all();
    }
    frame = *next;
    return true;
  }
  void seek(std::size_t /*k*/) override { throw std::logic_error("a branch of a fan gives each frame once"); }
  [[nodiscard]] bool is_open() const override { return !ended_; }

  // These functions need the fan's mutex.
  [[nodiscard]] bool lacks_room(std::size_t number) const {
    return number % stride_ == 0 && waiting_.size() >= most_waiting;
  }
  void offer(std::size_t number, const std::shared_ptr<const FrameRead>& frame) {
    if (number % stride_ == 0) waiting_.push_back(frame);
  }

 private:
  FrameFan& fan_;
  std::size_t stride_;
  std::deque<std::shared_ptr<const FrameRead>> waiting_;
  bool ended_ = false;
};

std::unique_ptr<FrameSource> FrameFan::branch(std::size_t stride) {
  return std::make_unique<Branch>(*this, stride);
}

std::size_t FrameFan::pump() try {
  std::size_t number = 0;
  for (;; ++number) {
    const auto frame = std::make_shared<FrameRead>();
    if (!source_.next(*frame)) break;
    std::unique_lock lock(mutex_);
    const auto may_go_on = [&] {
      return stopped_ || std::ranges::none_of(branches_, [number](const Branch* branch) {
               return branch->lacks_room(number);
             });
    };
    while (!changed_.wait_for(lock, std::chrono::milliseconds(100), may_go_on)) {
      lock.unlock();
      InterruptionCheck::ask();
      lock.lock();
    }
    if (stopped_ || branches_.empty()) break;
    for (Branch* const branch : branches_) branch->offer(number, frame);
    changed_.notify_all();
  }
  stop();
  return number;
} catch (...) {
  stop();
  throw;
}

void FrameFan::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

}  // namespace kds
