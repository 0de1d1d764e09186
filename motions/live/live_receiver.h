#pragma once
// Receives the frames of a running simulation on a thread of its own, ahead of the thread that takes them.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "motions/frames/live_state.h"
#include "motions/live/connection.h"
#include "motions/live/imd_protocol.h"

namespace kds {

/// Connects to a simulation, receives its frames, and disconnects. Sends only "go", "rate" if it is set, and
/// "disconnect". If kds is slower than the simulation, received frames wait in a block of 4 frames
/// or 16 MB, whichever is more. When the block is full, the system's buffers fill up too, and then the
/// simulation waits in its next send.
class LiveReceiver {
 public:
  /// Connects, says "go" and reads up to the coordinates of the first frame. With `rate` asks the simulation
  /// to send every `rate`-th step. Throws InputError as Connection and ImdProtocol do.
  LiveReceiver(const LiveAddress& address, double patience, std::optional<unsigned> rate,
               const std::function<void()>& on_wait);
  ~LiveReceiver() { close(); }
  LiveReceiver(const LiveReceiver&) = delete;
  LiveReceiver& operator=(const LiveReceiver&) = delete;

  /// The protocol, for choices before the first `take`.
  [[nodiscard]] ImdProtocol& protocol() { return protocol_; }
  [[nodiscard]] std::size_t atom_count() const { return atom_count_; }
  [[nodiscard]] bool sends_cells() const { return protocol_.sends_cells(); }
  [[nodiscard]] bool sends_times() const { return protocol_.sends_times(); }

  /// Waits for the next frame; the first call starts the thread. Returns false after the last frame, and at
  /// once if the end is requested (`live_end_requested`). Throws only what InterruptionCheck throws.
  [[nodiscard]] bool take(LiveFrame& frame);
  /// Ends the receiving, disconnects and closes the connection. Takes about a second at most.
  void close();
  /// Returns why the connection broke, in one line; empty if it did not before `close`.
  [[nodiscard]] std::string broken() const;
  /// Returns whether the receiving ended before the simulation, by `close` or by a request for the end.
  [[nodiscard]] bool left() const;
  [[nodiscard]] LiveState state() const;

 private:
  using Clock = std::chrono::steady_clock;

  void receive();
  /// Waits until there is room for a frame. Returns false if the receiving was ended.
  [[nodiscard]] bool wait_for_room(std::unique_lock<std::mutex>& lock);

  std::unique_ptr<Connection> connection_;
  ImdProtocol protocol_;
  std::size_t atom_count_ = 0;
  std::thread thread_;

  mutable std::mutex mutex_;  ///< guards all below
  std::condition_variable changed_;
  std::deque<LiveFrame> block_;
  std::size_t capacity_ = 4;  ///< frames
  bool ended_ = false;        ///< no more frames come
  bool closing_ = false;
  bool left_ = false;
  std::string broken_;
  LiveState state_;
  std::optional<Clock::time_point> full_since_;
};

}  // namespace kds
