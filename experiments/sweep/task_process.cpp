#include "experiments/sweep/task_process.h"

#include <fcntl.h>
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

namespace kds {

namespace {

constexpr std::array kStopSignals{SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU};
constexpr rlim_t kLongestOutput = rlim_t{1} << 30U;

[[noreturn]] void fail_to_start() { throw std::system_error(errno, std::generic_category()); }

void limit(int resource, rlim_t most) {
  rlimit limits{};
  if (::getrlimit(static_cast<__rlimit_resource_t>(resource), &limits) != 0) return;
  limits.rlim_cur = std::min(most, limits.rlim_max);
  static_cast<void>(::setrlimit(static_cast<__rlimit_resource_t>(resource), &limits));
}

[[noreturn]] void run_child(const std::function<int()>& work, const TaskLimits& limits, pid_t parent, int out,
                            int err) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);                            // the parent ended before the line above
  for (const int signal : kStopSignals) ::signal(signal, SIG_IGN);  // the parent ends its children itself
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int in = ::open("/dev/null", O_RDONLY);
  if (in < 0 || ::dup2(in, 0) < 0 || ::dup2(out, 1) < 0 || ::dup2(err, 2) < 0) ::_exit(1);
  ::close_range(3, ~0U, 0);  // files of the parent and of other tasks
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, kLongestOutput);
  if (limits.memory) limit(RLIMIT_DATA, *limits.memory);
  const int code = work();
  std::fflush(nullptr);
  ::_exit(code);  // no destructors of the parent's objects
}

double seconds_in(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

MemoryFile::MemoryFile() : file_(::memfd_create("kds-task", MFD_CLOEXEC)) {
  if (file_ < 0) fail_to_start();
}

MemoryFile::~MemoryFile() { ::close(file_); }

std::string MemoryFile::text() const {
  std::string text(static_cast<std::size_t>(std::max<off_t>(::lseek(file_, 0, SEEK_END), 0)), '\0');
  std::size_t read = 0;
  while (read < text.size()) {
    const ssize_t count = ::pread(file_, text.data() + read, text.size() - read, static_cast<off_t>(read));
    if (count <= 0) break;
    read += static_cast<std::size_t>(count);
  }
  text.resize(read);
  return text;
}

TaskProcess::TaskProcess(const std::function<int()>& work, const TaskLimits& limits) {
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  child_ = ::fork();
  if (child_ == 0) run_child(work, limits, parent, out_.descriptor(), err_.descriptor());
  if (child_ < 0) fail_to_start();
}

TaskProcess::~TaskProcess() {
  if (child_ <= 0) return;
  kill();
  static_cast<void>(wait());
}

double TaskProcess::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void TaskProcess::kill() {
  if (child_ > 0) ::kill(child_, SIGKILL);
}

std::optional<TaskProcess::End> TaskProcess::collect(bool at_once) {
  int status = 0;
  rusage usage{};
  pid_t found = 0;
  do found = ::wait4(child_, &status, at_once ? WNOHANG : 0, &usage);
  while (found < 0 && errno == EINTR);
  if (found == 0) return std::nullopt;
  child_ = -1;
  return End{WIFEXITED(status) ? WEXITSTATUS(status) : 1, WIFSIGNALED(status) ? WTERMSIG(status) : 0,
             seconds(), seconds_in(usage.ru_utime) + seconds_in(usage.ru_stime)};
}

StopSignals::StopSignals() {
  ::sigemptyset(&held_);
  for (const int signal : kStopSignals) ::sigaddset(&held_, signal);
  ::sigaddset(&held_, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &held_, &before_);
}

StopSignals::~StopSignals() {
  wait(0);  // takes signals that are still pending
  if (stopped_) return;
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
