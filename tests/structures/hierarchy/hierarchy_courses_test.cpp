// Beads of a kinetic wrapped hierarchy change course while time runs: courses are bent, replaced, or made
// equal to another bead's course, at rational and irrational times. Audits over rationals run between all
// events. The slow reference is a hierarchy built on the current curves and run from the start to the present
// time.

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "structures/hierarchy/wrapped_hierarchy.h"
#include "tests/support/inputs/courses.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/rounds.h"

namespace kds::hierarchy_courses_test {
namespace {

using namespace test;

const std::vector<BeadRange> necklaces{{0, 4}, {5, 13}};
constexpr BeadId bead_count = 14;

/// Nine beads rest; one of them moves far away and comes back to its place.
TEST(HierarchyCourses, AllNodesOfABeadAndNoOthersAreRepaired) {
  Points at;
  for (int i = 0; i < 9; ++i) at.push_back({1.0 * i, 0.25 * (i % 3), 0.125 * (i % 2)});
  Rig<WrappedHierarchy<3>, Space> rig(moving(at, at), AuditMode::events, Kernel::filtered,
                                      std::vector<BeadRange>{{0, 8}}, Radii::equal);
  rig.simulator.build();
  rig.simulator.enter_step();
  const auto bases = rig.structure.bases_at(Dyadic(0.0));
  const auto put = [&](double y) {
    rig.simulator.change_motion(std::array<BeadId, 1>{4}, [&] {
      for (int k = 0; k <= 1; ++k) rig.motion.set_coordinate(4, k, 1, y);
    });
  };
  rig.simulator.run_until(Dyadic(0.5));
  put(100);
  for (NodeId node = 0; node < bases.size(); ++node) {
    const BeadRange& range = rig.structure.tree().range(node);
    const bool of_bead = range.first <= 4 && 4 <= range.last;
    EXPECT_EQ(rig.structure.basis(node).contains(4), of_bead) << range.first << "-" << range.last;
    if (!of_bead) {
      EXPECT_EQ(rig.structure.basis(node), bases[node]);
    }
  }
  for (const Event& event : rig.history.events) {
    if (event.change.kind == WrappedHierarchy<3>::changes) continue;
    EXPECT_TRUE(event.change.ids[0] <= 4 && 4 <= event.change.ids[1]);
  }
  put(at[4][1]);
  EXPECT_EQ(rig.structure.bases_at(Dyadic(0.5)), bases);
  rig.simulator.leave_step();
  EXPECT_EQ(rig.structure.audit(Dyadic(1.0)), std::nullopt);
}

TEST(HierarchyCourses, AreReplayed) {
  Random random(11);
  Space motion(bead_count);
  const auto set = [&](BeadId b) {
    for (int k = 0; k <= 1; ++k) {
      for (int axis = 0; axis < 3; ++axis)
        motion.set_coordinate(b, k, axis, 0x1p-16 * pick(random, -(1 << 17), 1 << 17));
      motion.set_radius(b, k, 0.5);
    }
  };
  for (BeadId b = 0; b < bead_count; ++b) set(b);
  Simulator simulator;
  WrappedHierarchy<3> hierarchy(simulator, motion, necklaces, Radii::equal);
  History history;
  simulator.listen(history);
  const Space at_first = motion;
  simulator.build();
  simulator.enter_step();
  for (BeadId b = 0; b < 9 && simulator.run_next(); ++b)
    simulator.change_motion(std::array<BeadId, 1>{b}, [&] { set(b); });
  simulator.leave_step();

  Simulator replay;
  WrappedHierarchy<3> replayed(replay, at_first, necklaces, Radii::equal);
  KnownEvents(replay).build_for_replay();
  std::vector<ReplayedEvent> events;
  for (const Event& e : history.events)
    events.push_back({e.structure_index, e.lower, e.upper, e.change, "the log"});
  KnownEvents(replay).replay_step(events);
  EXPECT_EQ(replay.fingerprint(), simulator.fingerprint());
  for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node)
    EXPECT_EQ(replayed.basis(node), hierarchy.basis(node));

