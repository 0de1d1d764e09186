#include "experiments/run/watch_exact_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "experiments/output/text.h"

namespace kds {

namespace {

class WorkWatcher {
 public:
  WorkWatcher(Simulator& simulator, const Scene& scene, std::function<void(const std::string&)> warn,
              std::uint64_t extraordinary)
      : simulator_(simulator), scene_(scene), warn_(std::move(warn)), extraordinary_(extraordinary) {}

  void operator()() {
    ExactWork& work = simulator_.exact_work();
    if (simulator_.moment() != moment_) {
      moment_ = simulator_.moment();
      before_ = work.done();
    }
    if (work.done() - before_ < extraordinary_ || work.done() < next_) return;
    next_ = 2 * work.done();
    const std::size_t step = std::min(simulator_.step(), scene_.step_count() - 1);
    warn_(fmt::format(
        "step {} (from frame {} to frame {}) has taken {} limb operations of exact arithmetic "
        "at one time near u = {}, now on {}; --work LIMIT ends a run that takes too many",
        step, scene_.frame_number(step), scene_.frame_number(step + 1), with_thousands(work.done() - before_),
        simulator_.now().lower(), simulator_.name_of_work(work.subject())));
  }

 private:
  Simulator& simulator_;
  const Scene& scene_;
  std::function<void(const std::string&)> warn_;
  std::uint64_t extraordinary_;
  std::uint64_t moment_ = 0, before_ = 0, next_ = 0;
};

}  // namespace

void watch_exact_work(Simulator& simulator, const Scene& scene,
                      const std::function<void(const std::string&)>& warn, std::uint64_t extraordinary) {
  simulator.exact_work().set_watcher(WorkWatcher(simulator, scene, warn, extraordinary),
                                     extraordinary / 16 + 1);
}

}  // namespace kds
