// Five laws that every structure obeys on every scene. The tables are law_scenes.cpp and law_structures.cpp.
//
//   1. Between all events the structure passes its audit, and brute force finds the same.
//   2. The kernels filtered and exact have the same events at the same times, and the same dumps.
//   3. A run cut into parts on several threads gives the results of the uncut run.
//   4. Replaying the events without certificates gives the same structure at each frame.
//   5. After edits, the structure is the one built from the beads that are present, on their present curves.
//      The kernels agree. A replay gives the same structure, and a run in parts that makes the logged edits
//      has the same events.
//
// KDS_LAW_SCENES in the environment multiplies the number of scenes; KDS_LAW_SEED is the first seed;
// KDS_LAW_STRUCTURE runs one structure only; KDS_LAW_BEADS is the largest number of beads of a scene.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "kds/known_events.h"
#include "motions/base/input_error.h"
#include "structures/session/parallel_run.h"
#include "tests/laws/law_scenes.h"
#include "tests/laws/law_structures.h"
#include "tests/support/inputs/random.h"
#include "tests/support/property_runs.h"
#include "tests/support/rounds.h"

namespace kds::laws_test {
namespace {

using namespace test;

/// Limb operations after which a run is given up. They take about a second for 10^8.
constexpr std::uint64_t most_work = 40'000'000;

/// Everything that two runs must have in common.
struct Outcome {
  std::string ending;  // "done", "too much work", or the message of a refusal
  std::vector<Event> events;
  std::vector<std::string> dumps;  // of all frames
  Beads state;                     // at the end
  std::vector<std::uint64_t> events_by_kind;
  std::uint64_t rebuilds = 0, fingerprint = 0;

  [[nodiscard]] bool is_decided() const { return ending != "too much work"; }
  void add_dumps(const std::vector<DumpFile>& files) {
    for (const DumpFile& file : files) dumps.push_back(file.ending + "\n" + file.text);
  }
  void add_end(Simulator& simulator, const RunningStructure& structure,
               const StructureStatistics& statistics) {
    state = state_now(structure);
    fingerprint = simulator.fingerprint();
    events_by_kind = statistics.events_by_kind;
    rebuilds = statistics.rebuilds;
    ending = "done";
  }
};

void expect_same_events(const std::vector<Event>& some, const std::vector<Event>& others) {
  ASSERT_EQ(some.size(), others.size());
  for (std::size_t i = 0; i < some.size(); ++i) {
    ASSERT_EQ(some[i].step, others[i].step) << "event " << i;
    ASSERT_EQ(some[i].change, others[i].change) << "event " << i;
    ASSERT_EQ(some[i].lower, others[i].lower) << "event " << i;
    ASSERT_EQ(some[i].upper, others[i].upper) << "event " << i;
  }
}

void expect_same(const Outcome& run, const Outcome& other) {
  EXPECT_EQ(run.ending, other.ending);
  expect_same_events(run.events, other.events);
  EXPECT_EQ(run.dumps, other.dumps);
  EXPECT_EQ(run.events_by_kind, other.events_by_kind);
  EXPECT_EQ(run.rebuilds, other.rebuilds);
  EXPECT_EQ(run.fingerprint, other.fingerprint);
}

/// Ends an outcome with the reason why `run` did not end by itself, if there is one.
template <class Run>
void note_ending(Outcome& outcome, Run run) {
  try {
    run();
  } catch (const InputError& refusal) {  // input beyond a stated limit
    outcome.ending = refusal.what();
  } catch (const WorkLimitReached&) {
    outcome.ending = "too much work";
  } catch (const std::exception& error) {  // a failed audit, an internal error
    outcome.ending = error.what();
    ADD_FAILURE() << error.what();
  }
}

Beads all_beads(const Scene& scene) {
  Beads beads(scene.bead_count());
  for (BeadId b = 0; b < beads.size(); ++b) beads[b] = b;
  return beads;
}

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

struct Counts {
  int runs = 0;
  int decided = 0;  ///< runs within the limit of work
  int done = 0;     ///< runs of structures with events that no step refused
  int edited = 0;   ///< edits that were not refused
};

/// A structure on a scene.
class Subject {
 public:
  Subject(const Scene& scene, const LawStructure& row, bool judged, Counts& counts)
      : scene_(scene),
        row_(row),
        spec_(*structure_registry().find(row.name)),
        judged_(judged && row.fault),
        index_(bases_of(spec_)),
        counts_(counts) {}

