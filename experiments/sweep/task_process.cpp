#include "experiments/sweep/task_process.h"

#include <fcntl.h>
#include <oneapi/tbb/global_control.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <system_error>
#include <utility>

namespace kds {

namespace {

constexpr std::array kStopSignals{SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU};
constexpr rlim_t kLongestOutput = rlim_t{1} << 30U;

int memory_file() {
  const int file = ::memfd_create("kds-task", MFD_CLOEXEC);
  if (file < 0) throw std::system_error(errno, std::generic_category(), "memory for a task's output");
  return file;
}

std::string content(int file) {
  std::string text;
  const off_t size = ::lseek(file, 0, SEEK_END);
  if (size <= 0) return text;
  text.resize(static_cast<std::size_t>(size));
  std::size_t read = 0;
  while (read < text.size()) {
    const ssize_t count = ::pread(file, text.data() + read, text.size() - read, static_cast<off_t>(read));
    if (count <= 0) break;
    read += static_cast<std::size_t>(count);
  }
  text.resize(read);
  return text;
}

void limit(int resource, rlim_t most) {
  rlimit limits{};
  if (::getrlimit(static_cast<__rlimit_resource_t>(resource), &limits) != 0) return;
  limits.rlim_cur = std::min(most, limits.rlim_max);
  static_cast<void>(::setrlimit(static_cast<__rlimit_resource_t>(resource), &limits));
}

// Limits oneTBB to one thread. The limit is made before the fork, because it loads libraries.
std::optional<oneapi::tbb::global_control>& one_thread() {
  static std::optional<oneapi::tbb::global_control> limit(
      std::in_place, oneapi::tbb::global_control::max_allowed_parallelism, 1);
  return limit;
}

[[noreturn]] void run_child(const std::function<int()>& work, const TaskLimits& limits, pid_t parent, int out,
                            int err) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent ended before the line above
  ignore_stop_signals();                  // the parent ends its children itself
  ::signal(SIGCHLD, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int in = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (in < 0 || ::dup2(in, 0) < 0 || ::dup2(out, 1) < 0 || ::dup2(err, 2) < 0) ::_exit(1);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, kLongestOutput);
  if (limits.memory) limit(RLIMIT_DATA, *limits.memory);
  if (!limits.one_thread) one_thread().reset();
  const int code = work();
  std::fflush(nullptr);
  ::_exit(code);  // no destructors of the parent's objects
}

double seconds_in(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

TaskOutput::TaskOutput() : out_(memory_file()) {
  try {
    err_ = memory_file();
  } catch (const std::system_error&) {
    ::close(out_);
    throw;
  }
}

TaskOutput::~TaskOutput() {
  if (out_ >= 0) ::close(out_);
  if (err_ >= 0) ::close(err_);
}

TaskOutput::TaskOutput(TaskOutput&& other) noexcept
    : out_(std::exchange(other.out_, -1)), err_(std::exchange(other.err_, -1)) {}

TaskOutput& TaskOutput::operator=(TaskOutput&& other) noexcept {
  std::swap(out_, other.out_);
  std::swap(err_, other.err_);
  return *this;
}

std::string TaskOutput::out() const { return content(out_); }
std::string TaskOutput::err() const { return content(err_); }

std::size_t most_tasks_at_once() {
  constexpr rlim_t others = 32;
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return 1;
  return std::max<std::size_t>(files.rlim_cur > others ? (files.rlim_cur - others) / 2 : 1, 1);
}

void ignore_stop_signals() {
  for (const int signal : kStopSignals) ::signal(signal, SIG_IGN);
}

TaskProcess::TaskProcess(const std::function<int()>& work, const TaskLimits& limits, TaskOutput output)
    : output_(std::move(output)) {
  static_cast<void>(one_thread());
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  child_ = ::fork();
  if (child_ == 0) run_child(work, limits, parent, output_.out_file(), output_.err_file());
  if (child_ < 0) throw std::system_error(errno, std::generic_category(), "a process for a task");
}

TaskProcess::TaskProcess(TaskProcess&& other) noexcept
    : child_(std::exchange(other.child_, -1)), output_(std::move(other.output_)), start_(other.start_) {}

TaskProcess::~TaskProcess() {
  if (child_ <= 0) return;
  kill();
  static_cast<void>(wait());
}

void TaskProcess::kill() {
  if (child_ > 0) ::kill(child_, SIGKILL);
}

std::optional<TaskProcess::End> TaskProcess::collect(int options) {
  int status = 0;
  rusage usage{};
  pid_t found = 0;
  do found = ::wait4(child_, &status, options, &usage);
  while (found < 0 && errno == EINTR);
  if (found == 0) return std::nullopt;
  End end;
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  end.processor_seconds = seconds_in(usage.ru_utime) + seconds_in(usage.ru_stime);
  child_ = -1;
  return end;
}

std::optional<TaskProcess::End> TaskProcess::ended() { return collect(WNOHANG); }
TaskProcess::End TaskProcess::wait() { return *collect(0); }

StopSignals::StopSignals() {
  ::sigemptyset(&held_);
  for (const int signal : kStopSignals) ::sigaddset(&held_, signal);
  ::sigaddset(&held_, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &held_, &before_);
}

StopSignals::~StopSignals() {
  wait(0);  // takes signals that are still pending
  ::sigprocmask(SIG_SETMASK, &before_, nullptr);
}

void StopSignals::wait(double seconds) {
  timespec time{};
  time.tv_sec = static_cast<std::time_t>(seconds);
  time.tv_nsec = static_cast<long>((seconds - static_cast<double>(time.tv_sec)) * 1e9);
  for (int signal = 0; (signal = ::sigtimedwait(&held_, nullptr, &time)) != -1 || errno == EINTR;) {
    if (signal > 0 && signal != SIGCHLD) stopped_ = true;
    time = {};
  }
}

}  // namespace kds
