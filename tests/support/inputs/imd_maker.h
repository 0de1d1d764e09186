#pragma once
// Bytes that simulations send by the protocol IMD, and simulations on the loopback address that send them.

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "motions/live/byte_source.h"

namespace kds::test {

/// Makes the bytes of a connection. Atom i of frame k is at `coordinate(k, i, axis)`.
struct ImdMaker {
  int version = 2;
  bool big_endian = false;
  std::size_t atoms = 3, frames = 4;
  bool time = true, energies = true, cell = true, velocities = true, forces = true;  ///< of version 3
  std::int64_t steps_between = 10;

  static float coordinate(std::size_t k, std::size_t atom, std::size_t axis) {
    return 3.8F * static_cast<float>(atom) * static_cast<float>(axis == 0) +
           0.0137F * static_cast<float>((k * 7 + atom * 3 + axis) % 11);
  }
  static float velocity(std::size_t k, std::size_t atom, std::size_t axis) {
    return -0.1F * coordinate(k, atom, axis);
  }
  [[nodiscard]] std::int64_t step_of(std::size_t k) const {
    return 100 + steps_between * static_cast<std::int64_t>(k);
  }
  static double time_of(std::size_t k) { return 0.125 + 0.02 * static_cast<double>(k); }

  template <class Number>
  [[nodiscard]] std::string number(Number value) const {
    auto bytes = std::bit_cast<std::array<char, sizeof value>>(value);
    if (big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
    return {bytes.data(), bytes.size()};
  }
  static std::string header(std::int32_t type, std::int32_t length) {
    const ImdMaker big{.big_endian = true};
    return big.number(type) + big.number(length);
  }
  [[nodiscard]] std::string handshake() const {
    std::string bytes = header(4, 0).substr(0, 4) + number(std::int32_t{version});
    if (version < 3) return bytes;
    bytes += header(10, 7);
    for (const bool sent : {time, energies, cell, true, true, velocities, forces})
      bytes += static_cast<char>(sent);
    return bytes;
  }
  [[nodiscard]] std::string frame(std::size_t k) const {
    std::string bytes;
    const auto count = static_cast<std::int32_t>(atoms);
    const auto numbers = [&](std::int32_t type, float (*of)(std::size_t, std::size_t, std::size_t)) {
      bytes += header(type, count);
      for (std::size_t i = 0; i < atoms; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) bytes += number(of(k, i, axis));
    };
    if (version >= 3 && time)
      bytes += header(12, 1) + number(0.002) + number(time_of(k)) + number(step_of(k));
    if (energies)
      bytes += header(1, 1) + number(static_cast<std::int32_t>(step_of(k))) + std::string(36, 'e');
    if (version >= 3 && cell) {
      bytes += header(13, 1);
      for (const float part : {40.F, 0.F, 0.F, 5.F, 41.F, 0.F, 6.F, 7.F, 42.F}) bytes += number(part);
    }
    numbers(2, coordinate);
    if (version >= 3 && velocities) numbers(14, velocity);
    if (version >= 3 && forces) numbers(15, velocity);
    return bytes;
  }
  [[nodiscard]] std::string bytes() const {
    std::string bytes = handshake();
    for (std::size_t k = 0; k < frames; ++k) bytes += frame(k);
    return bytes;
  }
};

/// Bytes in memory, of which each call of `read` gives at most `piece`.
class BytesInMemory final : public ByteSource {
 public:
  explicit BytesInMemory(std::string_view bytes, std::size_t piece = static_cast<std::size_t>(-1))
      : bytes_(bytes), piece_(piece) {}

  std::size_t read(std::span<char> to) override {
    ++calls_;
    most_asked_ = std::max(most_asked_, to.size());
    const std::size_t got = std::min({to.size(), piece_, bytes_.size() - read_});
    std::memcpy(to.data(), bytes_.data() + read_, got);
    read_ += got;
    return got;
  }
  void restart_patience() override {}

  [[nodiscard]] std::size_t bytes_read() const { return read_; }
  [[nodiscard]] std::size_t calls() const { return calls_; }
  [[nodiscard]] std::size_t most_asked() const { return most_asked_; }

 private:
  std::string_view bytes_;
  std::size_t piece_, read_ = 0, calls_ = 0, most_asked_ = 0;
};

/// The simulation's end of a connection.
class ImdPeer {
 public:
  explicit ImdPeer(int socket) : socket_(socket) {}
  ~ImdPeer() { close(); }
  ImdPeer(const ImdPeer&) = delete;
  ImdPeer& operator=(const ImdPeer&) = delete;

  /// Sends all bytes. Returns false if the receiver has gone.
  bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  /// Returns type and length of the next word, nothing if none comes within ten seconds.
  [[nodiscard]] std::optional<std::pair<int, int>> next_word() const {
    std::array<unsigned char, 8> bytes{};
    for (std::size_t size = 0; size < bytes.size();) {
      pollfd waiting{socket_, POLLIN, 0};
      if (poll(&waiting, 1, 10'000) <= 0) return std::nullopt;
      const ssize_t got = recv(socket_, bytes.data() + size, bytes.size() - size, 0);
      if (got <= 0) return std::nullopt;
      size += static_cast<std::size_t>(got);
    }
    const auto number = [&](std::size_t i) {
      return bytes[i] << 24 | bytes[i + 1] << 16 | bytes[i + 2] << 8 | bytes[i + 3];
    };
    return std::pair{number(0), number(4)};
  }
  void close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }
  /// Closes the connection so that the receiver is told of a reset.
  void reset() {
    const linger none{1, 0};
    setsockopt(socket_, SOL_SOCKET, SO_LINGER, &none, sizeof none);
    close();
  }

 private:
  int socket_;
};

/// A simulation that listens on the loopback address at a free port, and acts by its script in a thread when
/// somebody connects. The connection is closed after the script.
class ImdSimulation {
 public:
  /// With `listens` false the port refuses connections until `listen`.
  explicit ImdSimulation(std::function<void(ImdPeer&)> script, bool listens = true)
      : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)), script_(std::move(script)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
        getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      std::abort();
    port_ = ntohs(address.sin_port);
    if (listens) listen();
  }
  /// Sends the bytes; after the handshake it waits for "go". Then waits for a word, as simulations do while
  /// they run on; without `stays` it ends at once.
  explicit ImdSimulation(const ImdMaker& maker, bool stays = false)
      : ImdSimulation([maker, stays](ImdPeer& peer) {
          peer.send(maker.handshake());
          if (!peer.next_word()) return;
          for (std::size_t k = 0; k < maker.frames; ++k) peer.send(maker.frame(k));
          if (stays) static_cast<void>(peer.next_word());
        }) {}
  ~ImdSimulation() { join(); }
  ImdSimulation(const ImdSimulation&) = delete;
  ImdSimulation& operator=(const ImdSimulation&) = delete;

  void listen() {
    if (::listen(socket_, 1) != 0) std::abort();
    thread_ = std::thread([this] {
      pollfd waiting{socket_, POLLIN, 0};
      if (poll(&waiting, 1, 10'000) <= 0) return;
      ImdPeer peer(accept(socket_, nullptr, nullptr));
      script_(peer);
    });
  }
  /// Waits until the script has ended.
  void join() {
    if (thread_.joinable()) thread_.join();
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }
  [[nodiscard]] std::string address() const { return "imd://127.0.0.1:" + std::to_string(port_); }

 private:
  int socket_;
  std::uint16_t port_ = 0;
  std::function<void(ImdPeer&)> script_;
  std::thread thread_;
};

}  // namespace kds::test
