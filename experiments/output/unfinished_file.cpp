#include "experiments/output/unfinished_file.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

namespace kds {

// An entry in the list that the signal handler walks. Entries are never freed, so the handler may walk the
// list at any moment. An entry with a null path is unused.
struct UnfinishedFile::Entry {
  std::atomic<const char*> path{nullptr};
  std::atomic<std::uint64_t> files{0};  ///< number of files in a folder
  Entry* next = nullptr;
};

namespace {

using Entry = UnfinishedFile::Entry;

std::atomic<Entry*> all_entries{nullptr};
static_assert(std::atomic<Entry*>::is_always_lock_free && std::atomic<const char*>::is_always_lock_free);

// Removes the file with this number in the folder. Calls only functions that are safe in a signal handler.
void remove_numbered(const char* folder, std::uint64_t number) {
  constexpr std::size_t longest = 4096, digits = 20;
  const std::size_t length = std::strlen(folder);
  if (length + digits + 2 > longest) return;
  std::array<char, longest> path;
  std::memcpy(path.data(), folder, length);
  char* end = path.data() + longest - 1;
  *end = 0;
  char* begin = end;
  do {
    *--begin = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number > 0);
  path[length] = '/';
  std::memmove(path.data() + length + 1, begin, static_cast<std::size_t>(end - begin) + 1);
  ::unlink(path.data());
}

std::atomic_flag is_clearing = ATOMIC_FLAG_INIT;

extern "C" void remove_unfinished_and_end(int signal) {
  while (is_clearing.test_and_set()) ::pause();  // another thread is clearing and then ends the program
  for (const Entry* entry = all_entries.load(); entry != nullptr; entry = entry->next)
    if (const char* path = entry->path.load()) {
      for (std::uint64_t number = entry->files.load(); number-- > 0;) remove_numbered(path, number);
      ::unlink(path);
    }
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

std::mutex free_entries_mutex;
std::vector<Entry*> free_entries;

Entry* take_entry(const char* path) {
  const std::lock_guard lock(free_entries_mutex);
  if (free_entries.empty()) {
    Entry* const entry = new Entry;
    entry->next = all_entries.load();
    all_entries.store(entry);
    free_entries.push_back(entry);
  }
  Entry* const entry = free_entries.back();
  free_entries.pop_back();
  entry->files.store(0);
  entry->path.store(path);
  return entry;
}

}  // namespace

UnfinishedFile::UnfinishedFile(std::string path) : path_(std::move(path)), entry_(take_entry(path_.c_str())) {
  static std::once_flag once;
  std::call_once(once, handle_signals);
}

void UnfinishedFile::hold_files(std::uint64_t count) { entry_->files.store(count); }

UnfinishedFile::~UnfinishedFile() {
  const std::lock_guard lock(free_entries_mutex);
  entry_->path.store(nullptr);
  free_entries.push_back(entry_);
}

}  // namespace kds