  events.back().change = Change{WrappedHierarchy<3>::changes, 1, {bead_count}};
  EXPECT_THROW(KnownEvents(replay).replay_step(std::span(events).last(1)), std::invalid_argument);
}

TEST(HierarchyCourses, ChangesThatChangeNothingAddNoCertificates) {
  Random random(5);
  const Space motion = random_motion<Space>(random, bead_count, MotionKind::generic);
  Rig<WrappedHierarchy<3>, Space> rig(motion, AuditMode::none, Kernel::filtered, necklaces, Radii::any);
  rig.simulator.build();
  rig.simulator.enter_step();
  rig.simulator.run_until(Dyadic(0.5));
  rig.simulator.change_motion(std::array<BeadId, 1>{3}, [] {});
  const CertificateCounts before = rig.structure.statistics.certificates;
  for (int k = 0; k < 50; ++k) rig.simulator.change_motion(std::array<BeadId, 1>{3}, [] {});
  EXPECT_GT(before.alive, 0U);
  EXPECT_EQ(rig.structure.statistics.certificates.alive, before.alive);
  EXPECT_EQ(rig.structure.statistics.certificates.per_bead_max, before.per_bead_max);
  rig.simulator.leave_step();
}

TEST(HierarchyCourses, ThereMustBeSuchABead) {
  Points at;
  for (int i = 0; i < 4; ++i) at.push_back({1.0 * i, 0, 0});
  Rig<WrappedHierarchy<3>, Space> rig(moving(at, at), AuditMode::none, Kernel::filtered,
                                      std::vector<BeadRange>{{0, 3}}, Radii::equal);
  rig.simulator.build();
  rig.simulator.enter_step();
  EXPECT_THROW(rig.simulator.change_motion(std::array<BeadId, 2>{0, 4}, [] { FAIL(); }),
               std::invalid_argument);
  EXPECT_TRUE(rig.history.events.empty());
  rig.simulator.leave_step();
}

// Chords and roots that are kept of a bead's old course must not serve its new one.
template <class M>
void expect_right_after_each_change_of_course() {
  for (unsigned seed = 0; seed < rounds(20U, 4U); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    M motion(bead_count);
    const auto set_curve = [&](M& curves, BeadId b) {
      for (int k = 0; k <= M::degree; ++k) {
        for (int axis = 0; axis < M::dimension; ++axis)
          curves.set_coordinate(b, k, axis, draw_coordinate(random, Positions::generic));
        curves.set_radius(b, k, 0.125 * (1 + b % 3));
      }
    };
    for (BeadId b = 0; b < bead_count; ++b) set_curve(motion, b);
    Rig<WrappedHierarchy<M::dimension>, M> rig(motion, AuditMode::events, Kernel::filtered, necklaces,
                                               Radii::any);
    const auto change_course = [&] {
      const auto b = static_cast<BeadId>(random() % bead_count);
      const auto next = static_cast<BeadId>((b + 1) % bead_count);
      const ExactTime& now = rig.simulator.now().exact();
      switch (random() % 4) {
        case 0:
          rig.simulator.change_motion(std::array{b}, [&] { set_curve(rig.motion, b); });
          break;
        case 1:  // the next bead joins it
          rig.simulator.change_motion(std::array{b, next}, [&] {
            set_curve(rig.motion, b);
            for (int k = 0; k <= M::degree; ++k)
              for (int axis = 0; axis < M::dimension; ++axis)
                rig.motion.set_coordinate(next, k, axis, rig.motion.coordinate(b, k, axis));
          });
          break;
        case 2:
          if (now.is_dyadic())
            rig.simulator.change_motion(
                std::array{b}, [&, u = now.lower().round_down()] { bend(rig.motion, b, u, random); });
          break;
        default:
          std::array<BeadId, bead_count> all{};
          std::iota(all.begin(), all.end(), BeadId{0});
          rig.simulator.change_motion(all, [&] {
            for (const BeadId each : all) set_curve(rig.motion, each);
          });
      }
    };
    rig.simulator.build();
    rig.simulator.enter_step();
    for (int stand = 0; stand < 12; ++stand) {
      if (rig.simulator.now().lower() <= 0x1p-4 * stand) {
        rig.simulator.run_until(Dyadic(0x1p-4 * stand));
        change_course();
        EXPECT_EQ(rig.structure.audit(Dyadic(0x1p-4 * stand)), std::nullopt);
      }
      if (rig.simulator.run_next()) change_course();
    }
    rig.simulator.leave_step();
  }
}

TEST(HierarchyCourses, OfBallsInThePlane) { expect_right_after_each_change_of_course<BezierMotion<2, 1>>(); }
TEST(HierarchyCourses, OfBallsInSpace) { expect_right_after_each_change_of_course<Space>(); }

}  // namespace
}  // namespace kds::hierarchy_courses_test
