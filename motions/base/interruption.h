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

/// The request to end the input that a running simulation sends, as on Ctrl-C. The frames read until then
/// stay valid. It is a request to the whole process.
class LiveEndRequest {
 public:
  /// May be called by a signal handler.
  static void set(bool requested) noexcept { requested_.store(requested, std::memory_order_relaxed); }
  [[nodiscard]] static bool is_set() noexcept { return requested_.load(std::memory_order_relaxed); }

 private:
  static inline std::atomic<bool> requested_ = false;
  static_assert(std::atomic<bool>::is_always_lock_free);
};

}  // namespace kds
