#include "kds/simulator.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "certificates/exact/exact_time.h"
#include "kds/event_log.h"
#include "kds/kinetic_structure.h"
#include "motions/base/interruption.h"
#include "motions/numbers/lanes.h"

namespace kds {

namespace {

/// Returns each bead once, in the order in which the beads are first named.
std::vector<BeadId> each_once(std::span<const BeadId> named) {
  std::vector<BeadId> beads;
  std::unordered_set<BeadId> found;
  for (const BeadId bead : named)
    if (found.insert(bead).second) beads.push_back(bead);
  return beads;
}

}  // namespace

/// Marks the run as running while structures change. If an exception escapes, the structures are in an
/// unknown state, so the run stays marked as running.
class Simulator::MutationScope {
 public:
  explicit MutationScope(Simulator& simulator)
      : running_(simulator.running_), before_(std::exchange(running_, true)) {}
  void end() { running_ = before_; }

 private:
  bool& running_;
  bool before_;
};

std::size_t Simulator::add(KineticStructure& structure) {
  if (const auto missing = missing_in_processor()) throw std::runtime_error(*missing);
  if (phase_ != Phase::new_run)
    throw std::logic_error(fmt::format(
        "{} is added to a run whose structures are built already: add it before build()", structure.name()));
  structures_.push_back(&structure);
  structure.statistics.events_by_kind.assign(structure.kinds().size(), 0);
  watch_.add_lane();
  return structures_.size() - 1;
}

void Simulator::add_table(FailureSource& table, const CertificateType& type) {
  for (const CertificateType& other : types_) {
    if (other.number == type.number && other.name != type.name)
      throw std::logic_error(
          fmt::format("certificate types {} and {} have the same number {}: give one of them another",
                      other.name, type.name, type.number));
  }
  types_.push_back(type);
  tables_.push_back(&table);
}

void Simulator::require(Phase phase, const char* what) const {
  if (running_)
    throw std::logic_error(fmt::format(
        "{}: an event is being handled, or the run was broken off by an exception: nothing follows", what));
  if (phase_ == phase) return;
  throw std::logic_error(
      fmt::format("{}: {}", what,
                  phase_ == Phase::new_run         ? "the structures have not been built: call build() first"
                  : phase_ == Phase::between_steps ? "no step has been entered: call enter_step() first"
                                                   : "a step is under way: call leave_step() first"));
}

void Simulator::build() {
  const ComputeScope scope(*this);
  if (phase_ == Phase::within_step) require(Phase::between_steps, "build()");
  phase_ = Phase::between_steps;
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    InterruptionCheck::ask();
    watch_.charge(lane_of(s));
    structures_[s]->build();
    watch_.charge(Stopwatch::stopped);
    structures_[s]->statistics.build_seconds = seconds_of(s);
  }
  watch_.reset();
}

void Simulator::run_step() {
  const ComputeScope scope(*this);
  start_step();
  run_events<false>(nullptr);
  finish_step();
}

void Simulator::finish() {
  const ComputeScope scope(*this);
  require(Phase::between_steps, "finish()");
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    watch_.charge(lane_of(s));
    structures_[s]->finish();
  }
  watch_.charge(Stopwatch::stopped);
}

void Simulator::set_frames(const FrameStamp& from, const FrameStamp& to) {
  from_ = from;
  to_ = to;
}

void Simulator::enter_step() {
  const ComputeScope scope(*this);
  start_step();
  watch_.charge(Stopwatch::stopped);
}

void Simulator::start_step() {
  require(Phase::between_steps, "a step");
  begin_step();
  MutationScope mutation(*this);
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    InterruptionCheck::ask();
    watch_.charge(lane_of(s));
    structures_[s]->start_step();
  }
  settle_batch();
  mutation.end();
}

