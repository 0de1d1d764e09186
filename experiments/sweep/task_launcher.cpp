#include "experiments/sweep/task_launcher.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <system_error>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/sweep/swept_command.h"

namespace kds {

namespace {

// A request is a Request and, to start a task, its arguments, each ended by a zero; two descriptors come with
// it.
struct Request {
  std::uint64_t id = 0, memory = 0;  ///< memory 0: no limit
  bool starts = false, one_thread = false;
};

constexpr std::size_t kLongestRequest = std::size_t{1} << 20U;

[[noreturn]] void fail_to_launch() {
  throw OutputError("the process that starts tasks has ended; the same command continues");
}

struct Received {
  Request request;
  Arguments arguments;
  TaskOutput output{-1, -1};
};

// Returns false at the end of the connection.
bool receive(int socket, Received& received) {
  static std::vector<char> bytes(kLongestRequest);
  iovec data{bytes.data(), bytes.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(2 * sizeof(int))> control{};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t size = ::recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
  if (size < static_cast<ssize_t>(sizeof(Request))) return false;
  std::memcpy(&received.request, bytes.data(), sizeof(Request));
  for (const char* at = bytes.data() + sizeof(Request); at < bytes.data() + size; at += std::strlen(at) + 1)
    received.arguments.emplace_back(at);
  if (const cmsghdr* const header = CMSG_FIRSTHDR(&message); header != nullptr) {
    std::array<int, 2> files{};
    std::memcpy(files.data(), CMSG_DATA(header), sizeof files);
    received.output = TaskOutput(files[0], files[1]);
  }
  return true;
}

void report(int socket, const TaskLauncher::Ended& ended) {
  static_cast<void>(::send(socket, &ended, sizeof ended, MSG_NOSIGNAL));
}

void start_task(int socket, Received& received, std::map<std::uint64_t, TaskProcess>& tasks) {
  TaskLimits limits;
  if (received.request.memory > 0) limits.memory = received.request.memory;
  limits.one_thread = received.request.one_thread;
  try {
    tasks.emplace(received.request.id, TaskProcess([&] { return run_arguments(received.arguments); }, limits,
                                                   std::move(received.output)));
  } catch (const std::system_error& error) {
    report(socket, {received.request.id, {}, error.code().value()});
    ::kill(::getppid(), SIGCHLD);
  }
}

void nothing(int) {}

[[noreturn]] void serve(int socket, pid_t sweep) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != sweep) ::_exit(1);
  ignore_stop_signals();
  struct sigaction wakes {};
  wakes.sa_handler = nothing;
  ::sigaction(SIGCHLD, &wakes, nullptr);
  sigset_t child, none;
  ::sigemptyset(&none);
  ::sigemptyset(&child);
  ::sigaddset(&child, SIGCHLD);
  ::sigprocmask(SIG_SETMASK, &child, nullptr);
  static_cast<void>(swept_commands());  // option lists are made once, not by each task
  std::map<std::uint64_t, TaskProcess> tasks;
  while (true) {
    pollfd requests{socket, POLLIN, 0};
    const bool requested = ::ppoll(&requests, 1, nullptr, &none) > 0;  // or a child ended
    if (requested) {
      Received received;
      if (!receive(socket, received)) break;
      const auto task = tasks.find(received.request.id);
      if (received.request.starts)
        start_task(socket, received, tasks);
      else if (task != tasks.end())
        task->second.kill();
    }
    bool any = false;
    for (auto task = tasks.begin(); task != tasks.end();) {
      const auto end = task->second.ended();
      if (!end) {
        ++task;
        continue;
      }
      report(socket, {task->first, *end, 0});
      task = tasks.erase(task);
      any = true;
    }
    if (any) ::kill(sweep, SIGCHLD);
  }
  tasks.clear();  // ends them
  ::_exit(0);
}

}  // namespace

TaskLauncher::TaskLauncher() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::system_error(errno, std::generic_category(), "a socket for tasks");
  const int room = static_cast<int>(kLongestRequest);
  static_cast<void>(::setsockopt(ends[0], SOL_SOCKET, SO_SNDBUF, &room, sizeof room));
  std::fflush(nullptr);
  const pid_t sweep = ::getpid();
  launcher_ = ::fork();
  if (launcher_ == 0) {
    ::close(ends[0]);
    serve(ends[1], sweep);
  }
  ::close(ends[1]);
  socket_ = ends[0];
  if (launcher_ < 0) {
    const int error = errno;
    ::close(socket_);
    throw std::system_error(error, std::generic_category(), "a process for tasks");
  }
}

TaskLauncher::~TaskLauncher() {
  ::close(socket_);
  while (::waitpid(launcher_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void TaskLauncher::send(std::uint64_t id, const TaskLimits& limits, const Arguments* arguments,
                        const TaskOutput* output) {
  const Request request{id, limits.memory.value_or(0), arguments != nullptr, limits.one_thread};
  std::string bytes(reinterpret_cast<const char*>(&request), sizeof request);
  if (arguments != nullptr)
    for (const std::string& argument : *arguments) bytes.append(argument.c_str(), argument.size() + 1);
  iovec data{bytes.data(), bytes.size()};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(2 * sizeof(int))> control{};
  if (output != nullptr) {
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    cmsghdr* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(2 * sizeof(int));
    const std::array<int, 2> files{output->out_file(), output->err_file()};
    std::memcpy(CMSG_DATA(header), files.data(), sizeof files);
  }
  ssize_t sent = 0;
  do sent = ::sendmsg(socket_, &message, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  if (sent < 0 && errno == EMSGSIZE) throw OutputError("the arguments of a task are too long to be sent");
  if (sent < 0) fail_to_launch();
}

void TaskLauncher::start(std::uint64_t id, const Arguments& arguments, const TaskLimits& limits,
                         const TaskOutput& output) {
  send(id, limits, &arguments, &output);
}

void TaskLauncher::kill(std::uint64_t id) { send(id, {}, nullptr, nullptr); }

std::vector<TaskLauncher::Ended> TaskLauncher::ended() {
  std::vector<Ended> all;
  while (true) {
    Ended ended;
    const ssize_t size = ::recv(socket_, &ended, sizeof ended, MSG_DONTWAIT);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && errno == EAGAIN) return all;
    if (size != sizeof ended) fail_to_launch();
    all.push_back(ended);
  }
}

}  // namespace kds
