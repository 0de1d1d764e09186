// Beads are inserted, erased and change course in several structures on one clock: at rational times, at the
// irrational times of events, and at times with many simultaneous events. The slow reference consists of the
// same structures, built on the present beads and their current curves and run from the start to that time.

#include <gmock/gmock.h>

#include <array>
#include <string>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "motions/base/input_error.h"
#include "motions/numbers/exact_number.h"
#include "structures/chord_cages/chord_hierarchy.h"
#include "structures/contacts/contacts.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/sorted/sorted_list.h"
#include "tests/support/inputs/courses.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/rounds.h"

namespace kds::bead_edits_test {
namespace {

using namespace test;
using testing::HasSubstr;

template <int Dimension>
struct Structures {
  template <class M>
  Structures(Simulator& simulator, const M& motion, std::size_t beads, BeadGroups groups = {})
      : sorted(simulator, motion),
        power(simulator, motion),
        contacts(simulator, motion,
                 {{{0, static_cast<BeadId>(beads - 1)}}, true, 1, true, std::move(groups)}) {}

  [[nodiscard]] std::array<BeadEdits*, 3> all() { return {&sorted, &power, &contacts}; }

  SortedList<Dimension> sorted;
  PowerDiagram<Dimension> power;
  Contacts<Dimension> contacts;
};

template <class M>
void set_curve(M& motion, BeadId b, Random& random, Positions positions) {
  for (int k = 0; k <= M::degree; ++k) {
    for (int axis = 0; axis < M::dimension; ++axis)
      motion.set_coordinate(b, k, axis, draw_coordinate(random, positions));
    const double radius = positions == Positions::grid ? 0.5 : 0.125 * (1 + b % 3);
    motion.set_radius(b, k, radius);
    motion.set_weight(b, k, radius * radius);
  }
}

/// Few beads on a line, two of which meet at an irrational time: bead 0 moves on a parabola and bead 1 rests.
using Parabolas = BezierMotion<1, 2>;
Parabolas parabolas() {
  Parabolas motion(3);
  for (int k = 0; k <= 2; ++k) {
    motion.set_coordinate(0, k, 0, k == 2 ? 1 : 0);  // u^2
    motion.set_coordinate(1, k, 0, 0.5);
    motion.set_coordinate(2, k, 0, 4);
  }
  return motion;
}

TEST(BeadEdits, JustAfterAnEventAtAnIrrationalTime) {
  Rig<SortedList<1>, Parabolas> rig(parabolas(), AuditMode::events);
  rig.simulator.build();
  rig.simulator.enter_step();
  ASSERT_TRUE(rig.simulator.run_next());
  EXPECT_THAT(rig.structure.order(), testing::ElementsAre(1, 0, 2));
  EXPECT_LT(rig.simulator.now().lower(), rig.simulator.now().upper());
  EXPECT_NEAR(rig.simulator.now().lower(), std::sqrt(0.5), 1e-9);
  // Bead 2 arrives from above at the place of the others at exactly this time, so it is first just after it.
  // Bead 0 is declared as changed but does not change.
  rig.simulator.change_motion(std::array<BeadId, 2>{0, 2}, [&] {
    for (int k = 0; k <= 2; ++k) {
      // The coordinate is 1 - u^2, which is 1/2 at that time.
      rig.motion.set_coordinate(2, k, 0, 1 - rig.motion.coordinate(0, k, 0));
    }
  });
  EXPECT_THAT(rig.structure.order(), testing::ElementsAre(2, 1, 0));
  rig.simulator.leave_step();
  EXPECT_EQ(rig.structure.audit(Dyadic(1.0)), std::nullopt);
}

TEST(BeadEdits, ErasedBeadsComeBackWhereTheyAreThen) {
  Rig<SortedList<1>, Parabolas> rig(parabolas(), AuditMode::events);
  rig.structure.leave_out(0);
  rig.structure.leave_out(1);
  rig.structure.leave_out(2);  // no bead is left
  rig.simulator.build();
  rig.simulator.enter_step();
  EXPECT_FALSE(rig.simulator.run_next());
  rig.simulator.run_until(Dyadic(0.875));
  rig.structure.insert(0);
  rig.structure.insert(1);
  EXPECT_THAT(rig.structure.order(), testing::ElementsAre(1, 0));
  rig.structure.erase(1);
  rig.structure.insert(2);
  EXPECT_THAT(rig.structure.order(), testing::ElementsAre(0, 2));
  rig.structure.erase(2);
  rig.structure.erase(0);
  EXPECT_TRUE(rig.structure.order().empty());
  rig.simulator.leave_step();
  EXPECT_EQ(rig.external_events(), 0U);
}

/// Replays inserts and erases of all structures from the log, without certificates.
TEST(BeadEdits, AreReplayed) {
  Random random(7);
  Space motion(12);
  for (BeadId b = 0; b < 12; ++b) set_curve(motion, b, random, Positions::generic);
  Simulator simulator;
  Structures<3> structures(simulator, motion, 12);
  History history;
  simulator.listen(history);
  for (BeadEdits* structure : structures.all()) structure->leave_out(5);
  simulator.build();
  simulator.enter_step();
  for (BeadId b = 0; simulator.run_next(); b = (b + 1) % 12) {
    for (BeadEdits* structure : structures.all()) {
      if (structure->is_absent(b)) {
        structure->insert(b);
      } else if (b % 3 == 0) {
        structure->erase(b);
      }
    }
  }
  simulator.leave_step();
  EXPECT_GT(structures.sorted.statistics.events_by_kind[SortedList<3>::erases], 3U);

  Simulator replay;
  Structures<3> replayed(replay, motion, 12);
  for (BeadEdits* structure : replayed.all()) structure->leave_out(5);
  KnownEvents(replay).build_for_replay();
  std::vector<ReplayedEvent> events;
  for (const Event& e : history.events)
    events.push_back({e.structure_index, e.lower, e.upper, e.change, "the log"});
  KnownEvents(replay).replay_step(events);
  EXPECT_EQ(replay.fingerprint(), simulator.fingerprint());
  EXPECT_EQ(replayed.sorted.order(), structures.sorted.order());
  EXPECT_EQ(replayed.contacts.pairs(), structures.contacts.pairs());
  EXPECT_EQ(replayed.power.at_frame(false).cells, structures.power.at_frame(false).cells);
}

TEST(BeadEdits, BadCallsAreRefusedAndChangeNothing) {
  Random random(3);
  BezierMotion<2, 1> motion(6);
  for (BeadId b = 0; b < 6; ++b) set_curve(motion, b, random, Positions::generic);
  Simulator simulator;
  Structures<2> structures(simulator, motion, 6);
  const std::array<BeadId, 1> third{3}, unknown{6};
  for (BeadEdits* structure : structures.all()) {
    expect_edit_refused([&] { structure->insert(3); }, "bead 3 is");
    expect_edit_refused([&] { structure->leave_out(6); }, "there is no bead 6");
    structure->leave_out(5);
    expect_edit_refused([&] { structure->insert(5); }, "only within a step");
  }
  simulator.build();
  for (BeadEdits* structure : structures.all()) {
    expect_edit_refused([&] { structure->leave_out(3); }, "are left out before");
    expect_edit_refused([&] { structure->erase(3); }, "only within a step");
  }
  expect_edit_refused([&] { simulator.change_motion(third, [] { FAIL(); }); }, "only within a step");
  simulator.enter_step();
  for (BeadEdits* structure : structures.all()) {
    expect_edit_refused([&] { structure->erase(5); }, "bead 5 is not");
    expect_edit_refused([&] { structure->erase(6); }, "there is no bead 6");
  }
  expect_edit_refused([&] { simulator.change_motion(unknown, [] { FAIL(); }); }, "there is no bead 6");
  // A coordinate that is not a number is refused, and the bead keeps its course.
  EXPECT_THROW(simulator.change_motion(third, [&] { motion.set_coordinate(3, 1, 0, std::nan("")); }),
               std::invalid_argument);
  simulator.leave_step();
  expect_edit_refused([&] { structures.sorted.erase(3); }, "only within a step");
}

TEST(BeadEdits, AreRefusedByStructuresThatCannotFollow) {
  Random random(3);
  BezierMotion<2, 1> motion(6);
  for (BeadId b = 0; b < 6; ++b) set_curve(motion, b, random, Positions::generic);
  Simulator simulator;
  const std::vector<BeadRange> necklace{{0, 5}};
  SortedList<2> sorted(simulator, motion);
  const ChordHierarchy<StaticWrappedHierarchy<2>> chords(simulator, motion, necklace);
  simulator.build();
  simulator.enter_step();
  expect_edit_refused([&] { simulator.change_motion(std::array<BeadId, 1>{3}, [] { FAIL(); }); },
                      "wrapped: its beads cannot change course within a step, only between two of them");
  sorted.erase(3);  // this concerns no other structure
  simulator.leave_step();
}

using Plane = BezierMotion<2, 1>;

/// Makes the bead move straight from one place to the other.
void set_line(Plane& motion, BeadId bead, std::array<double, 2> from, std::array<double, 2> to) {
  for (int axis = 0; axis < 2; ++axis) {
    motion.set_coordinate(bead, 0, axis, from[static_cast<std::size_t>(axis)]);
    motion.set_coordinate(bead, 1, axis, to[static_cast<std::size_t>(axis)]);
  }
}

struct ListAndDiagram {
  explicit ListAndDiagram(const Plane& motion) : sorted(simulator, motion), power(simulator, motion) {
    simulator.listen(history);
    simulator.build();
    simulator.enter_step();
  }
  [[nodiscard]] std::uint64_t changes() const {
    return sorted.statistics.events_by_kind[SortedList<2>::changes] +
           power.statistics.events_by_kind[PowerDiagram<2>::changes];
  }

