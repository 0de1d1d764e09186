#pragma once
// The event loop: one clock and one queue for all structures of a run. Knows no geometry. The main loop is
// run_events in simulator.cpp. known_events.h replays events of a log and joins runs in parts.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/base/certificate_type.h"
#include "certificates/base/kernel.h"
#include "certificates/exact/exact_work.h"
#include "certificates/exact/instant.h"
#include "kds/event.h"
#include "kds/event_queue.h"
#include "kds/failure_order.h"
#include "kds/kinetic_structure.h"
#include "kds/stopwatch.h"
#include "motions/base/floating_point_scope.h"
#include "motions/base/require_index.h"

namespace kds {

class Simulator {
 public:
  explicit Simulator(AuditMode audits = AuditMode::none, Kernel kernel = Kernel::filtered)
      : queue_(order_), audits_(audits), kernel_(kernel) {
    watch_.add_lane();  // measures the time of the listeners
  }
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// Scope under which all computations of a run take place: sets rounding to nearest and charges exact work
  /// to this run. A structure opens one in each function that is called from outside the simulator.
  class ComputeScope {
   public:
    explicit ComputeScope(Simulator& simulator) : account_(simulator.work_) {}

   private:
    FloatingPointScope to_nearest_;
    ExactWork::Open account_;
  };

  /// Adds a structure. Structures act in the order in which they are added, and must remain valid as long as
  /// the simulator is used. Throws std::logic_error once the structures are built. Throws std::runtime_error
  /// if the processor lacks instructions for which the libraries were compiled (motions/numbers/lanes.h).
  std::size_t add(KineticStructure& structure);
  /// Throws std::logic_error if certificates of another type have the same number.
  void add_table(FailureSource& table, const CertificateType& type);
  void listen(EventListener& listener) { listeners_.push_back(&listener); }
  [[nodiscard]] const std::vector<EventListener*>& listeners() const { return listeners_; }
  /// Charges the time that listeners take to the structures. Use it for listeners that only keep events,
  /// which is quicker than to read the clock. The time to compute certain digits is never charged to them.
  void charge_listeners_to_structures() { listeners_have_lane_ = false; }

  /// Builds all structures. The motion must be that of the first step.
  void build();
  /// Runs the simulator's next step over [0,1) of the motion's present step, and then finishes it at u = 1.
  /// Throws std::logic_error if nothing has been built.
  void run_step();
  /// Tells all structures that no step follows.
  void finish();
  /// Sets the frames that the next step leads from and to, as events report them. Steps are counted until
  /// frames are set.
  void set_frames(const FrameStamp& from, const FrameStamp& to);
  /// Together these three do the work of run_step in parts, so that structures can be edited within a step:
  /// enter_step enters the step, run_until runs to given times in ascending order, and leave_step leaves the
  /// step. When run_until returns, all events up to and including that time are handled, and the structures
  /// are settled. Throws std::invalid_argument if a time is not in [now, 1), and std::logic_error outside a
  /// step.
  void enter_step();
  void run_until(const Dyadic& time);
  void leave_step();
  /// Handles all events at the next time in the step at which something happens; this time may be irrational.
  /// Returns false, and leaves the time unchanged, if nothing more happens in the step, or up to `until`.
  bool run_next(const Dyadic* until = nullptr);

  /// Audits all structures now, whatever AuditMode was chosen, and counts the audit. Within a step the
  /// structures settle first, and the audit is at a time between now and the next failure. Between steps
  /// the audit is at the end of the last step, or at the start of the first one. The motion must still be
  /// that of this step.
  /// Throws AuditError if a structure is wrong. Throws std::logic_error if nothing is built, an event is
  /// being handled or a failure is due at this very time.
  void audit_now();

  /// Gives some beads other curves while time stands still: `set_curves()` sets them in the motion, and the
  /// beads follow them from now on. The new curves may begin at other positions. All structures follow.
  /// Throws std::invalid_argument, and changes nothing, if a structure cannot follow.
  void change_motion(std::span<const BeadId> beads, const std::function<void()>& set_curves);
  /// Calls `make`, which edits structures while time stands still, then settles the structures. Sets the step
  /// and time of `edit`. Notifies the listeners of the edit, unless `make` throws before any change.
  void make_edit(Edit& edit, const std::function<void()>& make);
  /// Throws std::invalid_argument unless a step is under way and nothing is happening: while an event is
  /// handled, and after a run that an exception ended.
  void require_standing_still() const;
  /// Runs a step like run_step, but handles at most `most` failures. Returns false if there are more; the
  /// step is then abandoned. In this case the structures stand somewhere within the step, are not asked to
  /// finish, and must be built anew at its end.
  [[nodiscard]] bool try_step(std::uint64_t most);

  [[nodiscard]] Kernel kernel() const { return kernel_; }
  [[nodiscard]] std::size_t step() const { return step_; }
  [[nodiscard]] const Instant& now() const { return now_; }
  /// Counts the different times so far. Events at exactly the same time share a moment.
  [[nodiscard]] std::uint64_t moment() const { return moment_; }

