#include "motions/live/connection.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/interruption.h"

namespace kds {

namespace {

using Time = std::chrono::steady_clock::time_point;
constexpr std::chrono::milliseconds longest_sleep(50);

Time seconds_from_now(double seconds) {
  using Clock = std::chrono::steady_clock;
  constexpr double most = 1e9;  // thirty years; the clock counts nanoseconds
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(std::clamp(seconds, 0.0, most)));
}

enum class Waited { ready, too_long, ended };

// Waits until the socket is ready, the deadline has come, or an end is requested.
Waited wait_until_ready(int socket, short events, Time deadline, const std::atomic<bool>* stopped) {
  for (;;) {
    pollfd waiting{socket, events, 0};
    InterruptionCheck::ask();
    if (live_end_requested() || (stopped != nullptr && *stopped)) return Waited::ended;
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    const auto sleep = std::clamp(left, std::chrono::milliseconds(0), longest_sleep);
    if (poll(&waiting, 1, static_cast<int>(sleep.count())) > 0) return Waited::ready;
    if (std::chrono::steady_clock::now() >= deadline) return Waited::too_long;
  }
}

// Whether a socket is connected to itself. The system may choose the port it connects to as its own.
bool is_own_peer(int socket) {
  sockaddr_storage own{}, peer{};
  socklen_t own_size = sizeof own, peer_size = sizeof peer;
  return getsockname(socket, reinterpret_cast<sockaddr*>(&own), &own_size) == 0 &&
         getpeername(socket, reinterpret_cast<sockaddr*>(&peer), &peer_size) == 0 && own_size == peer_size &&
         std::memcmp(&own, &peer, own_size) == 0;
}

// Returns a connected socket, or -1 and the error.
int connect_once(const addrinfo& to, Time deadline, int& error) {
  const int socket = ::socket(to.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  error = errno;
  if (socket < 0) return -1;
  error = connect(socket, to.ai_addr, to.ai_addrlen) == 0 ? 0 : errno;
  if (error == EINPROGRESS || error == EINTR) {
    Waited waited = Waited::ended;
    try {
      waited = wait_until_ready(socket, POLLOUT, deadline, nullptr);
    } catch (...) {  // of InterruptionCheck
      close(socket);
      throw;
    }
    socklen_t size = sizeof error;
    if (waited != Waited::ready)
      error = ETIMEDOUT;
    else
      getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
  }
  if (error == 0 && is_own_peer(socket)) error = ECONNREFUSED;
  if (error == 0) return socket;
  close(socket);
  return -1;
}

int connect_to(const LiveAddress& address, double patience, const std::function<void()>& on_wait) {
  const Time deadline = seconds_from_now(patience);
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICSERV;
  if (const int error = getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found); error != 0)
    throw InputError(
        fmt::format("{}: cannot find the host {}: {}", address.text, address.host, gai_strerror(error)));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> hosts(found, freeaddrinfo);
  for (std::size_t tries = 1;; ++tries) {
    int error = 0;
    bool is_refused = false;
    for (const addrinfo* host = hosts.get(); host != nullptr; host = host->ai_next) {
      const Time soon = std::min(deadline, seconds_from_now(2));  // another address may answer
      if (const int socket = connect_once(*host, soon, error); socket >= 0) return socket;
      is_refused = is_refused || error == ECONNREFUSED;
    }
    if (!is_refused && error != ETIMEDOUT)
      throw InputError(
          fmt::format("{}: cannot connect: {}", address.text, std::system_category().message(error)));
    if (tries == 1 && on_wait) on_wait();
    const Time next_try = std::min(deadline, seconds_from_now(0.1));
    while (std::chrono::steady_clock::now() < next_try) {
      InterruptionCheck::ask();
      if (live_end_requested())
        throw InputError(fmt::format("{}: ended before a simulation listened", address.text));
      std::this_thread::sleep_for(longest_sleep);
    }
    if (std::chrono::steady_clock::now() >= deadline)
      throw InputError(fmt::format("{}: no simulation listens there, waited {} s ({} S waits longer)",
                                   address.text, patience, "--patience"_arg));
  }
}

}  // namespace

Connection::Connection(const LiveAddress& address, double patience, const std::function<void()>& on_wait)
    : Connection(connect_to(address, patience, on_wait), patience) {}

Connection::Connection(int socket, double patience)
    : socket_(socket), patience_(patience), deadline_(seconds_from_now(patience)) {
  fcntl(socket_, F_SETFL, fcntl(socket_, F_GETFL) | O_NONBLOCK);
}

Connection::~Connection() { close(socket_); }

void Connection::restart_patience() { deadline_ = seconds_from_now(patience_); }

std::size_t Connection::read(std::span<char> to) {
  for (;;) {
    // Checks the deadline also while bytes arrive without a pause.
    if (stopped_ || live_end_requested()) throw BrokenConnection("ended on request");
    if (Clock::now() < deadline_) {
      const ssize_t got = recv(socket_, to.data(), to.size(), 0);
      if (got == 0 && send_error_ != 0)  // the error was told when a word was sent, and is gone
        throw BrokenConnection("the connection is broken: " + std::system_category().message(send_error_));
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno == EINTR) continue;
      if (errno != EAGAIN && errno != EWOULDBLOCK)
        throw BrokenConnection("the connection is broken: " + std::system_category().message(errno));
    }
    const Waited waited = wait_until_ready(socket_, POLLIN, deadline_, &stopped_);
    if (waited == Waited::too_long || Clock::now() >= deadline_)
      throw BrokenConnection(
          fmt::format("the simulation is silent or too slow, waited {} s ({} S waits longer)", patience_,
                      "--patience"_arg));
  }
}

void Connection::send(const std::array<char, 8>& word) {
  // A socket that has no room for eight bytes belongs to a simulation that reads nothing.
  while (::send(socket_, word.data(), word.size(), MSG_NOSIGNAL) < 0) {
    if (errno == EINTR) continue;
    if (errno != EAGAIN && errno != EWOULDBLOCK) send_error_ = errno;
    return;
  }
}

void Connection::part(const std::array<char, 8>& word) {
  send(word);
  const Time deadline = seconds_from_now(1);
  std::array<char, 1U << 16U> dropped;
  while (Clock::now() < deadline) {
    pollfd waiting{socket_, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(longest_sleep.count())) <= 0) continue;
    const ssize_t got = recv(socket_, dropped.data(), dropped.size(), 0);
    if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN)) return;
  }
}

}  // namespace kds
