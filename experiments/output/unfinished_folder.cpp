#include "experiments/output/unfinished_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <mutex>
#include <system_error>
#include <utility>

namespace kds {

// Entries are never freed, so the signal handler may walk the list at any moment. An entry with a null path
// is unused.
struct UnfinishedFolder::Entry {
  std::atomic<const char*> path{nullptr};
  std::atomic<std::uint64_t> files{0};
  Entry* next = nullptr;
};

namespace {

using Entry = UnfinishedFolder::Entry;

std::atomic<Entry*> all_entries{nullptr};
static_assert(std::atomic<Entry*>::is_always_lock_free && std::atomic<const char*>::is_always_lock_free);

// Removes the files 0, 1, ... in the folder. Calls only functions that are safe in a signal handler.
void remove_files(const Entry& entry, const char* folder) {
  constexpr std::size_t longest = 4096, digits = 20;
  const std::size_t length = std::strlen(folder);
  if (length > longest) return;
  std::array<char, longest + digits + 2> path;
  std::memcpy(path.data(), folder, length);
  path[length] = '/';
  for (std::uint64_t number = entry.files.load(); number-- > 0;) {
    *std::to_chars(path.data() + length + 1, path.data() + path.size() - 1, number).ptr = 0;
    ::unlink(path.data());
  }
}

std::atomic_flag is_clearing = ATOMIC_FLAG_INIT;

extern "C" void remove_unfinished_and_end(int signal) {
  while (is_clearing.test_and_set()) ::pause();  // another thread is clearing and then ends the program
  for (const Entry* entry = all_entries.load(); entry != nullptr; entry = entry->next)
    if (const char* path = entry->path.load()) remove_files(*entry, path);
  for (bool removed = true; removed;) {  // a folder can be removed once its subfolders are gone
    removed = false;
    for (const Entry* entry = all_entries.load(); entry != nullptr; entry = entry->next) {
      const char* path = entry->path.load();
      if (path != nullptr && ::rmdir(path) == 0) removed = true;
    }
  }
  // The signal's default action follows when this handler returns. The handler stays installed until
  // everything is removed: with SA_RESETHAND, a second signal of that kind could end the program too early.
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  ::sigaction(signal, &action, nullptr);
  ::raise(signal);
}

// Returns whether the signal cannot be caught, only stops or continues the program, or is ignored by default.
bool spares_the_program(int signal) {
  constexpr std::array others{SIGKILL, SIGSTOP, SIGTSTP, SIGTTIN, SIGTTOU,
                              SIGCONT, SIGCHLD, SIGURG,  SIGWINCH};
  return std::find(others.begin(), others.end(), signal) != others.end();
}

void handle_signals() {
  // The handler has its own stack, since the program's stack may be exhausted.
  static std::array<char, std::size_t{1} << 16U> stack;
  stack_t other{};
  other.ss_sp = stack.data();
  other.ss_size = stack.size();
  ::sigaltstack(&other, nullptr);
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    if (spares_the_program(signal)) continue;
    struct sigaction action {};
    // A signal that is already handled or ignored (as under nohup) stays so.
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
    action.sa_handler = remove_unfinished_and_end;
    action.sa_flags = SA_ONSTACK;
    ::sigfillset(&action.sa_mask);  // other signals wait until everything is removed
    ::sigaction(signal, &action, nullptr);
  }
}

Entry* take_entry(const char* path) {
  for (Entry* entry = all_entries.load(); entry != nullptr; entry = entry->next) {
    const char* unused = nullptr;
    if (entry->path.compare_exchange_strong(unused, path)) return entry;
  }
  Entry* const entry = new Entry;
  entry->path.store(path);
  entry->next = all_entries.load();
  while (!all_entries.compare_exchange_weak(entry->next, entry)) {
  }
  return entry;
}

}  // namespace

UnfinishedFolder::UnfinishedFolder(std::string path, unsigned permissions)
    : path_(std::move(path)), entry_(take_entry(path_.c_str())) {
  static std::once_flag once;
  std::call_once(once, handle_signals);
  if (::mkdir(path_.c_str(), permissions) == 0) return;
  const int error = errno;
  release();
  throw std::system_error(error, std::generic_category());
}

std::string UnfinishedFolder::add_file() {
  entry_->files.store(++files_);
  return file(files_ - 1);
}

void UnfinishedFolder::release() {
  entry_->files.store(0);
  entry_->path.store(nullptr);
}

// Removes files by name: to list a folder takes a descriptor, and none may be left.
UnfinishedFolder::~UnfinishedFolder() {
  remove_files(*entry_, path_.c_str());
  ::rmdir(path_.c_str());
  release();
}

}  // namespace kds
