#pragma once
// Bytes that arrive from a simulation, in pieces of any size.

#include <cstddef>
#include <span>
#include <stdexcept>

namespace kds {

/// The bytes do not come as they must: the connection was reset, or the peer is silent. The message is part
/// of a line and names neither address nor frame.
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
  /// Begins the time in which all bytes read from now on must come.
  virtual void restart_patience() = 0;
};

}  // namespace kds
