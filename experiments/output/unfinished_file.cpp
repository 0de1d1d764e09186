#include "experiments/output/unfinished_file.h"

#include <unistd.h>

#include <csignal>
#include <mutex>
#include <utility>
#include <vector>

namespace kds {

// Entries are never freed, so that the handler may walk the list at any moment; a null path is nobody's.
struct UnfinishedFile::Entry {
  std::atomic<const char*> path{nullptr};
  Entry* next = nullptr;
};

namespace {

using Entry = UnfinishedFile::Entry;

std::atomic<Entry*> all_entries{nullptr};
static_assert(std::atomic<Entry*>::is_always_lock_free && std::atomic<const char*>::is_always_lock_free);

extern "C" void remove_unfinished_and_end(int signal) {
  for (const Entry* entry = all_entries.load(); entry != nullptr; entry = entry->next)
    if (const char* path = entry->path.load()) ::unlink(path);
  for (bool removed = true; removed;) {  // a folder is empty once the folders in it are gone
    removed = false;
    for (const Entry* entry = all_entries.load(); entry != nullptr; entry = entry->next) {
      const char* path = entry->path.load();
      if (path != nullptr && ::rmdir(path) == 0) removed = true;
    }
  }
  ::raise(signal);  // its default action, restored by SA_RESETHAND
}

void handle_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;  // as of nohup
    action.sa_handler = remove_unfinished_and_end;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
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
  entry->path.store(path);
  return entry;
}

}  // namespace

UnfinishedFile::UnfinishedFile(std::string path) : path_(std::move(path)), entry_(take_entry(path_.c_str())) {
  static std::once_flag once;
  std::call_once(once, handle_signals);
}

UnfinishedFile::~UnfinishedFile() {
  const std::lock_guard lock(free_entries_mutex);
  entry_->path.store(nullptr);
  free_entries.push_back(entry_);
}

}  // namespace kds
