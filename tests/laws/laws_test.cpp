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
#include "kds/event_log.h"
#include "kds/known_events.h"
#include "motions/base/input_error.h"
#include "structures/session/parallel_run.h"
#include "tests/laws/law_run.h"
#include "tests/laws/law_scenes.h"
#include "tests/support/inputs/random.h"
#include "tests/support/property_runs.h"
#include "tests/support/rounds.h"

namespace kds::laws_test {
namespace {

using namespace test;

/// Limb operations after which a run is given up. They take about a second for 10^8.
constexpr std::uint64_t most_work = 40'000'000;

/// Ends an outcome as note_ending does. Any other exception than a refusal or the limit of work is a failure.
template <class Run>
void expect_ending(Outcome& outcome, Run run) {
  note_ending(outcome, run);
  EXPECT_FALSE(outcome.failed) << outcome.ending;
}

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
      EXPECT_EQ(difference(audited, plain), std::nullopt);
    }
    const Outcome exact = run(Kernel::exact, AuditMode::none);
    if (exact.is_decided()) {
      SCOPED_TRACE("law 2, kernels");
      EXPECT_EQ(difference(exact, plain), std::nullopt);
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

  [[nodiscard]] Outcome run(Kernel kernel, AuditMode audits) const {
    Outcome outcome = run_scene(scene_, row_, kernel, audits, judged_, most_work);
    EXPECT_FALSE(outcome.failed) << outcome.ending;
    return outcome;
  }

  void expect_parts(const Outcome& whole, std::uint64_t seed) const {
    SCOPED_TRACE("law 3, parts");
    Outcome cut;
    EventLog log;
    bool is_cut = true;
    expect_ending(cut, [&] {
      ParallelRun run(scene_, options(Kernel::filtered, AuditMode::none), {2 + seed % 4, 1 + seed % 3, true});
      is_cut = !run.uncut();
      if (!is_cut) return;
      run.listen(log);
      run.run([&](std::size_t frame) { cut.add_dumps(subject(run.whole()).dump(frame)); });
      cut.add_end(run.simulator(), subject(run.whole()), run.whole().structures()[index_]->statistics);
    });
    if (!is_cut) return;
    cut.events = std::move(log.events);
    EXPECT_EQ(difference(cut, whole), std::nullopt);
  }

  /// Replays events and edits without certificates, which must give this fingerprint. Returns the dumps and
  /// the state.
  [[nodiscard]] Outcome replayed(const std::vector<Event>& log, const std::vector<LoggedEdit>& all_edits,
                                 std::uint64_t fingerprint) const {
    Outcome outcome;
    expect_ending(outcome, [&] {
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
        KnownEvents(simulator).replay_step(
            events, edits, [&](const Edit& edit) { set_coordinates(*motion, edit.beads, edit.coordinates); });
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
    EXPECT_EQ(difference(again.events, log.events), std::nullopt);
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
      expect_ending(outcome, [&] {
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
        EXPECT_EQ(difference(log.events, events), std::nullopt);
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
      if (!is_accepted(*scene, row)) continue;
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