void Simulator::run_until(const Dyadic& time) {
  const ComputeScope scope(*this);
  require(Phase::within_step, "run_until()");
  ExactTime stop(time);
  if (ExactTime::compare(stop, now_.exact()) < 0 || !(time < Dyadic(1.0)))
    throw std::invalid_argument(fmt::format("a run until u = {}: expected a time from {} on, before 1",
                                            time.rational().get_str(), now_.lower()));
  run_events<false>(&time);
  now_ = Instant(time);
  ++moment_;
  watch_.charge(Stopwatch::stopped);
}

bool Simulator::run_next(const Dyadic* until) {
  const ComputeScope scope(*this);
  require(Phase::within_step, "run_next()");
  const bool any = run_events<true>(until);
  if (any) hold_now();
  watch_.charge(Stopwatch::stopped);
  return any;
}

/// Keeps the function whose root is the present time, because the certificate that failed may be dropped and
/// its beads may get other curves.
void Simulator::hold_now() {
  if (present_.time.lower == present_.time.upper) {
    now_ = Instant(present_.time.lower);
  } else {
    held_.function = present_.source->exact_function(present_.slot);
    now_ = Instant(present_.time, held_, 0);
  }
  retire_present();
}

void Simulator::require_standing_still() const {
  if (phase_ != Phase::within_step || running_)
    throw std::invalid_argument("beads come, go and change course only within a step, between events");
}

void Simulator::change_motion(std::span<const BeadId> beads, const std::function<void()>& set_curves) {
  const ComputeScope scope(*this);
  require_standing_still();
  const std::vector<BeadId> once = each_once(beads);
  beads = once;
  std::vector<CourseFollower*> followers;
  for (KineticStructure* structure : structures_) {
    followers.push_back(dynamic_cast<CourseFollower*>(structure));
    if (followers.back() == nullptr)
      throw std::invalid_argument(fmt::format(
          "{}: its beads cannot change course within a step, only between two of them", structure->name()));
    followers.back()->require_release(beads);
  }
  MutationScope mutation(*this);
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    watch_.charge(lane_of(s));
    followers[s]->release(beads);
  }
  watch_.charge(Stopwatch::stopped);
  std::exception_ptr refused;  // rethrown after the structures have taken up the curves set so far
  try {
    set_curves();
  } catch (...) {
    refused = std::current_exception();
  }
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    watch_.charge(lane_of(s));
    followers[s]->take_up(beads);
  }
  mutation.end();
  watch_.charge(Stopwatch::stopped);
  if (refused) std::rethrow_exception(refused);
}

void Simulator::make_edit(Edit& edit, const std::function<void()>& make) {
  const ComputeScope scope(*this);
  require_standing_still();
  ExactTime& now = now_.exact();
  edit.step = step_;
  edit.after_failure = !now.is_dyadic();
  edit.time = now.lower();
  if (edit.after_failure) {
    ExactTime next = time_of_next();
    edit.time = dyadic_between(now, next);
  }
  untold_ = &edit;
  try {
    make();
  } catch (...) {
    untold_ = nullptr;
    throw;
  }
  if (const Edit* const untold = std::exchange(untold_, nullptr)) notify(*untold);
  MutationScope mutation(*this);
  settle_batch();
  mutation.end();
}

void Simulator::leave_step() {
  const ComputeScope scope(*this);
  require(Phase::within_step, "leave_step()");
  run_events<false>(nullptr);
  finish_step();
}

bool Simulator::try_step(std::uint64_t most) {
  const ComputeScope scope(*this);
  start_step();
  if (run_events<false>(nullptr, most)) {
    finish_step();
    return true;
  }
  clear_step();
  watch_.charge(Stopwatch::stopped);
  end_step();
  return false;
}

void Simulator::begin_step() {
  phase_ = Phase::within_step;
  now_ = Instant(0);
  present_ = {};
  for (KineticStructure* structure : structures_) structure->statistics.events_per_step.push_back(0);
  if (audits_ != AuditMode::none && step_ == 0) audit(Dyadic(0.0));
}

void Simulator::clear_step() {
  phase_ = Phase::between_steps;
  now_ = Instant(1);
  present_ = {};
  for (FailureSource* table : tables_) table->clear();
  queue_.clear();
}

