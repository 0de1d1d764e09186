// Beads of a kinetic wrapped hierarchy change course while time runs: courses are bent, replaced, or made
// equal to another bead's course, at rational and irrational times. Audits over rationals run between all
// events. The slow reference is a hierarchy built on the current curves and run from the start to the present
// time.

#include <gmock/gmock.h>

#include <array>
#include <cmath>
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

struct Case {
  Radii radii = Radii::equal;
  Places places = Places::generic;
  Kernel kernel = Kernel::filtered;
};

struct Totals {
  std::uint64_t edits = 0, at_irrational_times = 0, changed_at_once = 0, events = 0;
};

template <class M>
class BentRun {
 public:
  static constexpr int dimension = M::dimension;

  BentRun(unsigned seed, const Case& of, Totals& totals)
      : random_(seed),
        of_(of),
        totals_(totals),
        motion_(bead_count),
        simulator_(AuditMode::events, of.kernel),
        hierarchy_(simulator_, motion_, necklaces, of.radii) {
    for (BeadId b = 0; b < bead_count; ++b) set_curve(b);
    simulator_.listen(history_);
  }

  void run() {
    simulator_.build();
    for (int step = 0; step < 2; ++step) {
      if (step > 0) carry_on(motion_, [&](BeadId b) { set_curve(b); });
      simulator_.enter_step();
      for (int stand = 0; stand < 12; ++stand) {
        const double u = 0x1p-4 * stand;
        if (simulator_.now().lower() <= u) {
          simulator_.run_until(Dyadic(u));
          edit();
          check(u);
        }
        if (!simulator_.run_next()) continue;
        totals_.at_irrational_times += simulator_.now().lower() < simulator_.now().upper() ? 1 : 0;
        edit();
      }
      simulator_.leave_step();
      EXPECT_TRUE(books_balance(hierarchy_.statistics));
    }
    simulator_.finish();
    totals_.events += history_.events.size();
  }

  [[nodiscard]] std::uint64_t fingerprint() const { return simulator_.fingerprint(); }

 private:
  using Hierarchy = WrappedHierarchy<dimension>;

  void set_curve(BeadId b) {
    for (int k = 0; k <= M::degree; ++k) {
      for (int axis = 0; axis < dimension; ++axis)
        motion_.set_coordinate(b, k, axis, draw_place(random_, of_.places));
      motion_.set_radius(b, k, of_.radii == Radii::equal ? 0.5 : 0.125 * (1 + b % 3));
    }
  }
  /// Gives a bead the course of another bead.
  void join(BeadId b, BeadId other) {
    for (int k = 0; k <= M::degree; ++k)
      for (int axis = 0; axis < dimension; ++axis)
        motion_.set_coordinate(b, k, axis, motion_.coordinate(other, k, axis));
  }
  void edit() {
    ++totals_.edits;
    const std::size_t before = history_.events.size();
    const auto b = static_cast<BeadId>(random_() % bead_count);
    const auto next = static_cast<BeadId>((b + 1) % bead_count);
    const ExactTime& now = simulator_.now().exact();
    std::vector<BeadId> beads{b};
    switch (random_() % 5) {
      case 0:
        simulator_.change_motion(beads, [&] { set_curve(b); });
        break;
      case 1:
        if (M::degree > 1 || !now.is_dyadic()) return;
        simulator_.change_motion(beads, [&, u = now.lower().round_down()] { bend(motion_, b, u, random_); });
        break;
      case 2:
        beads = {next, b};
        simulator_.change_motion(beads, [&] {
          set_curve(b);
          join(next, b);
        });
        break;
      case 3:  // the declared change leaves all courses as they are
        simulator_.change_motion(beads, [] {});
        EXPECT_EQ(history_.events.size(), before + 1);
        return;
      default:
        beads.clear();
        for (BeadId all = 0; all < bead_count; ++all) beads.push_back(all);
        simulator_.change_motion(beads, [&] {
          for (const BeadId all : beads) set_curve(all);
        });
    }
    totals_.changed_at_once += history_.events.size() - before - beads.size();
  }