  Simulator simulator{AuditMode::events};
  SortedList<2> sorted;
  PowerDiagram<2> power;
  History history;
};

// Three beads have a diagram, two have none. The beads are not flat before or after the change.
TEST(BeadEdits, ABeadWithoutWhichNoDiagramIsLeftChangesCourse) {
  for (const bool at_event : {false, true}) {
    Plane motion(3);
    set_line(motion, 0, {0, 0}, {3, 0});
    set_line(motion, 1, {1, 1}, {1, 1});
    set_line(motion, 2, {5, 4}, {5, 4});
    ListAndDiagram run(motion);
    if (at_event) {
      ASSERT_TRUE(run.simulator.run_next());
      EXPECT_NEAR(run.simulator.now().lower(), 1.0 / 3, 1e-9);  // not dyadic
    } else {
      run.simulator.run_until(Dyadic(0.25));
    }
    const std::array<BeadId, 1> last{2};
    run.simulator.change_motion(last, [] {});
    EXPECT_EQ(run.power.statistics.rebuilds, 0U);  // the bead does not jump
    run.simulator.change_motion(last, [&] { set_line(motion, 2, {0.5, 4}, {-6, 2}); });
    EXPECT_EQ(run.power.statistics.rebuilds, 1U);
    EXPECT_EQ(run.changes(), 4U);
    run.simulator.leave_step();
    EXPECT_EQ(run.sorted.order().front(), 2U);
  }
}

TEST(BeadEdits, ABeadWithoutWhichAllIsFlatChangesCourseAndIsNotErased) {
  Plane motion(4);
  for (BeadId b = 0; b < 3; ++b) set_line(motion, b, {1.0 * b, 0}, {1.0 * b, 1});
  set_line(motion, 3, {1, 3}, {4, 3});
  ListAndDiagram run(motion);
  run.simulator.run_until(Dyadic(0.5));
  run.simulator.change_motion(std::array<BeadId, 1>{3}, [&] { set_line(motion, 3, {1, -3}, {1, -2}); });
  const std::size_t told = run.history.events.size();
  expect_edit_refused([&] { run.power.erase(3); }, "without bead 3 all beads stay on one line");
  EXPECT_FALSE(run.power.is_absent(3));
  EXPECT_EQ(run.history.events.size(), told);
  run.power.erase(1);
  expect_edit_refused([&] { run.power.erase(0); }, "at least 3 beads");
  run.simulator.leave_step();
}

TEST(BeadEdits, AllStructuresAreAskedBeforeAnyChanges) {
  Plane motion(4);
  for (BeadId b = 0; b < 4; ++b) set_line(motion, b, {1.0 * b, 0}, {3.0 - b, 1});
  ListAndDiagram run(motion);  // all beads on one line
  const std::size_t told = run.history.events.size();
  expect_edit_refused([&] { run.simulator.change_motion(std::array<BeadId, 1>{3}, [] { FAIL(); }); },
                      "in which all beads stay on one line");
  expect_edit_refused([&] { run.power.erase(3); }, "in which all beads stay on one line");
  EXPECT_EQ(run.history.events.size(), told);
  run.simulator.leave_step();
  EXPECT_THAT(run.sorted.order(), testing::ElementsAre(3, 2, 1, 0));
}

TEST(BeadEdits, ABeadNamedTwiceChangesOnce) {
  Random random(3);
  Plane motion(6);
  for (BeadId b = 0; b < 6; ++b) set_curve(motion, b, random, Positions::generic);
  Simulator simulator(AuditMode::events);
  Structures<2> structures(simulator, motion, 6);
  simulator.build();
  simulator.enter_step();
  simulator.change_motion(std::array<BeadId, 4>{3, 3, 1, 3},
                          [&] { set_curve(motion, 3, random, Positions::generic); });
  EXPECT_EQ(structures.sorted.statistics.events_by_kind[SortedList<2>::changes], 2U);
  EXPECT_EQ(structures.power.statistics.events_by_kind[PowerDiagram<2>::changes], 2U);
  EXPECT_EQ(structures.contacts.statistics.events_by_kind[Contacts<2>::changes], 2U);
  simulator.leave_step();
}

/// Edits while an event is being handled, and a listener that throws.
class Meddler final : public EventListener {
 public:
  Meddler(Simulator& simulator, SortedList<1>& list) : simulator_(simulator), list_(list) {}
  void on_event(const Event&) override {
    expect_edit_refused([&] { list_.erase(2); }, "between events");
    EXPECT_THROW(static_cast<void>(simulator_.run_next()), std::logic_error);
    if (throws) throw std::runtime_error("enough");
  }
  bool throws = false;

 private:
  Simulator& simulator_;
  SortedList<1>& list_;
};

TEST(BeadEdits, AreNotForListenersAndAListenerThatThrowsEndsTheRun) {
  for (const bool throws : {false, true}) {
    Rig<SortedList<1>, Parabolas> rig(parabolas());
    Meddler meddler(rig.simulator, rig.structure);
    meddler.throws = throws;
    rig.simulator.listen(meddler);
    rig.simulator.build();
    if (!throws) {
      rig.simulator.run_step();
      rig.simulator.enter_step();  // the next step runs as usual
      rig.structure.erase(0);      // an edit that notifies the listener again
      rig.simulator.leave_step();
      EXPECT_EQ(rig.history.events.size(), 2U + 1U);
      continue;
    }
    EXPECT_THROW(rig.simulator.run_step(), std::runtime_error);
    EXPECT_EQ(rig.history.events.size(), 1U);
    EXPECT_THROW(rig.simulator.run_step(), std::logic_error);
    expect_edit_refused([&] { rig.structure.erase(2); }, "between events");
  }
}

}  // namespace
}  // namespace kds::bead_edits_test
