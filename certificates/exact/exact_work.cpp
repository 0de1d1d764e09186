#include "certificates/exact/exact_work.h"

#include <algorithm>
#include <utility>

#include "certificates/exact/recent_functions.h"
#include "motions/base/interruption.h"

namespace kds {

namespace {

constexpr std::uint64_t a_millisecond = 1U << 20U;  // limb operations that take about a millisecond

}  // namespace

ExactWork::ExactWork() : recent_(std::make_unique<RecentFunctions>()) { set_next_stop(); }
ExactWork::~ExactWork() = default;

ExactWork& ExactWork::current() {
  if (current_ != nullptr) [[likely]]
    return *current_;
  thread_local ExactWork unlimited;
  return unlimited;
}

void ExactWork::set_limit(std::uint64_t most) {
  limit_ = most;
  set_next_stop();
}

void ExactWork::set_watcher(std::function<void()> watcher, std::uint64_t every) {
  watcher_ = std::move(watcher);
  watch_every_ = every;
  next_watch_ = done_ + every;
  set_next_stop();
}

std::optional<Identity> ExactWork::subject() const {
  return subject_.of == nullptr ? std::nullopt : std::optional(subject_.identity(subject_.of));
}

void ExactWork::stop() {
  if (done_ > limit_) throw WorkLimitReached(subject());
  InterruptionCheck::ask();
  if (done_ >= next_watch_) {
    next_watch_ = done_ + watch_every_;
    watcher_();
  }
  set_next_stop();
}

void ExactWork::set_next_stop() {
  next_stop_ = std::min({done_ + a_millisecond, next_watch_, limit_ == no_limit ? no_limit : limit_ + 1});
}

}  // namespace kds