  void expect_laws(std::uint64_t seed) {
    const Outcome plain = run(Kernel::filtered, AuditMode::none);
    if (!plain.is_decided()) return;
    ++counts_.decided;
    const Outcome audited = run(Kernel::filtered, AuditMode::events);
    if (audited.is_decided()) {
      SCOPED_TRACE("law 1, audits");
      expect_same(audited, plain);
    }
    const Outcome exact = run(Kernel::exact, AuditMode::none);
    if (exact.is_decided()) {
      SCOPED_TRACE("law 2, kernels");
      expect_same(exact, plain);
    }
    expect_parts(plain, seed);
    if (plain.ending != "done" || !spec_.has_events(row_.settings)) return;
    ++counts_.done;
    {
      SCOPED_TRACE("law 4, replay");
      const Outcome again = replayed(plain.events, {}, plain.fingerprint);
      EXPECT_EQ(again.dumps, plain.dumps);
      EXPECT_EQ(again.state, plain.state);
    }
    expect_edits(seed);
  }

 private:
  /// Returns the number of structures on which the structure stands.
  [[nodiscard]] static std::size_t bases_of(const StructureSpec& spec) {
    return spec.stands_on.empty() ? 0 : 1 + bases_of(*structure_registry().find(spec.stands_on));
  }
  [[nodiscard]] const RunningStructure& subject(const KineticRun& run) const { return run.running(index_); }
  [[nodiscard]] const RunningStructure* base_of(const KineticRun& run) const {
    return index_ == 0 ? nullptr : &run.running(index_ - 1);
  }
  /// Makes the structure, which comes last, and those on which it stands.
  [[nodiscard]] std::vector<std::unique_ptr<RunningStructure>> make_in(Simulator& simulator,
                                                                       const SceneMotion::Ref& motion) const {
    std::vector<const StructureSpec*> specs{&spec_};
    while (!specs.back()->stands_on.empty())
      specs.push_back(structure_registry().find(specs.back()->stands_on));
    std::vector<std::unique_ptr<RunningStructure>> made;
    for (auto spec = specs.rbegin(); spec != specs.rend(); ++spec) {
      StructureSettings settings = row_.settings;
      settings.base = made.empty() ? nullptr : &made.back()->kinetic();
      made.push_back((*spec)->make(simulator, scene_, motion, settings));
    }
    return made;
  }
  [[nodiscard]] KineticRunOptions options(Kernel kernel, AuditMode audits) const {
    return {{row_.name}, kernel, audits, row_.settings};
  }

  /// Runs the scene. With audits, brute force judges too. With 12 or more beads it judges only every
  /// n^2/16-th audit.
  [[nodiscard]] Outcome run(Kernel kernel, AuditMode audits) const {
    Outcome outcome;
    EventLog log;
    note_ending(outcome, [&] {
      KineticRun run(scene_, options(kernel, audits));
      run.limit_work(most_work);
      run.listen(log);
      if (audits == AuditMode::events && judged_) {
        const Beads present = all_beads(scene_);
        const std::uint64_t every =
            row_.judge_every * (present.size() < 12 ? 1 : present.size() * present.size() / 16);
        static_cast<void>(run.add<Judge>(
            every, row_.accepts_ties, Judge::Look([this, &run, present](const ExactBalls& balls) {
              return row_.fault({scene_, subject(run), base_of(run), balls, present});
            })));
      }
      run.build();
      outcome.add_dumps(subject(run).dump(0));
      for (std::size_t frame = 1; run.run_step(); ++frame) outcome.add_dumps(subject(run).dump(frame));
      run.finish();
      const StructureStatistics& statistics = run.structures()[index_]->statistics;
      outcome.add_end(run.simulator(), subject(run), statistics);
      const CertificateCounts& c = statistics.certificates;
      EXPECT_EQ(c.created, c.never_failing + c.cancelled + c.failed + c.touched);
      EXPECT_EQ(c.alive, 0U);
    });
    outcome.events = std::move(log.events);
    return outcome;
  }

