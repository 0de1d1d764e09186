#include "experiments/program/unfinished_file.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <mutex>
#include <utility>

namespace kds {
namespace {

// All that a signal handler may look at. A run writes one log and one other file at a time.
constexpr std::size_t kSlots = 16;
std::array<std::atomic<const char*>, kSlots> unfinished{};
static_assert(std::atomic<const char*>::is_always_lock_free);

extern "C" void remove_unfinished_and_end(int signal) {
  for (const auto& slot : unfinished)
    if (const char* path = slot.load()) ::unlink(path);
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

std::size_t take_slot(const char* path) {
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    const char* nobody = nullptr;
    if (unfinished[slot].compare_exchange_strong(nobody, path)) return slot;
  }
  return kSlots;  // all taken: this one would stay behind
}

}  // namespace

UnfinishedFile::UnfinishedFile(std::string path) : path_(std::move(path)), slot_(take_slot(path_.c_str())) {
  static std::once_flag once;
  std::call_once(once, handle_signals);
}

UnfinishedFile::~UnfinishedFile() {
  if (slot_ < kSlots) unfinished[slot_].store(nullptr);
}

}  // namespace kds
