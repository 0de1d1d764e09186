#pragma once
// Ends a long computation from outside, such as on Ctrl-C in Python. Long computations ask often, on their
// own thread, whether to go on. If the thread's host has set a check, the check answers by throwing.

#include <atomic>
#include <functional>
#include <utility>

namespace kds {

/// Sets the check of this thread while the object lives. Checks set earlier remain in force.
///
/// Once a check has thrown, it must throw at each later call: code that keeps exceptions for later asks again
/// before it goes on. An exception that escapes leaves structures in an unknown state, so their run cannot
/// continue.
class InterruptionCheck {
 public:
  explicit InterruptionCheck(std::function<void()> check)
      : check_(std::move(check)), outer_(std::exchange(present_, this)) {}
  ~InterruptionCheck() { present_ = outer_; }
  InterruptionCheck(const InterruptionCheck&) = delete;
  InterruptionCheck& operator=(const InterruptionCheck&) = delete;

  /// Calls all checks of this thread. Without a check this takes a nanosecond, so loops whose passes take a
  /// microsecond may ask in each pass.
  static void ask() {
    for (const InterruptionCheck* check = present_; check != nullptr; check = check->outer_) check->check_();
  }

 private:
  static thread_local constinit inline InterruptionCheck* present_ = nullptr;

  std::function<void()> check_;
  InterruptionCheck* outer_;
};

namespace live_end {
inline constinit std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);
}  // namespace live_end

/// Asks all readers of running simulations in this process to end. The results of the frames read so far are
/// then written. May be called by a signal handler.
inline void request_live_end() noexcept { live_end::requested = true; }
/// Withdraws the request, before the next simulation is followed.
inline void withdraw_live_end() noexcept { live_end::requested = false; }
[[nodiscard]] inline bool live_end_requested() noexcept { return live_end::requested; }

}  // namespace kds
