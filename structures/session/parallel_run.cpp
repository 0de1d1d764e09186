#include "structures/session/parallel_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "certificates/base/kernel.h"
#include "kds/simulator.h"
#include "motions/base/floating_point_scope.h"
#include "motions/base/interruption.h"
#include "motions/frames/frame_buffer.h"

namespace kds {

namespace {

// Parts shorter than this cost more in static builds and threads than they gain.
constexpr std::size_t least_steps_of_part = 4, least_bead_steps_of_part = 10'000;
// Longer parts keep more frames and events in memory.
constexpr std::size_t most_steps_of_part = 512, most_coordinates_of_part = std::size_t{1} << 22U;
constexpr std::size_t parts_per_thread = 8;
constexpr std::chrono::milliseconds between_asks{20};

/// Ends the parts under way when the run ends early.
struct RunHasEnded {};

/// Returns the number of steps of a part that begins `left` steps before the end. The last parts become
/// shorter, so that all threads end at about the same time.
std::size_t length_of_part(const Scene& scene, std::size_t left, std::size_t threads) {
  const std::size_t beads = std::max<std::size_t>(1, scene.bead_count());
  const std::size_t least = least_steps_of_thread(beads);
  const std::size_t most =
      std::min({most_steps_of_part, std::max<std::size_t>(1, most_coordinates_of_part / (3 * beads)),
                std::max(4 * least, scene.step_count() / (parts_per_thread * threads))});
  return std::min(left, std::clamp(left / threads, std::min(least, most), most));
}

void add_counts(const StructureStatistics& part, StructureStatistics& sum) {
  CertificateCounts& c = sum.certificates;
  const CertificateCounts& p = part.certificates;
  c.created += p.created;
  c.never_failing += p.never_failing;
  c.cancelled += p.cancelled;
  c.failed += p.failed;
  c.touched += p.touched;
  c.peak = std::max(c.peak, p.peak);
  c.per_bead_max = std::max(c.per_bead_max, p.per_bead_max);
  for (const Stage& stage : stage_table) {
    std::uint64_t& count = sum.stages.*stage.count;
    const std::uint64_t more = part.stages.*stage.count;
    count = stage.of == Stage::Of::size ? std::max(count, more) : count + more;
  }
  for (std::size_t kind = 0; kind < part.events_by_kind.size(); ++kind)
    sum.events_by_kind[kind] += part.events_by_kind[kind];
  sum.rebuilds += part.rebuilds;
  sum.audits_run += part.audits_run;
  sum.audits_failed += part.audits_failed;
}

/// A structure that others run: it has a name, kinds of events, and statistics.
class StructureElsewhere final : public KineticStructure {
 public:
  explicit StructureElsewhere(const KineticStructure& like) : name_(like.name()), kinds_(like.kinds()) {}

  [[nodiscard]] std::string_view name() const override { return name_; }
  [[nodiscard]] std::span<const EventKind> kinds() const override { return kinds_; }
  void build() override { refuse(); }
  void start_step() override { refuse(); }
  void fail(unsigned, std::uint32_t) override { refuse(); }
  void apply(const Change&) override { refuse(); }
  [[nodiscard]] std::optional<std::string> audit(const Dyadic&) override { refuse(); }

 private:
  [[noreturn]] static void refuse() {
    throw std::logic_error("a structure whose run is cut into parts exists only inside the parts");
  }