  void check(double u) {
    EXPECT_EQ(hierarchy_.audit(Dyadic(u)), std::nullopt);
    if (of_.places == Places::grid) return;  // several bases are correct
    Simulator simulator;
    Hierarchy twin(simulator, motion_, necklaces, of_.radii);
    simulator.build();
    simulator.enter_step();
    simulator.run_until(Dyadic(u));
    const auto spheres = hierarchy_.bases_at(Dyadic(u)), of_twin = twin.bases_at(Dyadic(u));
    for (NodeId node = 0; node < hierarchy_.tree().node_count(); ++node) {
      if (courses_of(spheres[node]) != courses_of(of_twin[node]))
        ADD_FAILURE() << "another basis of node " << node << " at u = " << u;
    }
  }
  /// Returns the courses of a basis. Among beads with equal courses any bead may be in the basis.
  [[nodiscard]] std::vector<std::array<double, 3>> courses_of(const Basis& basis) const {
    std::vector<std::array<double, 3>> courses;
    for (const BeadId b : basis)
      for (int k = 0; k <= M::degree; ++k) {
        auto& point = courses.emplace_back();
        for (int axis = 0; axis < dimension; ++axis)
          point[static_cast<std::size_t>(axis)] = motion_.coordinate(b, k, axis);
      }
    std::sort(courses.begin(), courses.end());
    return courses;
  }

  Random random_;
  Case of_;
  Totals& totals_;
  M motion_;
  History history_;
  Simulator simulator_;
  Hierarchy hierarchy_;
};

template <class M>
void run_all(const Case& of, unsigned seeds) {
  Totals totals;
  for (unsigned seed = 0; seed < seeds && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    BentRun<M>(seed, of, totals).run();
  }
  EXPECT_GT(totals.edits, 10 * seeds);
  EXPECT_GT(totals.changed_at_once, 10 * seeds);
  EXPECT_GT(totals.events, 20 * seeds);
  if (of.places == Places::generic) {
    EXPECT_GT(totals.at_irrational_times, 5 * seeds);
  }
}

using Plane = BezierMotion<2, 1>;

TEST(HierarchyCourses, EqualRadiiInThePlane) { run_all<Plane>({}, rounds(20U)); }
TEST(HierarchyCourses, EqualRadiiInSpace) { run_all<Space>({}, rounds(20U)); }
TEST(HierarchyCourses, BallsInThePlane) { run_all<Plane>({Radii::any}, rounds(20U)); }
TEST(HierarchyCourses, BallsInSpace) { run_all<Space>({Radii::any}, rounds(20U)); }
TEST(HierarchyCourses, CubicCurves) {
  run_all<BezierMotion<2, 3>>({}, rounds(5U));
  run_all<BezierMotion<3, 2>>({}, rounds(5U));
}
TEST(HierarchyCourses, OnAGrid) {
  run_all<Plane>({Radii::equal, Places::grid}, rounds(20U));
  run_all<Space>({Radii::equal, Places::grid}, rounds(20U));
  run_all<Plane>({Radii::any, Places::grid}, rounds(10U));
  run_all<Space>({Radii::any, Places::grid}, rounds(10U));
}
TEST(HierarchyCourses, KernelsAgree) {
  Totals totals;
  for (const Radii radii : {Radii::equal, Radii::any}) {
    for (unsigned seed = 100; seed < 100 + rounds(5U); ++seed) {
      BentRun<Space> filtered(seed, {radii}, totals),
          exact(seed, {radii, Places::generic, Kernel::exact}, totals);
      filtered.run();
      exact.run();
      EXPECT_EQ(filtered.fingerprint(), exact.fingerprint());
    }
  }
}

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

}  // namespace
}  // namespace kds::hierarchy_courses_test
