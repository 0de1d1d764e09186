#pragma once
// A TCP connection to a running simulation.

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <span>

#include "motions/live/byte_source.h"
#include "motions/live/live_address.h"

namespace kds {

/// One thread calls `read`; any thread may call `stop`. Waiting threads ask InterruptionCheck and
/// `live_end_requested` twenty times a second. The socket is closed on exec, and no signal is raised if the
/// simulation has gone.
class Connection final : public ByteSource {
 public:
  /// Connects within `patience` seconds. A simulation that does not listen yet is tried again ten times a
  /// second; before the second try `on_wait` is called, unless it is empty. Throws InputError in one line
  /// that names the address, at once if the host has no address. The system's own limit bounds the look-up of
  /// a name.
  Connection(const LiveAddress& address, double patience, const std::function<void()>& on_wait);
  /// Takes over a connected stream socket, for tests.
  Connection(int socket, double patience);
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Throws BrokenConnection also if the bytes have not come `patience` seconds after `restart_patience`, or
  /// after `stop` or a request for the end.
  [[nodiscard]] std::size_t read(std::span<char> to) override;
  void restart_patience() override;
  /// Makes all calls of `read` throw, also one that waits.
  void stop() { stopped_ = true; }
  /// Sends a word, unless the peer has gone.
  void send(const std::array<char, 8>& word);
  /// Sends a word, and reads and drops what comes until the peer closes the connection, for a second at most.
  /// A connection that is closed with bytes unread is reset, and a simulation that writes to it may be ended
  /// by a signal.
  void part(const std::array<char, 8>& word);

 private:
  using Clock = std::chrono::steady_clock;

  int socket_;
  double patience_;
  Clock::time_point deadline_;
  std::atomic<bool> stopped_ = false;
  int send_error_ = 0;  // errno of a word that could not be sent
};

}  // namespace kds