  std::string_view name_;
  std::span<const EventKind> kinds_;
};

}  // namespace

std::size_t least_steps_of_thread(std::size_t beads) {
  return std::max(least_steps_of_part, least_bead_steps_of_part / std::max<std::size_t>(1, beads));
}

std::size_t threads_worth(std::size_t steps, std::size_t beads, std::size_t threads) {
  return std::max<std::size_t>(1, std::min(threads, steps / least_steps_of_thread(beads)));
}

std::size_t all_threads() { return std::max(1U, std::thread::hardware_concurrency()); }

/// Results of a part at a frame, for all structures.
struct ParallelRun::Frame {
  std::vector<RelayedEvent> events;          ///< of the step that led here
  std::vector<LoggedEdit> edits;             ///< of this step
  std::vector<std::uint64_t> external;       ///< number of external events in it, for each structure
  std::vector<std::vector<DumpFile>> dumps;  ///< of each structure
  std::vector<std::optional<CombinatorialElements>> elements;
  std::vector<std::vector<Change>> built;  ///< at the first frame
  std::vector<double> static_seconds;      ///< of each structure
  std::vector<double> build_seconds;       ///< at the first frame
};

struct ParallelRun::Part {
  std::size_t first = 0, last = 0;  ///< steps first ... last - 1
  SharedFrames frames = {};
  std::optional<States> start = {};  ///< at the first frame
  std::deque<Frame> reached = {};    ///< the frames reached, from `first` + 1 on, and also frame 0
  std::exception_ptr error = {};     ///< escaped in the step after the last one in `reached`
  std::unique_ptr<Worker> worker = {};
  bool is_submitted = false, done = false;
};

/// Keeps the events of the steps of a part.
class ParallelRun::Recorder final : public EventListener {
 public:
  Recorder(const std::vector<EventListener*>& listeners, Simulator& simulator)
      : listeners_(listeners), simulator_(simulator) {}

  void on_event(const Event& event) override {
    const bool exact = std::any_of(listeners_.begin(), listeners_.end(),
                                   [&](const auto* l) { return l->reads_exact_time_of(event); });
    const bool is_new = !last_moment_ || *last_moment_ != simulator_.moment();
    last_moment_ = simulator_.moment();
    events.push_back(KnownEvents(simulator_).event_to_relay(event, is_new, exact));
  }
  void on_edit(const Edit& edit) override { edits.push_back({events.size(), edit}); }
  [[nodiscard]] bool prints_time_of(const Event& event) const override {
    return std::any_of(listeners_.begin(), listeners_.end(),
                       [&](const auto* l) { return l->prints_time_of(event); });
  }

  std::vector<RelayedEvent> events;  // of the step under way
  std::vector<LoggedEdit> edits;     // of the step under way

 private:
  const std::vector<EventListener*>& listeners_;
  Simulator& simulator_;
  std::optional<std::uint64_t> last_moment_;
};

/// A run of one or more parts, one after the other.
struct ParallelRun::Worker {
  Worker(const Scene& whole, const KineticRunOptions& options,
         const std::vector<std::function<void(KineticRun&)>>& additions,
         const std::vector<EventListener*>& listeners)
      : Worker(whole, std::make_unique<FrameRanges>(whole.frames()->necklaces()), options, listeners) {
    for (const auto& addition : additions) addition(run);
  }

  FrameRanges& frames;
  std::unique_ptr<const Scene> scene;
  KineticRun run;
  Recorder recorder;
  std::unique_ptr<FrameObserver> observer = nullptr;

 private:
  Worker(const Scene& whole, std::unique_ptr<FrameRanges> ranges, const KineticRunOptions& options,
         const std::vector<EventListener*>& listeners)
      : frames(*ranges),
        scene(whole.over(std::move(ranges))),
        run(*scene, options),
        recorder(listeners, run.simulator()) {
    if (listeners.empty()) return;
    run.listen(recorder);
    run.simulator().charge_listeners_to_structures();
  }
};

/// A structure of the joined run. It shows what the frame just reached has.
class ParallelRun::Joined final : public RunningStructure {
 public:
  Joined(Simulator& simulator, const KineticStructure& like) : structure_(like) { simulator.add(structure_); }

  [[nodiscard]] KineticStructure& kinetic() override { return structure_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override { return dump_; }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    return elements_;
  }
  [[nodiscard]] std::vector<Change> built() const override { return built_; }
  [[nodiscard]] double static_seconds(std::size_t) const override {
    throw std::logic_error("static builds of a run on several threads are timed while it runs");
  }