void Simulator::finish_step() {
  clear_step();
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    watch_.charge(lane_of(s));
    structures_[s]->finish_step();
  }
  watch_.charge(Stopwatch::stopped);
  if (audits_ != AuditMode::none) audit(Dyadic(1.0));
  end_step();
}

void Simulator::end_step() {
  ++step_;
  set_frames({step_, {}}, {step_ + 1, {}});
}

template <bool one_moment>
bool Simulator::run_events(const Dyadic* until, std::uint64_t most) {
  MutationScope mutation(*this);
  [[maybe_unused]] bool any = false;
  const bool alone = structures_.size() == 1;  // then the engine's time is charged to the structure
  watch_.charge(alone ? lane_of(0) : engine_lane);
  while (true) {
    InterruptionCheck::ask();
    if ((audits_ == AuditMode::events || must_settle()) && is_batch_over()) {
      settle_batch();
      if (audits_ == AuditMode::events) static_cast<void>(audit_before_next());
    }
    const bool tied =
        present_.source != nullptr && !queue_.empty() && order_.compare_times(present_, queue_.top()) == 0;
    if (!tied) ++moment_;
    if constexpr (one_moment) {
      if ((any && !tied) || queue_.empty() || (until != nullptr && is_after(queue_.top(), *until))) {
        mutation.end();
        return any;
      }
      any = true;
    }
    retire_present();
    if (queue_.empty() || (until != nullptr && is_after(queue_.top(), *until))) {
      mutation.end();
      return true;
    }
    if (most-- == 0) {
      mutation.end();
      return false;
    }
    present_ = queue_.top();
    queue_.pop();
    FailureSource& source = *present_.source;
    now_ = Instant(present_.time, source, present_.slot);
    if (!alone) watch_.charge(lane_of(source.structure()));
    source.fail(present_.slot);
    if (!alone) watch_.charge(engine_lane);
  }
}

bool Simulator::is_after(const ScheduledFailure& failure, const Dyadic& time) {
  if (failure.time.lower > time.round_up()) return true;
  if (failure.time.upper < time.round_down()) return false;
  ExactTime failing = exact_time(*failure.source->exact_function(failure.slot), failure.time);
  ExactTime limit(time);
  return ExactTime::compare(limit, failing) < 0;
}

bool Simulator::must_settle() const {
  return std::any_of(structures_.begin(), structures_.end(), [](auto* s) { return s->needs_after_batch; });
}

bool Simulator::is_batch_over() {
  ScheduledFailure* const next = next_failure();
  return next == nullptr || present_.source == nullptr || order_.compare_times(present_, *next) < 0;
}

ExactTime Simulator::time_of_next() {
  const ScheduledFailure* const next = next_failure();
  return next == nullptr ? ExactTime(Dyadic(1.0))
                         : exact_time(*next->source->exact_function(next->slot), next->time);
}

/// Audits all structures at a time between now and the next failure, or between now and the end of the step.
/// Returns false if the next failure is due now.
bool Simulator::audit_before_next() {
  ExactTime then = time_of_next();
  if (ExactTime::compare(now_.exact(), then) >= 0) return false;
  audit(dyadic_between(now_.exact(), then));
  return true;
}

void Simulator::audit_now() {
  const ComputeScope scope(*this);
  require(phase_ == Phase::new_run ? Phase::between_steps : phase_, "audit_now()");
  if (phase_ == Phase::between_steps) return audit(Dyadic(step_ == 0 ? 0.0 : 1.0));
  MutationScope mutation(*this);
  settle_batch();
  if (!audit_before_next())
    throw std::logic_error("audit_now(): a failure is due at this very time: call run_next() first");
  mutation.end();
}

void Simulator::settle_batch() {
  for (std::size_t s = 0; s < structures_.size(); ++s) {
    if (!structures_[s]->needs_after_batch) continue;
    const std::size_t before = watch_.charge(lane_of(s));
    structures_[s]->needs_after_batch = false;
    structures_[s]->after_batch();
    watch_.charge(before);
  }
}

