#include "tests/laws/law_run.h"

#include <fmt/format.h>

#include <numeric>
#include <utility>

namespace kds::test {

namespace {

/// Calls `look` at every so many audits inside a step (`every`). `look` gets the balls at a slightly later
/// time, because a structure may be degenerate at a single moment without an event, or at that time if it
/// accepts ties.
class Judge final : public KineticStructure {
 public:
  using Look = std::function<std::optional<std::string>(const ExactBalls&)>;

  template <int Dimension>
  Judge(Simulator& simulator, const MotionRef<Dimension>& motion, std::uint64_t every, bool accepts_ties,
        Look look)
      : every_(every),
        accepts_ties_(accepts_ties),
        look_(std::move(look)),
        balls_([motion](const Dyadic& u) { return balls_at(motion.curves(), u); }) {
    static_cast<void>(simulator.add(*this));
  }
  [[nodiscard]] std::string_view name() const override { return "judge"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override { return {}; }
  void build() override {}
  void start_step() override {}
  void fail(unsigned, std::uint32_t) override {}
  void apply(const Change&) override {}
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override {
    if (time == Dyadic(0.0) || time == Dyadic(1.0) || audits_++ % every_ != 0) return std::nullopt;
    return look_(
        balls_(accepts_ties_ ? time : Dyadic((time.numerator() << 100U) + 1, time.exponent() + 100)));
  }

 private:
  std::uint64_t every_, audits_ = 0;
  bool accepts_ties_;
  Look look_;
  std::function<ExactBalls(const Dyadic&)> balls_;
};

}  // namespace

std::optional<std::string> difference(const std::vector<Event>& some, const std::vector<Event>& others) {
  if (some.size() != others.size())
    return fmt::format("{} events, the other run has {}", some.size(), others.size());
  for (std::size_t i = 0; i < some.size(); ++i) {
    const Event &a = some[i], &b = others[i];
    if (a.step != b.step || a.change != b.change || a.lower != b.lower || a.upper != b.upper)
      return fmt::format(
          "event {}: kind {} in step {} at {} to {}, the other run has kind {} in step {} at "
          "{} to {}",
          i, a.change.kind, a.step, a.lower, a.upper, b.change.kind, b.step, b.lower, b.upper);
  }
  return std::nullopt;
}

std::optional<std::string> difference(const Outcome& run, const Outcome& other) {
  if (run.ending != other.ending)
    return fmt::format("the run ends with '{}', the other run with '{}'", run.ending, other.ending);
  if (auto events = difference(run.events, other.events)) return events;
  if (run.dumps != other.dumps) return "the dumps differ";
  if (run.events_by_kind != other.events_by_kind) return "the numbers of events by kind differ";
  if (run.rebuilds != other.rebuilds) return "the numbers of rebuilds differ";
  if (run.fingerprint != other.fingerprint) return "the fingerprints differ";
  return std::nullopt;
}

Beads all_beads(const Scene& scene) {
  Beads beads(scene.bead_count());
  std::iota(beads.begin(), beads.end(), BeadId{0});
  return beads;
}

std::size_t bases_of(const StructureSpec& spec) {
  return spec.stands_on.empty() ? 0 : 1 + bases_of(*structure_registry().find(spec.stands_on));
}

bool is_accepted(const Scene& scene, const LawStructure& row) {
  try {
    if (structure_registry().find(row.name)->refusal(scene)) return false;
    static_cast<void>(KineticRun(scene, {{row.name}, Kernel::filtered, AuditMode::none, row.settings}));
  } catch (const InputError&) {  // too small weights, or no boxes with these directions in the plane
    return false;
  }
  return true;
}

Outcome run_scene(const Scene& scene, const LawStructure& row, Kernel kernel, AuditMode audits, bool judged,
                  std::uint64_t most_work) {
  const std::size_t index = bases_of(*structure_registry().find(row.name));
  Outcome outcome;
  EventLog log;
  note_ending(outcome, [&] {
    KineticRun run(scene, {{row.name}, kernel, audits, row.settings});
    run.limit_work(most_work);
    run.listen(log);
    if (audits == AuditMode::events && judged && row.fault) {
      const Beads present = all_beads(scene);
      const std::uint64_t every =
          row.judge_every * (present.size() < 12 ? 1 : present.size() * present.size() / 16);
      static_cast<void>(run.add<Judge>(
          every, row.accepts_ties, Judge::Look([&, present](const ExactBalls& balls) {
            const RunningStructure* const base = index == 0 ? nullptr : &run.running(index - 1);
            return row.fault({scene, run.running(index), base, balls, present});
          })));
    }
    run.build();
    outcome.add_dumps(run.running(index).dump(0));
    for (std::size_t frame = 1; run.run_step(); ++frame) outcome.add_dumps(run.running(index).dump(frame));
    run.finish();
    const StructureStatistics& statistics = run.structures()[index]->statistics;
    outcome.add_end(run.simulator(), run.running(index), statistics);
    const CertificateCounts& c = statistics.certificates;
    if (c.created != c.never_failing + c.cancelled + c.failed + c.touched || c.alive != 0)
      throw std::logic_error("the counts of certificates do not balance");
  });
  outcome.events = std::move(log.events);
  return outcome;
}

}  // namespace kds::test