  void show(Frame& frame, std::size_t s) {
    if (s < frame.dumps.size()) dump_ = std::move(frame.dumps[s]);
    if (s < frame.elements.size()) elements_ = std::move(frame.elements[s]);
    if (s < frame.built.size()) built_ = std::move(frame.built[s]);
    if (s < frame.build_seconds.size()) structure_.statistics.build_seconds = frame.build_seconds[s];
    if (s < frame.external.size()) structure_.statistics.events_per_step.push_back(frame.external[s]);
  }

 private:
  StructureElsewhere structure_;
  std::vector<DumpFile> dump_;
  std::optional<CombinatorialElements> elements_;
  std::vector<Change> built_;
};

/// The threads besides the caller's, and the parts that wait for one. The caller helps while it waits.
/// The threads end with the run. Threads of a pool would go on, and a process that forks then may copy a lock
/// that such a thread holds (docs/measurements.md).
class ParallelRun::Workers {
 public:
  Workers(const ParallelRun& run, std::size_t threads) : run_(run) {
    threads_.reserve(threads);
    try {
      for (std::size_t i = 1; i < threads; ++i) threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      // The system has no more threads. The caller and the threads that have started do the work.
    }
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      waiting_.clear();
    }
    run_.is_stopped_ = true;  // the parts under way end soon
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  [[nodiscard]] std::size_t count() const { return 1 + threads_.size(); }

  void submit(Part& part) {
    {
      const std::lock_guard lock(mutex_);
      waiting_.push_back(&part);
    }
    changed_.notify_all();
  }
  /// Returns when the part is done. Runs parts that wait, in their order, meanwhile.
  void wait_for(const Part& part) {
    std::unique_lock lock(mutex_);
    while (!part.done) {
      lock.unlock();
      InterruptionCheck::ask();
      lock.lock();
      if (part.done) return;
      if (waiting_.empty()) {
        changed_.wait_for(lock, between_asks);
      } else {
        run_first(lock);
      }
    }
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    while (!stopping_) {
      if (waiting_.empty()) {
        changed_.wait(lock);
      } else {
        run_first(lock);
      }
    }
  }
  void run_first(std::unique_lock<std::mutex>& lock) {
    Part& part = *waiting_.front();
    waiting_.pop_front();
    lock.unlock();
    run_.run_part(part, nullptr);
    lock.lock();
    part.done = true;
    changed_.notify_all();
  }

