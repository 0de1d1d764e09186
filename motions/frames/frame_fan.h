#pragma once
// The frames of one source for several runs, each on a thread of its own. A running simulation sends each
// frame once, so runs with different strides read the frames at the same time.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "motions/frames/frame_source.h"

namespace kds {

class FrameFan {
 public:
  /// The most frames that wait for one branch.
  static constexpr std::size_t most_waiting = 4;

  /// The source must outlive the fan.
  explicit FrameFan(FrameSource& source) : source_(source) {}
  FrameFan(const FrameFan&) = delete;
  FrameFan& operator=(const FrameFan&) = delete;
  ~FrameFan() { stop(); }

  /// Returns a source of frames 0, stride, 2 stride, ... The fan must outlive it. All branches must be made
  /// before `pump`. Another thread may read and destroy a branch.
  [[nodiscard]] std::unique_ptr<FrameSource> branch(std::size_t stride);
  /// Reads the source to its end, on this thread, and hands each frame to the branches. Waits while a branch
  /// has not read its frames. Returns the number of frames. If the source throws, the branches end and the
  /// exception is passed on.
  std::size_t pump();
  /// Ends all branches after the frames that wait for them, and `pump` when its source gives the next frame.
  /// May be called on any thread.
  void stop();

 private:
  class Branch;

  FrameSource& source_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Branch*> branches_;
  bool stopped_ = false;
};

}  // namespace kds
