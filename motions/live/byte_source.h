#pragma once
// Bytes that arrive from a simulation, in pieces of any size.

#include <cstddef>
#include <span>
#include <stdexcept>

namespace kds {

/// The connection was reset, or the simulation is silent. The message is part of a line and names neither
/// address nor frame.
class BrokenConnection : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Waits for bytes and takes at least one and at most `to.size()`. Returns their number; 0 if the peer has
  /// closed the connection in order. Throws BrokenConnection.
  [[nodiscard]] virtual std::size_t read(std::span<char> to) = 0;
  /// Restarts the time limit for the bytes still to be read.
  virtual void restart_patience() = 0;
};

}  // namespace kds