  void expect_parts(const Outcome& whole, std::uint64_t seed) const {
    SCOPED_TRACE("law 3, parts");
    Outcome cut;
    EventLog log;
    bool is_cut = true;
    note_ending(cut, [&] {
      ParallelRun run(scene_, options(Kernel::filtered, AuditMode::none), {2 + seed % 4, 1 + seed % 3, true});
      is_cut = !run.uncut();
      if (!is_cut) return;
      run.listen(log);
      run.run([&](std::size_t frame) { cut.add_dumps(subject(run.whole()).dump(frame)); });
      cut.add_end(run.simulator(), subject(run.whole()), run.whole().structures()[index_]->statistics);
    });
    if (!is_cut) return;
    cut.events = std::move(log.events);
    expect_same(cut, whole);
  }

  /// Replays events and edits without certificates, which must give this fingerprint. Returns the dumps and
  /// the state.
  [[nodiscard]] Outcome replayed(const std::vector<Event>& log, const std::vector<LoggedEdit>& all_edits,
                                 std::uint64_t fingerprint) const {
    Outcome outcome;
    note_ending(outcome, [&] {
      Simulator simulator(AuditMode::frames);
      const auto motion = make_scene_motion(scene_);
      const auto structures = make_in(simulator, motion->ref());
      const auto& structure = structures.back();
      motion->load(0);
      KnownEvents(simulator).build_for_replay();
      outcome.add_dumps(structure->dump(0));
      auto next = log.begin();
      for (std::size_t step = 0; step < scene_.step_count(); ++step) {
        std::vector<LoggedEdit> edits;
        for (const auto& [before, edit] : all_edits)
          if (edit.step == step)
            edits.push_back({before - static_cast<std::size_t>(next - log.begin()), edit});
        std::vector<ReplayedEvent> events;
        for (; next != log.end() && next->step == step; ++next)
          events.push_back({next->structure_index, next->lower, next->upper, next->change, "the run"});
        motion->load(step);
        KnownEvents(simulator).replay_step(events, edits, [&](const Edit& edit) {
          if (edit.kind == Edit::Kind::change) set_coordinates(*motion, edit.beads, edit.points);
        });
        outcome.add_dumps(structure->dump(step + 1));
      }
      simulator.finish();
      outcome.state = state_now(*structure);
      EXPECT_EQ(simulator.fingerprint(), fingerprint);
    });
    return outcome;
  }

  /// Makes logged edits again in a run that is cut into parts.
  void expect_repeated(const EventLog& log, std::uint64_t fingerprint, std::uint64_t seed) const {
    SCOPED_TRACE("edits made again");
    EventLog again;
    ParallelRun run(scene_, options(Kernel::filtered, AuditMode::none), {2 + seed % 4, 1 + seed % 3});
    run.listen(again);
    std::vector<Edit> edits;
    for (const LoggedEdit& logged : log.edits) edits.push_back(logged.edit);
    run.repeat(edits);
    run.run([](std::size_t) {});
    expect_same_events(again.events, log.events);
    ASSERT_EQ(again.edits.size(), log.edits.size());
    for (std::size_t i = 0; i < log.edits.size(); ++i) {
      EXPECT_EQ(again.edits[i].events_before, log.edits[i].events_before);
      EXPECT_EQ(again.edits[i].edit.beads, log.edits[i].edit.beads);
    }
    EXPECT_EQ(run.simulator().fingerprint(), fingerprint);
  }