  const ParallelRun& run_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Part*> waiting_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

ParallelRun::ParallelRun(const Scene& scene, const KineticRunOptions& options,
                         const ParallelOptions& parallel)
    : scene_(scene),
      options_(options),
      parallel_(parallel),
      own_(std::make_unique<KineticRun>(scene, options)),
      threads_(std::max<std::size_t>(1, parallel.threads)) {}

void ParallelRun::plan(std::function<void(KineticRun&)> addition) {
  if (is_decided_) throw std::logic_error("structures are added before the run is used");
  addition(*own_);
  additions_.push_back(std::move(addition));
}

/// Decides whether the run is cut. Structures can no longer be added.
void ParallelRun::decide() {
  if (std::exchange(is_decided_, true)) return;
  if (scene_.frames() == nullptr) {
    uncut_ = scene_.is_live() ? "its frames come one by one" : "its input is a single step";
  } else {
    for (std::size_t s = 0; s < own_->structures().size() && !uncut_; ++s)
      if (!own_->running(s).can_be_cut())
        uncut_ = fmt::format("{} has no state at a frame from which a part could start",
                             own_->structures()[s]->name());
  }
  if (uncut_) threads_ = 1;
  if (parallel_.steps_per_part == 0)
    threads_ = threads_worth(scene_.step_count(), scene_.bead_count(), threads_);
  if (uncut_ || (threads_ == 1 && parallel_.steps_per_part == 0) || own_->structures().empty()) {
    threads_ = 1;
    return;
  }
  KineticRunOptions none;
  none.by_default = false;
  none.kernel = options_.kernel;
  joined_.reset(new KineticRun(scene_, own_->motion()->ref(), none));
  for (const KineticStructure* const structure : own_->structures()) {
    auto joined = std::make_unique<Joined>(joined_->simulator(), *structure);
    structures_.push_back(joined.get());
    joined_->add_made(std::move(joined));
  }
}

ParallelRun::~ParallelRun() = default;

KineticRun& ParallelRun::whole() {
  decide();
  return joined_ ? *joined_ : *own_;
}

const std::optional<std::string>& ParallelRun::uncut() {
  decide();
  return uncut_;
}

std::size_t ParallelRun::threads() {
  decide();
  return threads_;
}

void ParallelRun::listen(EventListener& listener) {
  decide();
  listeners_.push_back(&listener);
  joined_ ? joined_->simulator().listen(listener) : own_->listen(listener);
}

void ParallelRun::limit_work(std::uint64_t most) {
  decide();
  own_->limit_work(most);
  if (!uncut_) uncut_ = "the limit of exact work counts the work of all steps in their order";
  threads_ = 1;
  if (!joined_) return;
  listeners_ = joined_->simulator().listeners();
  joined_.reset();
  structures_.clear();
  for (EventListener* const listener : listeners_) own_->listen(*listener);
}

void ParallelRun::run(const std::function<void(std::size_t)>& at_frame, Around around) {
  decide();
  around_ = around
                ? std::move(around)
                : [](KineticRun&, std::optional<std::size_t>, const std::function<void()>& work) { work(); };
  joined_ ? run_in_parts(at_frame) : run_uncut(at_frame);
}

void ParallelRun::run_uncut(const std::function<void(std::size_t)>& at_frame) {
  if (prepare_) prepare_(*own_);
  if (observe_) observer_ = observers_.emplace_back(observe_(*own_)).get();
  const auto reach = [&](std::size_t frame) {
    if (observer_ != nullptr) observer_->at_frame(frame);
    at_frame(frame);
  };
  around_(*own_, std::nullopt, [&] { own_->build(); });
  reach(0);
  for (std::size_t step = 0; own_->load_step(); ++step) {
    around_(*own_, step, [&] {
      if (observer_ != nullptr) observer_->in_step(step);
      run_step(*own_, step);
    });
    reach(step + 1);
  }
  // An error that can occur only after all steps is reported for the last step.
  around_(*own_, scene_.step_count() - 1, [&] { own_->finish(); });
}

/// Runs a step, whose motion is loaded, with its edits.
void ParallelRun::run_step(KineticRun& run, std::size_t step) const {
  for (const Edit& edit : std::ranges::equal_range(edits_, step, {}, &Edit::step)) run.repeat(edit);
  static_cast<void>(run.run_step());
}

/// Returns whether edits force the part that begins at this frame to continue the run of the part before.
/// Only that run checks that new courses end where the next step begins.
bool ParallelRun::must_continue(std::size_t first) const {
  return std::any_of(edits_.begin(), edits_.end(), [first](const Edit& edit) {
    return edit.kind == Edit::Kind::change ? edit.step + 1 == first : edit.step < first;
  });
}

/// Reads parts ahead: some for each thread to run, and as many again that wait to be joined.
void ParallelRun::run_in_parts(const std::function<void(std::size_t)>& at_frame) {
  const std::size_t steps = scene_.step_count();
  counts_ = {0, 0};
  listeners_ = joined_->simulator().listeners();  // some may have been added to the simulator
  std::deque<std::unique_ptr<Part>> in_flight;
  std::size_t again_in_a_row = 0;
  Workers workers(*this, threads_);  // destroyed before the parts
  threads_ = workers.count();
  for (std::size_t joined = 0, next = 0; joined < steps; ++counts_.parts) {
    // If one part after the other has to be run again, the work of the threads is in vain.
    const bool in_vain = again_in_a_row > 2 * threads_;
    while (next < steps && in_flight.size() < (in_vain ? 1 : 2 * threads_ + 1)) {
      in_flight.push_back(read_part(next));
      next = in_flight.back()->last;
      if (in_vain || must_continue(in_flight.back()->first)) continue;
      in_flight.back()->is_submitted = true;
      workers.submit(*in_flight.back());
    }
    Part& part = *in_flight.front();
    if (part.is_submitted) workers.wait_for(part);
    if (continues(part)) {
      again_in_a_row = 0;
      join(part, at_frame);
    } else {
      counts_.run_again += part.is_submitted ? 1 : 0;
      again_in_a_row += in_vain || part.is_submitted ? 1 : 0;
      Part anew{part.first, part.last, part.frames};
      run_part(anew, std::move(truth_));
      join(anew, at_frame);
    }
    joined = part.last;
    in_flight.pop_front();
  }
  retire(std::move(truth_));
}

std::unique_ptr<ParallelRun::Part> ParallelRun::read_part(std::size_t first) const {
  auto part = std::make_unique<Part>();
  part->first = first;
  const std::size_t left = scene_.step_count() - first;
  part->last = first + (parallel_.steps_per_part == 0 ? length_of_part(scene_, left, threads_)
                                                      : std::min(parallel_.steps_per_part, left));
  const std::size_t reach = scene_.reach();
  part->frames = scene_.frames()->read_ahead(first - std::min(first, reach),
                                             std::min(part->last + reach, scene_.frame_count() - 1));
  return part;
}

/// Runs the part from a static build, or goes on with `worker`. Exceptions are kept in the part.
void ParallelRun::run_part(Part& part, std::unique_ptr<Worker> worker) const {
  const bool is_fresh = worker == nullptr;
  const InterruptionCheck ends_with_run([this] {
    if (is_stopped_) throw RunHasEnded();
  });
  try {
    if (is_fresh) worker = std::make_unique<Worker>(scene_, options_, additions_, listeners_);
    worker->frames.add(part.frames);
    KineticRun& run = worker->run;
    if (is_fresh) {
      KnownEvents(run.simulator()).start_at(part.first);
      if (prepare_) prepare_(run);
      if (observe_) worker->observer = observe_(run);
      around_(run, std::nullopt, [&] { run.build(); });
      part.start = states_of(run);
      if (worker->observer) worker->observer->at_frame(part.first);
      if (part.first == 0) note_frame(part, *worker, 0);
    } else {
      worker->frames.release(part.first - std::min(part.first, scene_.reach()));
    }
    for (std::size_t step = part.first; step < part.last && !is_stopped_; ++step) {
      static_cast<void>(run.load_step());
      around_(run, step, [&] {
        if (worker->observer) worker->observer->in_step(step);
        run_step(run, step);
      });
      if (worker->observer) worker->observer->at_frame(step + 1);
      note_frame(part, *worker, step + 1);
    }
    // An error that can occur only after all steps is reported for the last step.
    if (part.last == scene_.step_count() && !is_stopped_) around_(run, part.last - 1, [&] { run.finish(); });
  } catch (...) {
    part.error = std::current_exception();
  }
  part.worker = std::move(worker);
}

void ParallelRun::note_frame(Part& part, Worker& worker, std::size_t number) const {
  const FloatingPointScope to_nearest;
  KineticRun& run = worker.run;
  Frame frame;
  frame.events = std::exchange(worker.recorder.events, {});
  frame.edits = std::exchange(worker.recorder.edits, {});
  worker.recorder.events.reserve(frame.events.size() + frame.events.size() / 8);  // steps resemble each other
  const bool is_end = number == 0 || number == scene_.step_count();
  for (std::size_t s = 0; s < run.structures().size(); ++s) {
    const RunningStructure& running = run.running(s);
    StructureStatistics& statistics = run.structures()[s]->statistics;
    if (number == 0) {
      frame.built.push_back(running.built());
      frame.build_seconds.push_back(statistics.build_seconds);
    } else {
      frame.external.push_back(statistics.events_per_step.back());
      statistics.events_per_step.clear();
    }
    if (parallel_.dumps) frame.dumps.push_back(running.dump(number));
    if (parallel_.elements || is_end) frame.elements.push_back(running.elements(number));
  }
  if (parallel_.static_builds) run.time_static_builds(number, frame.static_seconds);
  part.reached.push_back(std::move(frame));
}

/// Returns the states of all structures at the frame where the run stands. Returns nothing if one of them
/// depends on more than positions.
std::optional<ParallelRun::States> ParallelRun::states_of(const KineticRun& run) {
  const FloatingPointScope to_nearest;
  States states;
  for (std::size_t s = 0; s < run.structures().size(); ++s) {
    std::optional<std::vector<BeadId>> state = run.running(s).state();
    if (!state) return std::nullopt;
    states.push_back(std::move(*state));
  }
  return states;
}

/// Returns whether the part starts with the structures as the parts before left them.
bool ParallelRun::continues(const Part& part) const {
  if (part.first == 0) return true;
  return part.start && states_of(truth_->run) == part.start;
}

/// Tells the listeners and the caller what happened in the part.
void ParallelRun::join(Part& part, const std::function<void(std::size_t)>& at_frame) {
  observer_ = part.worker ? part.worker->observer.get() : nullptr;
  std::size_t number = part.first == 0 ? 0 : part.first + 1;
  for (; !part.reached.empty(); ++number) {
    show(part.reached.front(), number, at_frame);
    part.reached.pop_front();
  }
  if (part.error) {
    if (part.worker && number > 0)
      tell(number - 1, part.worker->recorder.events, part.worker->recorder.edits);
    std::rethrow_exception(part.error);
  }
  if (truth_) retire(std::move(truth_));
  truth_ = std::move(part.worker);
}

void ParallelRun::show(Frame& frame, std::size_t number, const std::function<void(std::size_t)>& at_frame) {
  if (number > 0) tell(number - 1, frame.events, frame.edits);
  for (std::size_t s = 0; s < structures_.size(); ++s) structures_[s]->show(frame, s);
  static_seconds_.resize(structures_.size(), 0);
  for (std::size_t s = 0; s < frame.static_seconds.size(); ++s) static_seconds_[s] += frame.static_seconds[s];
  at_frame(number);
  scene_.frames()->release(number - std::min<std::size_t>(number, 2));
}

/// Tells the listeners of the events and edits of a step.
void ParallelRun::tell(std::size_t step, const std::vector<RelayedEvent>& events,
                       const std::vector<LoggedEdit>& edits) {
  if (listeners_.empty() || (events.empty() && edits.empty())) return;
  KnownEvents(joined_->simulator()).relay(step, scene_.stamp(step), scene_.stamp(step + 1), events, edits);
}

/// Adds the counts of a worker whose parts have all been joined.
void ParallelRun::retire(std::unique_ptr<Worker> worker) {
  KnownEvents(joined_->simulator()).join(worker->run.simulator());
  for (std::size_t s = 0; s < structures_.size(); ++s)
    add_counts(worker->run.structures()[s]->statistics, structures_[s]->kinetic().statistics);
  if (worker->observer) observers_.push_back(std::move(worker->observer));
}

std::vector<double> ParallelRun::static_seconds() {
  if (joined_) return static_seconds_;
  std::vector<double> seconds(own_->structures().size(), 0);
  for (std::size_t frame = 0; frame < scene_.frame_count(); ++frame) own_->time_static_builds(frame, seconds);
  return seconds;
}

}  // namespace kds
