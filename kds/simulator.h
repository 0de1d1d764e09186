#pragma once
// One clock and one queue for all structures of a run. Knows no geometry.

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
#include "kds/audit.h"
#include "kds/event_log.h"
#include "kds/event_queue.h"
#include "kds/failure_order.h"
#include "kds/fingerprint.h"
#include "kds/kinetic_structure.h"
#include "kds/stopwatch.h"
#include "motions/base/floating_point_guard.h"
#include "motions/base/require_index.h"

namespace kds {

/// The engine's side of a certificate table.
class FailureSource : public ScheduledSource {
 public:
  /// The failure in `slot` is the present event.
  virtual void fail(std::uint32_t slot) = 0;
  /// Its time is past: the slot may be used again.
  virtual void retire(std::uint32_t slot) = 0;
  /// The step is over: forget all certificates.
  virtual void clear() = 0;
  [[nodiscard]] virtual std::size_t structure() const = 0;
};

class Simulator {
 public:
  explicit Simulator(AuditMode audits = AuditMode::none, Kernel kernel = Kernel::filtered)
      : queue_(order_), audits_(audits), kernel_(kernel) {
    watch_.add_lane();  // of listeners
  }
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// What all computing of a run goes on under: rounding to nearest, and the run's account of exact work. A
  /// structure opens one where it is called by others than the simulator.
  class Entry {
   public:
    explicit Entry(Simulator& simulator) : account_(simulator.work_) {}

   private:
    FloatingPointGuard to_nearest_;
    ExactWork::Open account_;
  };

  /// Structures act in the order they are added. They must outlive the simulator's use. Throws
  /// std::logic_error once the structures are built, std::runtime_error where the processor has not what the
  /// libraries were compiled for (motions/numbers/processor.h).
  std::size_t add(KineticStructure& structure);
  /// Throws std::logic_error where certificates of another type have the same number.
  void add_table(FailureSource& table, const CertificateType& type);
  void listen(EventListener& listener) { listeners_.push_back(&listener); }

  /// Builds all structures. The motion must be that of the first step.
  void build();
  /// Runs [0,1) of the motion's present step, the simulator's next, and reaches its end. Throws
  /// std::logic_error where nothing has been built.
  void run_step();
  /// No step follows.
  void finish();
  /// What events say of the frames that the next step leads from and to. Until it is said, steps are counted.
  void set_frames(const FrameStamp& from, const FrameStamp& to);
  /// The same in parts, for what is done to structures while time runs: enters the step, runs to some times,
  /// ascending, and leaves. At each of them all that happens until then, or right then, has happened, and the
  /// structures are settled. Throws std::invalid_argument where a time is not in [now, 1), std::logic_error
  /// outside a step.
  void enter_step();
  void run_until(const Dyadic& time);
  void leave_step();
  /// Within the step: runs all that happens at the next time at which something does, irrational as it may
  /// be. False, and time stays, where nothing happens any more in the step.
  bool run_next();

  /// Audits all structures now, whatever AuditMode was chosen, and counts the audit. Within a step the
  /// structures settle first, and the audit is at a time between now and the next failure. Between steps
  /// the audit is at the end of the last step, or at the start of the first one. The motion must still be
  /// that of this step.
  /// Throws AuditError if a structure is wrong. Throws std::logic_error if nothing is built, an event is
  /// being handled or a failure is due at this very time.
  void audit_now();

  /// While time stands still: `set_curves()` gives some beads other curves in the motion, along which they go
  /// on from now; elsewhere than they are now, if need be. All structures follow, or, where one cannot,
  /// std::invalid_argument, and nothing is changed. A log does not hold curves: a replay must follow the same
  /// motion.
  void change_motion(std::span<const BeadId> beads, const std::function<void()>& set_curves);
  /// Throws std::invalid_argument unless a step is under way and nothing happens: not while an event is
  /// handled, nor after a run that was broken off by an exception.
  void require_standing_still() const;
  /// As run_step, but not beyond `most` failures: if there are more the step is given up, and false. Then
  /// the structures stand somewhere within it, are not asked to finish, and must be built anew at its end.
  [[nodiscard]] bool try_step(std::uint64_t most);