  QueueHandle schedule(const FailureTime& time, FailureSource& source, std::uint32_t slot);
  void cancel(QueueHandle handle) { queue_.erase(handle); }
  [[nodiscard]] const FailureTime& scheduled(QueueHandle handle) { return queue_.at(handle).time; }
  /// Prefetches an entry that will be needed or cancelled soon.
  void fetch(QueueHandle handle) const { queue_.fetch(handle); }
  /// Records a change that a structure made at the present time.
  void record(std::size_t structure, const Change& change);

  /// Returns the account of exact work in this run, on which limits can be set. When a limit is reached,
  /// running functions throw WorkLimitReached, and the run can only be ended.
  [[nodiscard]] ExactWork& exact_work() { return work_; }
  /// Describes in words what the exact work is spent on: the certificate `subject` or, if there is none, the
  /// certificate whose failure is the present event.
  [[nodiscard]] std::string name_of_work(std::optional<Identity> subject) const;

  [[nodiscard]] std::uint64_t fingerprint() const { return fingerprint_.value(); }
  [[nodiscard]] const ComparisonCounts& comparisons() const { return order_.counts(); }
  [[nodiscard]] double seconds() const { return watch_.seconds(engine_lane); }
  /// Throws std::invalid_argument if there is no such structure.
  [[nodiscard]] double seconds_of(std::size_t structure) const {
    require_index("structure", structure, structures_.size());
    return watch_.seconds(lane_of(structure));
  }
  /// Returns the seconds that listeners took. These seconds count for no structure and not for the engine.
  [[nodiscard]] double seconds_of_listeners() const { return watch_.seconds(listener_lane); }

 private:
  /// Keeps the function of an irrational present time, whatever becomes of the certificate that failed.
  class HeldFunction final : public CertificateSource {
   public:
    [[nodiscard]] ExactFunction exact_function(std::uint32_t) const override { return function; }
    ExactFunction function;
  };

  enum class Phase : std::uint8_t { new_run, between_steps, within_step };
  // Lanes of the stopwatch: engine, listeners, then structures.
  static constexpr std::size_t engine_lane = 0, listener_lane = 1;
  [[nodiscard]] static constexpr std::size_t lane_of(std::size_t structure) { return structure + 2; }

  friend class KnownEvents;
  class MutationScope;

  void require(Phase phase, const char* what) const;
  /// Notifies the listeners of a change now. Kept out of line, because most runs have none.
  [[gnu::noinline]] void tell(std::size_t structure, const Change& change);
  void notify(const Edit& edit);
  /// Notifies the listeners of a change. `rounded` is asked for the time in certain digits if one of them
  /// prints it.
  void notify(std::size_t structure, const Change& change, const TimeBracket& bracket, DecidedBy decided_by,
              const std::function<std::optional<RoundedTime>()>& rounded);
  /// Does work for the listeners, which is not counted as the run's own.
  template <class Work>
  auto for_listeners(const Work& work);
  void hold_now();
  void begin_step();
  void start_step();
  void clear_step();
  void finish_step();
  void end_step();
  static constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
  /// If `one_moment` is false, runs all events until the given time or, if null, to the end of the step;
  /// returns false if there are more than `most`. If `one_moment` is true, runs the events of one moment, the
  /// last of which is then `present_`; returns false if there are none.
  template <bool one_moment>
  bool run_events(const Dyadic* until, std::uint64_t most = no_limit);
  [[nodiscard]] static bool is_after(const ScheduledFailure& failure, const Dyadic& time);
  /// Returns null if nothing more fails in this step.
  [[nodiscard]] ScheduledFailure* next_failure() { return queue_.empty() ? nullptr : &queue_.top(); }
  /// Returns the exact time of the next failure in this step, or 1.
  [[nodiscard]] ExactTime time_of_next();
  /// Returns whether a structure waits for the end of the batch, which is all failures at one time.
  [[nodiscard]] bool must_settle() const;
  [[nodiscard]] bool is_batch_over();
  void settle_batch();
  void retire_present();
  void audit(const Dyadic& time);
  [[nodiscard]] bool audit_before_next();

  ExactWork work_, listeners_work_;
  FailureOrder order_;
  EventQueue<ScheduledFailure, FailureOrder> queue_;
  std::vector<KineticStructure*> structures_;
  std::vector<FailureSource*> tables_;
  std::vector<EventListener*> listeners_;
  std::vector<CertificateType> types_;
  AuditMode audits_;
  Kernel kernel_;
  Phase phase_ = Phase::new_run;
  bool running_ = false;  // stays true if an exception ended the run
  std::size_t step_ = 0;
  FrameStamp from_, to_{1, {}};
  HeldFunction held_;
  Instant now_;
  ScheduledFailure present_;  // the failure being handled; no source at the start of a step
  std::uint64_t moment_ = 0;
  Fingerprint fingerprint_;
  Stopwatch watch_;
  bool listeners_have_lane_ = true;
  bool recording_ = true;         // false while a replayed structure builds itself
  const Edit* untold_ = nullptr;  // an edit that is being made and has changed nothing so far
};

}  // namespace kds
