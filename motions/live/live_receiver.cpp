#include "motions/live/live_receiver.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/interruption.h"

namespace kds {

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

LiveReceiver::LiveReceiver(const LiveAddress& address, double patience, std::optional<unsigned> rate,
                           const std::function<void()>& on_wait)
    : connection_(std::make_unique<Connection>(address, patience, on_wait)),
      protocol_(address.text, *connection_) {
  try {
    protocol_.read_handshake();
    connection_->send(imd_header(ImdPacket::go, 0));
    if (rate) connection_->send(imd_header(ImdPacket::rate, static_cast<std::int32_t>(*rate)));
    atom_count_ = protocol_.read_atom_count();
  } catch (...) {
    connection_->part(imd_header(ImdPacket::disconnect, 0));
    throw;
  }
}

void LiveReceiver::receive() {
  std::string why;
  try {
    for (LiveFrame frame; protocol_.next(frame); frame = {}) {
      std::unique_lock lock(mutex_);
      constexpr std::size_t most_bytes = std::size_t{1} << 24U;
      const std::size_t bytes =
          sizeof frame + (frame.positions.capacity() + frame.velocities.capacity()) * sizeof(float);
      capacity_ = std::max<std::size_t>(4, most_bytes / bytes);
      ++state_.received;
      if (!wait_for_room(lock)) break;
      block_.push_back(std::move(frame));
      changed_.notify_all();
    }
  } catch (const InputError& error) {
    why = error.what();
  } catch (const std::exception& error) {
    why = fmt::format("{}: {}", protocol_.name(), error.what());
  }
  const std::lock_guard lock(mutex_);
  left_ = closing_ || live_end_requested();
  if (!left_) broken_ = why;
  ended_ = true;
  changed_.notify_all();
}

bool LiveReceiver::wait_for_room(std::unique_lock<std::mutex>& lock) {
  if (block_.size() >= capacity_) {
    full_since_ = Clock::now();
    changed_.wait(lock, [&] { return closing_ || block_.size() < capacity_; });
    state_.seconds_full += seconds_since(*std::exchange(full_since_, std::nullopt));
  }
  return !closing_;
}

bool LiveReceiver::take(LiveFrame& frame) {
  std::unique_lock lock(mutex_);
  if (!thread_.joinable() && !closing_) thread_ = std::thread([this] { receive(); });
  const auto begin = Clock::now();
  while (block_.empty() && !ended_ && !closing_ && !live_end_requested()) {
    changed_.wait_for(lock, std::chrono::milliseconds(50));
    if (!block_.empty()) break;
    lock.unlock();
    InterruptionCheck::ask();
    lock.lock();
  }
  state_.seconds_waited += seconds_since(begin);
  if (block_.empty() || closing_ || live_end_requested()) return false;
  frame = std::move(block_.front());
  block_.pop_front();
  ++state_.taken;
  changed_.notify_all();
  return true;
}

void LiveReceiver::close() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(closing_, true)) return;
    changed_.notify_all();
  }
  connection_->stop();
  if (thread_.joinable()) thread_.join();
  connection_->part(imd_header(ImdPacket::disconnect, 0));
  connection_.reset();
}

std::string LiveReceiver::broken() const {
  const std::lock_guard lock(mutex_);
  return broken_;
}

bool LiveReceiver::left() const {
  const std::lock_guard lock(mutex_);
  return left_;
}

LiveState LiveReceiver::state() const {
  const std::lock_guard lock(mutex_);
  LiveState state = state_;
  if (full_since_) state.seconds_full += seconds_since(*full_since_);
  return state;
}

}  // namespace kds