  /// Edits the structure at events and at multiples of 1/8, with both kernels.
  void expect_edits(std::uint64_t seed) const {
    SCOPED_TRACE("law 5, edits");
    std::optional<std::uint64_t> filtered;
    std::vector<Event> events;  // of the kernel filtered, as is the ending
    std::string ending;
    for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
      Outcome outcome;
      EventLog log;
      note_ending(outcome, [&] {
        KineticRun run(scene_, options(kernel, AuditMode::events));
        KineticStructure* const structure = run.structures()[index_];
        ASSERT_EQ(dynamic_cast<CourseFollower*>(structure) != nullptr, row_.edits != Edits::none)
            << "the row's `edits` says otherwise than the structure's base class";
        ASSERT_EQ(edits_of(*structure) != nullptr, row_.edits == Edits::beads)
            << "the row's `edits` says otherwise than the structure's base class";
        if (row_.edits == Edits::none) return;
        run.limit_work(most_work);
        run.listen(log);
        Random random(seed);
        run.enter_step();
        for (int edits = 0; edits < 10 && (edits == 0 || run.next_event()); ++edits) {
          if (const Dyadic u = next_on_grid(run.simulator().now().exact(), 3);
              edits % 3 == 0 && u < Dyadic(1.0))
            run.simulator().run_until(u);
          insert_or_erase(run, random);
          change_courses(run, random);
          expect_as_built(run, row_.judge_every == 1 || edits % 4 == 0);
        }
        while (run.run_step()) continue;
        run.finish();
        if (!filtered) {
          filtered = run.simulator().fingerprint();
          events = log.events;
        }
        expect_same_events(log.events, events);
        EXPECT_EQ(run.simulator().fingerprint(), *filtered);
        if (kernel == Kernel::exact) return;
        EXPECT_EQ(replayed(log.events, log.edits, *filtered).state, state_now(subject(run)));
        expect_repeated(log, *filtered, seed);
      });
      if (!outcome.is_decided()) return;
      if (kernel == Kernel::filtered) ending = outcome.ending;
      EXPECT_EQ(outcome.ending, ending);  // empty, or the refusal of a step whose beads are always coplanar
    }
  }

  void insert_or_erase(KineticRun& run, Random& random) const {
    const auto bead = static_cast<BeadId>(random() % scene_.bead_count());
    BeadEdits* const edits = edits_of(*run.structures()[index_]);
    if (edits == nullptr) return;
    const bool was_absent = edits->is_absent(bead);
    try {
      was_absent ? run.insert(index_, bead) : run.erase(index_, bead);
      EXPECT_NE(edits->is_absent(bead), was_absent);
      ++counts_.edited;
    } catch (const std::invalid_argument&) {  // too few beads would remain, or they would all stay flat
      EXPECT_EQ(edits->is_absent(bead), was_absent);
    }
  }

  /// Gives one, two or all beads the courses of others, up to the end of the step, where they stay. Sometimes
  /// the declared change leaves a course as it is.
  void change_courses(KineticRun& run, Random& random) const {
    const auto count = static_cast<BeadId>(scene_.bead_count());
    Beads beads;
    const auto kind = random() % 5;
    for (BeadId b = 0; b < count && kind == 0; ++b) beads.push_back(b);
    for (std::uint64_t i = 0; i < kind % 3 + 1 && kind > 0; ++i)
      beads.push_back(static_cast<BeadId>(random() % count));
    const auto shift = kind == 1 ? 0 : static_cast<BeadId>(random() % count);
    try {
      run.change_motion(beads, [&](SceneMotion& motion) {
        std::visit(
            [&]<int D>(const MotionRef<D>& ref) {
              for (const BeadId bead : beads)
                for (int k = 0; k < ref.degree(); ++k)
                  for (int axis = 0; axis < D; ++axis)
                    motion.set_coordinate(bead, k, axis,
                                          ref.curves().coordinate((bead + shift) % count, k, axis));
            },
            run.motion()->ref());
      });
      ++counts_.edited;
    } catch (const std::invalid_argument&) {  // all beads stay in one plane, so the diagram has no cells
    }
  }

