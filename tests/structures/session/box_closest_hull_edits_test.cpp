// Single edits of the enclosing box, the closest pair and the convex hull: the changes that they report,
// their cost, and the edits that are refused.

#include <gmock/gmock.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "structures/box/enclosing_box.h"
#include "structures/closest/kinetic_closest_pair.h"
#include "structures/hull/convex_hull.h"
#include "tests/support/inputs/courses.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/text_of.h"

namespace kds::box_closest_hull_edits_test {
namespace {

using namespace test;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Beads = std::vector<BeadId>;
using Plane = BezierMotion<2, 1>;

Plane at_rest(const std::vector<std::array<double, 2>>& places) {
  Plane motion(places.size());
  for (BeadId b = 0; b < places.size(); ++b)
    for (int k = 0; k <= 1; ++k)
      for (int axis = 0; axis < 2; ++axis)
        motion.set_coordinate(b, k, axis, places[b][static_cast<std::size_t>(axis)]);
  return motion;
}

/// Returns the reported changes in order, as lines such as "insert 3" and "min-x 4294967295 3".
std::vector<std::string> told(const History& history) {
  std::vector<std::string> lines;
  for (const Event& e : history.events) {
    lines.emplace_back(e.kind.name);
    for (std::size_t i = 0; i < e.change.size; ++i) {
      const BeadId id = e.change.ids[i];
      lines.back() += id == no_bead ? " -" : text_of(" ", id);
    }
  }
  return lines;
}

template <class Structure>
struct Standing : Rig<Structure, Plane> {
  Standing(const Plane& first, const Beads& left_out) : Rig<Structure, Plane>(first, AuditMode::events) {
    for (const BeadId b : left_out) this->structure.leave_out(b);
    this->simulator.build();
    this->simulator.enter_step();
    this->simulator.run_until(Dyadic(0.25));
  }
};

TEST(BoxClosestHullEdits, ABoxOfNoneOfSomeAndOfNone) {
  Standing<EnclosingBox<2>> rig(at_rest({{0, 0}, {1, -1}}), {0, 1});
  EXPECT_THAT(rig.structure.ends(), Each(no_bead));
  rig.structure.insert(1);
  EXPECT_THAT(rig.structure.ends(), Each(1U));
  rig.structure.insert(0);
  EXPECT_THAT(rig.structure.ends(), ElementsAre(0, 1, 1, 0));
  rig.structure.erase(1);
  rig.structure.erase(0);
  EXPECT_THAT(rig.structure.ends(), Each(no_bead));
  EXPECT_THAT(told(rig.history),
              ElementsAre("insert 1", "min-x - 1", "max-x - 1", "min-y - 1", "max-y - 1",  //
                          "insert 0", "min-x 1 0", "max-y 1 0",                            //
                          "erase 1", "max-x 1 0", "min-y 1 0",                             //
                          "erase 0", "min-x 0 -", "max-x 0 -", "min-y 0 -", "max-y 0 -"));
  rig.simulator.leave_step();
}

TEST(BoxClosestHullEdits, AClosestPairOfNoneOfSomeAndOfNone) {
  Standing<KineticClosestPair<2>> rig(at_rest({{0, 0}, {4, 0}, {5, 0}}), {0, 1, 2});
  for (const BeadId b : {0U, 1U, 2U}) rig.structure.insert(b);
  for (const BeadId b : {1U, 2U, 0U}) rig.structure.erase(b);
  EXPECT_THAT(told(rig.history),
              ElementsAre("insert 0", "insert 1", "replace - - 0 1", "insert 2", "replace 0 1 1 2",  //
                          "erase 1", "replace 1 2 0 2", "erase 2", "replace 0 2 - -", "erase 0"));
  EXPECT_EQ(rig.structure.pair(), std::nullopt);
  rig.simulator.leave_step();
}

TEST(BoxClosestHullEdits, AHullOfNoneOfSomeAndOfNone) {
  Standing<ConvexHull> rig(at_rest({{0, 0}, {4, 0}, {0, 4}, {1, 1}}), {0, 1, 2, 3});
  for (const BeadId b : {3U, 0U, 1U, 2U}) rig.structure.insert(b);
  EXPECT_THAT(rig.structure.corners(), ElementsAre(0, 1, 2));
  for (const BeadId b : {1U, 0U, 2U, 3U}) rig.structure.erase(b);
  EXPECT_THAT(rig.structure.corners(), IsEmpty());
  EXPECT_THAT(told(rig.history),
              ElementsAre("insert 3", "enter 3 3 3", "insert 0", "enter 0 3 3", "insert 1", "enter 1 0 3",
                          "insert 2", "leave 3 1 0", "enter 2 1 0",  //
                          "erase 1", "leave 1 0 2", "enter 3 0 2", "erase 0", "leave 0 2 3", "erase 2",
                          "leave 2 3 3", "erase 3", "leave 3 3 3"));
  rig.simulator.leave_step();
}

// A bead on a parabola overtakes a bead at rest at an irrational time. Beads are inserted at exactly that
// time.
TEST(BoxClosestHullEdits, JustAfterAnEventAtAnIrrationalTime) {
  using Parabola = BezierMotion<1, 2>;
  Parabola motion(4);
  for (int k = 0; k <= 2; ++k) {
    motion.set_coordinate(0, k, 0, k == 2 ? 1 : 0);      // u^2
    motion.set_coordinate(1, k, 0, 0.5);                 // equal to bead 0 at that time
    motion.set_coordinate(2, k, 0, k == 2 ? 1.5 : 0.5);  // 1/2 + u^2: never equal to the others
    motion.set_coordinate(3, k, 0, k == 2 ? 0 : 1);      // 1 - u^2: equal to bead 0 at that time
  }
  Rig<EnclosingBox<1>, Parabola> rig(motion, AuditMode::events);
  for (const BeadId b : {2U, 3U}) rig.structure.leave_out(b);
  rig.simulator.build();
  rig.simulator.enter_step();
  EXPECT_THAT(rig.structure.ends(), ElementsAre(0, 1));
  ASSERT_TRUE(rig.simulator.run_next());
  EXPECT_FALSE(rig.simulator.now().exact().is_dyadic());
  EXPECT_THAT(rig.structure.ends(), ElementsAre(1, 0));
  rig.structure.insert(3);
  EXPECT_THAT(rig.structure.ends(), ElementsAre(3, 0));
  rig.structure.erase(0);
  EXPECT_THAT(rig.structure.ends(), ElementsAre(3, 1));
  rig.structure.insert(0);
  rig.structure.insert(2);
  EXPECT_THAT(rig.structure.ends(), ElementsAre(3, 2));
  rig.simulator.change_motion(Beads{2, 3}, [&] {
    for (int k = 0; k <= 2; ++k) {
      rig.motion.set_coordinate(2, k, 0, 0.25);
      rig.motion.set_coordinate(3, k, 0, k == 2 ? 1 : 0);  // equal to bead 0 from now on
    }
  });
  EXPECT_THAT(rig.structure.ends(), ElementsAre(2, 0));
  rig.simulator.leave_step();
}

TEST(BoxClosestHullEdits, ABeadOfABoxCostsACertificateALevel) {
  Rig<EnclosingBox<3>, Space> rig(instance_motion<Space>("d3_n500_linear"));
  rig.simulator.build();
  rig.simulator.enter_step();
  rig.simulator.run_until(Dyadic(0.5));
  const std::uint64_t& created = rig.structure.statistics.certificates.created;
  for (const BeadId b : {0U, 17U, 499U}) {
    const std::uint64_t before = created;
    rig.structure.erase(b);
    rig.structure.insert(b);
    rig.simulator.change_motion(Beads{b}, [] {});
    // The bound: three edits, six ends, nine levels of the tournament, and two certificates at each.
    EXPECT_LE(created - before, 3 * 6 * 2 * 9U);
  }
  rig.simulator.leave_step();
}

TEST(BoxClosestHullEdits, ABeadInTheMidstOfAHullThatGoesCostsNothing) {
  Standing<ConvexHull> rig(at_rest({{0, 0}, {9, 0}, {0, 9}, {1, 1}, {2, 1}}), {});
  const std::uint64_t before = rig.structure.statistics.certificates.created;
  rig.structure.erase(3);
  EXPECT_EQ(rig.structure.statistics.certificates.created, before);
  rig.structure.insert(3);
  EXPECT_LT(rig.structure.statistics.certificates.created, before + 20);
  rig.simulator.leave_step();
}

TEST(BoxClosestHullEdits, ABeadThatIsNeverOfTheClosestPairCostsNoCertificate) {
  Standing<KineticClosestPair<2>> rig(at_rest({{0, 0}, {1, 0}, {0, 1}, {9, 9}}), {});
  const std::uint64_t before = rig.structure.statistics.certificates.created;
  rig.structure.erase(3);
  rig.structure.insert(3);
  EXPECT_EQ(rig.structure.statistics.certificates.created, before);
  rig.simulator.leave_step();
}

struct Structures {
  Structures(Simulator& simulator, const Plane& motion)
      : box(simulator, motion), closest(simulator, motion), hull(simulator, motion) {}