void Simulator::retire_present() {
  if (present_.source != nullptr) present_.source->retire(present_.slot);
  present_ = {};
}

void Simulator::audit(const Dyadic& time) {
  const std::size_t before = watch_.charge(Stopwatch::stopped);
  for (KineticStructure* structure : structures_) {
    InterruptionCheck::ask();
    ++structure->statistics.audits_run;
    if (const auto difference = structure->audit(time)) {
      ++structure->statistics.audits_failed;
      throw AuditError(fmt::format("audit of {} failed in step {} at u = {} (between {} and {}): {}",
                                   structure->name(), step_, time.rational().get_str(), time.round_down(),
                                   time.round_up(), *difference));
    }
  }
  watch_.charge(before);
}

std::string Simulator::name_of_work(std::optional<Identity> subject) const {
  if (!subject && present_.source != nullptr) subject = present_.identity();
  if (!subject) return "the start of the step";
  const auto type = std::find_if(types_.begin(), types_.end(),
                                 [&](const CertificateType& t) { return t.number == subject->type; });
  const auto end = std::find(subject->beads.begin(), subject->beads.end(), no_bead);
  return fmt::format("{} of beads {}", type == types_.end() ? "a certificate" : type->name,
                     fmt::join(subject->beads.begin(), end, ", "));
}

QueueHandle Simulator::schedule(const FailureTime& time, FailureSource& source, std::uint32_t slot) {
  return queue_.push([&](QueueHandle) { return ScheduledFailure{time, 0, slot, &source}; });
}

void Simulator::record(std::size_t structure, const Change& change) {
  if (!recording_) return;
  KineticStructure& s = *structures_[structure];
  ++s.statistics.events_by_kind[change.kind];
  if (s.kinds()[change.kind].external) ++s.statistics.events_per_step.back();
  fingerprint_.add(static_cast<std::uint32_t>(step_), static_cast<std::uint32_t>(structure), change);
  if (!listeners_.empty()) [[unlikely]]
    tell(structure, change);
}

template <class Work>
auto Simulator::for_listeners(const Work& work) {
  const ExactWork::Open account(listeners_work_);
  const std::size_t before = watch_.charge(listener_lane);
  auto result = work();
  watch_.charge(before);
  return result;
}

void Simulator::notify(const Edit& edit) {
  const std::size_t before = listeners_have_lane_ ? watch_.charge(listener_lane) : 0;
  MutationScope mutation(*this);
  for (EventListener* listener : listeners_) listener->on_edit(edit);
  mutation.end();
  if (listeners_have_lane_) watch_.charge(before);
}

void Simulator::tell(std::size_t structure, const Change& change) {
  if (const Edit* const untold = std::exchange(untold_, nullptr)) notify(*untold);
  const std::size_t before = listeners_have_lane_ ? watch_.charge(listener_lane) : 0;
  // Certain digits are charged to the listeners in any case.
  const TimeBracket bracket = for_listeners([&] { return canonical_bracket(now_); });
  notify(structure, change, bracket, present_.time.decided_by,
         [&] { return for_listeners([&] { return std::optional(rounded_time(now_, from_, to_)); }); });
  if (listeners_have_lane_) watch_.charge(before);
}

void Simulator::notify(std::size_t structure, const Change& change, const TimeBracket& bracket,
                       DecidedBy decided_by, const std::function<std::optional<RoundedTime>()>& rounded) {
  const KineticStructure& s = *structures_[structure];
  Event event{step_,    bracket.lower,          bracket.upper, structure, change,
              s.name(), s.kinds()[change.kind], from_,         to_,       {}};
  event.decided_by = decided_by;
  MutationScope mutation(*this);  // also if the change is an edit
  for (EventListener* listener : listeners_) {
    if (!event.rounded && listener->prints_time_of(event)) event.rounded = rounded();
    listener->on_event(event);
  }
  mutation.end();
}

}  // namespace kds