  /// Compares the structure, a little later, with one that runs from the start of the step with the present
  /// beads on their present curves and, if `judged`, with brute force.
  void expect_as_built(KineticRun& run, bool judged) const {
    const Dyadic soon = next_on_grid(run.simulator().now().exact(), 200);
    if (!(soon < Dyadic(1.0))) return;
    run.simulator().run_until(soon);
    Beads present = all_beads(scene_);
    const BeadEdits* const edits = edits_of(*run.structures()[index_]);
    std::erase_if(present, [&](BeadId b) { return edits != nullptr && edits->is_absent(b); });
    const SceneMotion::Ref motion = run.motion()->ref();
    if (judged_ && judged) {
      const ExactBalls balls =
          std::visit([&](const auto& ref) { return balls_at(ref.curves(), soon); }, motion);
      EXPECT_EQ(row_.fault({scene_, subject(run), base_of(run), balls, present}), std::nullopt);
    }
    if (!row_.is_unique) return;
    const auto twin = [&] {
      Simulator simulator;
      simulator.exact_work().set_limit(most_work);
      const auto structures = make_in(simulator, motion);
      const auto& structure = structures.back();
      if (edits != nullptr)
        for (BeadId b = 0; b < scene_.bead_count(); ++b)
          if (edits->is_absent(b)) edits_of(structure->kinetic())->leave_out(b);
      simulator.build();
      simulator.enter_step();
      simulator.run_until(soon);
      return state_now(*structure);
    };
    EXPECT_EQ(state_now(subject(run)), twin());
  }

  const Scene& scene_;
  const LawStructure& row_;
  const StructureSpec& spec_;
  bool judged_;
  std::size_t index_;  // of the structure in its runs
  Counts& counts_;
};

class Laws : public testing::TestWithParam<LawScene> {};

TEST_P(Laws, Hold) {
  const LawScene& family = GetParam();
  const std::uint64_t seeds = rounds(family.seeds) * from_environment("KDS_LAW_SCENES", 1);
  const std::uint64_t first = from_environment("KDS_LAW_SEED", 0);
  const char* const only = std::getenv("KDS_LAW_STRUCTURE");
  std::vector<Counts> counts(law_structures().size());
  int refused = 0;
  for (std::uint64_t seed = first; seed < first + seeds && !HasFailure(); ++seed) {
    std::optional<Scene> scene;
    try {
      scene.emplace(family.make(seed));
    } catch (const InputError&) {
      ++refused;
      continue;
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const LawStructure& row = law_structures()[i];
      const auto& names = family.structures;
      if (!names.empty() && std::find(names.begin(), names.end(), row.name) == names.end()) continue;
      if (only != nullptr && row.name != only) continue;
      if (!family.judged && !row.takes_long_numbers) continue;
      if (scene->bead_count() > from_environment("KDS_LAW_BEADS", row.most_beads)) continue;
      SCOPED_TRACE(family.name + ", seed " + std::to_string(seed) + ", " + row.title());
      try {
        if (structure_registry().find(row.name)->refusal(*scene)) continue;
        static_cast<void>(KineticRun(*scene, {{row.name}, Kernel::filtered, AuditMode::none, row.settings}));
      } catch (const InputError&) {  // too small weights, or no boxes with these directions in the plane
        continue;
      }
      ++counts[i].runs;
      Subject(*scene, row, family.judged, counts[i]).expect_laws(seed);
    }
  }
  if (family.refused) {
    EXPECT_EQ(refused, static_cast<int>(seeds));
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Edits edits = law_structures()[i].edits;
    SCOPED_TRACE(law_structures()[i].title());
    EXPECT_EQ(counts[i].decided > 0, counts[i].runs > 0) << "no scene of the family was decided";
    EXPECT_EQ(counts[i].edited > 0, counts[i].done > 0 && edits != Edits::none) << "no edit was made";
  }
}

TEST(LawTable, HasARowForEachStructure) {
  for (const StructureSpec& spec : structure_registry().all())
    EXPECT_TRUE(std::ranges::any_of(law_structures(), [&](const auto& row) { return row.name == spec.name; }))
        << spec.name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Laws, testing::ValuesIn(law_scenes()), [](const auto& test) {
  std::string name = test.param.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

}  // namespace
}  // namespace kds::laws_test