  /// Each structure, and its edits.
  [[nodiscard]] std::array<std::pair<KineticStructure*, BeadEdits*>, 3> all() {
    return {{{&box, &box}, {&closest, &closest}, {&hull, &hull}}};
  }

  EnclosingBox<2> box;
  KineticClosestPair<2> closest;
  ConvexHull hull;
};

TEST(BoxClosestHullEdits, BadCallsAreRefusedAndChangeNothing) {
  const Plane motion = at_rest({{0, 0}, {4, 0}, {0, 4}, {1, 1}, {3, 2}, {2, 2}});
  Simulator simulator(AuditMode::events);
  Structures structures(simulator, motion);
  History history;
  simulator.listen(history);
  for (const auto& [structure, edits] : structures.all()) {
    const std::string name(structure->name());
    expect_edit_refused([&] { edits->insert(3); }, (name + ": bead 3 is among its beads already").c_str());
    expect_edit_refused([&] { edits->leave_out(6); }, "there is no bead 6");
    edits->leave_out(5);
    expect_edit_refused([&] { edits->leave_out(5); }, (name + ": bead 5 is not among its beads").c_str());
    expect_edit_refused([&] { edits->insert(5); }, "only within a step");
  }
  simulator.build();
  for (const auto& [structure, edits] : structures.all()) {
    expect_edit_refused([&] { edits->leave_out(3); }, "its beads are left out before it is built");
    expect_edit_refused([&] { edits->erase(3); }, "only within a step");
  }
  simulator.enter_step();
  for (const auto& [structure, edits] : structures.all()) {
    expect_edit_refused([&] { edits->erase(5); }, "bead 5 is not among its beads");
    expect_edit_refused([&] { edits->insert(3); }, "bead 3 is among its beads already");
    expect_edit_refused([&] { edits->erase(6); }, "there is no bead 6");
    expect_edit_refused([&] { edits->insert(no_bead); }, "there is no bead");
  }
  expect_edit_refused([&] { simulator.change_motion(Beads{3, 6}, [] { FAIL(); }); }, "there is no bead 6");
  EXPECT_THAT(history.events, IsEmpty());
  for (const auto& [structure, edits] : structures.all())
    for (BeadId b = 0; b < 6; ++b) EXPECT_EQ(edits->is_absent(b), b == 5) << structure->name();
  EXPECT_THAT(structures.box.ends(), ElementsAre(0, 1, 0, 2));
  EXPECT_THAT(structures.hull.corners(), ElementsAre(0, 1, 4, 2));
  simulator.leave_step();
  expect_edit_refused([&] { structures.box.erase(3); }, "only within a step");
}

TEST(BoxClosestHullEdits, ChangesOfALogThatCannotBeAreRefused) {
  const Plane motion = at_rest({{0, 0}, {4, 0}, {0, 4}, {1, 1}});
  Simulator simulator;
  Structures structures(simulator, motion);
  for (const auto& [structure, edits] : structures.all()) edits->leave_out(3);
  KnownEvents(simulator).build_for_replay();
  const auto refused = [&](KineticStructure& structure, const Change& change) {
    EXPECT_THROW(structure.apply(change), std::invalid_argument) << static_cast<int>(change.kind);
  };
  using Box = EnclosingBox<2>;
  using Closest = KineticClosestPair<2>;
  for (const auto& [structure, inserts] :
       {std::pair<KineticStructure*, std::uint8_t>{&structures.box, Box::inserts},
        {&structures.closest, Closest::inserts},
        {&structures.hull, ConvexHull::inserts}}) {
    const auto erases = static_cast<std::uint8_t>(inserts + 1),
               changes = static_cast<std::uint8_t>(inserts + 2);
    refused(*structure, {inserts, 1, {2}});
    refused(*structure, {inserts, 1, {4}});
    refused(*structure, {erases, 1, {3}});
    refused(*structure, {changes, 1, {3}});
  }
  refused(structures.box, {Box::first_end, 2, {0, 3}});
  refused(structures.box, {Box::first_end, 2, {0, no_bead}});
  refused(structures.box, {Box::overtake, 2, {0, 3}});
  refused(structures.closest, {Closest::replace, 4, {0, 1, 0, 3}});
  refused(structures.closest, {Closest::replace, 4, {0, 1, no_bead, no_bead}});
  refused(structures.closest, {Closest::overtake, 4, {0, 3, 0, 1}});
  refused(structures.hull, {ConvexHull::enter, 3, {3, 1, 2}});
  refused(structures.hull, {ConvexHull::interchange, 2, {0, 3}});
  for (const auto& [structure, edits] : structures.all())
    EXPECT_EQ(structure->audit(Dyadic(0.5)), std::nullopt);
}

TEST(BoxClosestHullEdits, AuditsLookAtThePresentAlone) {
  const Plane motion = at_rest({{0, 0}, {4, 0}, {0, 4}, {1, 1}});
  Simulator simulator;
  Structures structures(simulator, motion);
  KnownEvents(simulator).build_for_replay();
  structures.box.apply({EnclosingBox<2>::erases, 1, {1}});
  structures.closest.apply({KineticClosestPair<2>::erases, 1, {3}});
  structures.hull.apply({ConvexHull::erases, 1, {1}});
  for (const auto& [structure, edits] : structures.all())
    EXPECT_NE(structure->audit(Dyadic(0.5)), std::nullopt);
  structures.box.apply({EnclosingBox<2>::first_end + 1, 2, {1, 3}});
  structures.closest.apply({KineticClosestPair<2>::replace, 4, {0, 3, 0, 1}});
  structures.hull.apply({ConvexHull::leave, 3, {1, 0, 2}});
  structures.hull.apply({ConvexHull::enter, 3, {3, 0, 2}});
  for (const auto& [structure, edits] : structures.all())
    EXPECT_EQ(structure->audit(Dyadic(0.5)), std::nullopt);
}

}  // namespace
}  // namespace kds::box_closest_hull_edits_test