  /// A logged event, to be made again; `where` names it in messages.
  struct Replayed {
    std::size_t structure;
    double lower, upper;
    Change change;
    std::string where;
  };
  /// The same as build and run_step, but the changes come from a log: no certificate, no queue. Throws
  /// std::invalid_argument, with the event's `where`, if a change cannot be made.
  void build_for_replay();
  void replay_step(std::span<const Replayed> events);

  [[nodiscard]] Kernel kernel() const { return kernel_; }
  [[nodiscard]] std::size_t step() const { return step_; }
  [[nodiscard]] const Instant& now() const { return now_; }
  /// Counts different times: events at the very same time share a moment.
  [[nodiscard]] std::uint64_t moment() const { return moment_; }

  QueueHandle schedule(const FailureTime& time, FailureSource& source, std::uint32_t slot);
  void cancel(QueueHandle handle) { queue_.erase(handle); }
  [[nodiscard]] const FailureTime& scheduled(QueueHandle handle) { return queue_.at(handle).time; }
  /// It will soon be asked for, or cancelled.
  void fetch(QueueHandle handle) const { queue_.fetch(handle); }
  /// A structure reports what it did now.
  void record(std::size_t structure, const Change& change);

  /// The exact stage's work in this run, to be watched and limited: then what runs may throw
  /// WorkLimitReached, after which nothing but the end of the run is possible.
  [[nodiscard]] ExactWork& exact_work() { return work_; }
  /// What work is spent on, in words: this certificate, or, if none is named, the one whose failure is the
  /// present event.
  [[nodiscard]] std::string name_of_work(std::optional<Identity> subject) const;

  [[nodiscard]] std::uint64_t fingerprint() const { return fingerprint_.value(); }
  [[nodiscard]] const ComparisonCounts& comparisons() const { return order_.counts(); }
  [[nodiscard]] double seconds() const { return watch_.seconds(nobody); }
  /// Throws std::invalid_argument if there is no such structure.
  [[nodiscard]] double seconds_of(std::size_t structure) const {
    require_index("structure", structure, structures_.size());
    return watch_.seconds(lane_of(structure));
  }
  /// Returns the seconds that listeners took. They count for no structure and not for the engine.
  [[nodiscard]] double seconds_of_listeners() const { return watch_.seconds(listening); }

 private:
  /// What an irrational time is a root of, whatever becomes of the certificate that failed then.
  class HeldFunction final : public CertificateSource {
   public:
    [[nodiscard]] ExactFunction exact_function(std::uint32_t) const override { return function; }
    ExactFunction function;
  };

  enum class Phase : std::uint8_t { new_run, between_steps, within_step };
  // The stopwatch's lanes: engine, listeners, then structures.
  static constexpr std::size_t nobody = 0, listening = 1;
  [[nodiscard]] static constexpr std::size_t lane_of(std::size_t structure) { return structure + 2; }

  class Running;

  void require(Phase phase, const char* what) const;
  void hold_now();
  void begin_step();
  void start_step();
  void clear_step();
  void finish_step();
  void end_step();
  static constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
  /// Those until a time, or all of the step; false where `most` were not enough. Or those of one moment,
  /// whose last is `present_` then: false where there are none.
  template <bool one_moment>
  bool run_events(const Dyadic* until, std::uint64_t most = no_limit);
  [[nodiscard]] static bool is_after(const ScheduledFailure& failure, const Dyadic& time);
  void advance(ScheduledFailure* next);
  void retire_present();
  void after_batch();
  void audit(const Dyadic& time);
  [[nodiscard]] bool audit_before(ScheduledFailure* next);

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
  bool running_ = false;  // and still so where an exception ended it
  std::size_t step_ = 0;
  FrameStamp from_, to_{1, {}};
  HeldFunction held_;
  Instant now_;
  ScheduledFailure present_;  // the event that made it now; no source at the start of a step
  std::uint64_t moment_ = 0;
  Fingerprint fingerprint_;
  Stopwatch watch_;
  bool recording_ = true;  // false while a replayed structure builds itself
};

}  // namespace kds
