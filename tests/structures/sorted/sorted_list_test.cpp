#include "structures/sorted/sorted_list.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "motions/curves/positions.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::sorted_list_test {
namespace {

using namespace test;

using Line = BezierMotion<1, 1>;
template <Motion M>
using SortedRig = Rig<SortedList<M::dimension>, M>;

Line moving_on_a_line(const std::vector<double>& from, const std::vector<double>& to) {
  Line motion(from.size());
  for (BeadId b = 0; b < from.size(); ++b) {
    motion.set_coordinate(b, 0, 0, from[b]);
    motion.set_coordinate(b, 1, 0, to[b]);
  }
  return motion;
}

/// Returns the times at which pairs trade places strictly inside the step. In linear motion each pair does so
/// at most once.
std::map<std::pair<BeadId, BeadId>, Rational> crossings(const Line& motion) {
  std::map<std::pair<BeadId, BeadId>, Rational> times;
  for (BeadId a = 0; a < motion.bead_count(); ++a) {
    for (BeadId b = a + 1; b < motion.bead_count(); ++b) {
      const Rational start = Rational(motion.coordinate(b, 0, 0)) - Rational(motion.coordinate(a, 0, 0));
      const Rational end = Rational(motion.coordinate(b, 1, 0)) - Rational(motion.coordinate(a, 1, 0));
      if (sgn(start) * sgn(end) < 0) times[{a, b}] = start / (start - end);
    }
  }
  return times;
}

/// Each crossing must be reported once, in order of time.
void expect_all_crossings(const Line& motion, Kernel kernel = Kernel::filtered) {
  SortedRig<Line> rig(motion, AuditMode::events, kernel);
  ASSERT_NO_THROW(rig.run());
  auto expected = crossings(motion);
  Rational before = 0;
  for (const Event& event : rig.history.events) {
    const auto [low, high] = std::minmax(event.change.ids[0], event.change.ids[1]);
    const auto found = expected.find({low, high});
    ASSERT_NE(found, expected.end()) << "beads " << low << " and " << high << " do not cross, or not again";
    EXPECT_LE(Rational(event.lower), found->second);
    EXPECT_GE(Rational(event.upper), found->second);
    EXPECT_LE(before, found->second);
    before = found->second;
    expected.erase(found);
  }
  EXPECT_TRUE(expected.empty()) << expected.size() << " crossings were missed";
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  const auto& order = rig.structure.order();
  for (std::size_t i = 0; i + 1 < order.size(); ++i)
    EXPECT_LE(motion.coordinate(order[i], 1, 0), motion.coordinate(order[i + 1], 1, 0));
}

TEST(SortedList, SmallAndSimple) {
  expect_all_crossings(moving_on_a_line({0, 1, 2}, {2, 1, 0}));  // all beads meet in one point
  expect_all_crossings(moving_on_a_line({0, 1, 2, 3}, {3, 2, 1, 0}));
  expect_all_crossings(moving_on_a_line({0, 1, 2, 3, 4, 5, 6}, {6, 5, 4, 3, 2, 1, 0}));
  expect_all_crossings(moving_on_a_line({0, 1}, {1, 0}));
  // Two beads meet at the end, which is not yet an event.
  expect_all_crossings(moving_on_a_line({0, 1}, {1, 1}));
  expect_all_crossings(moving_on_a_line({1, 1}, {1, 0}));        // two beads part at the start
  expect_all_crossings(moving_on_a_line({1, 1, 0}, {1, 1, 2}));  // one bead passes two that move together
  expect_all_crossings(moving_on_a_line({3}, {4}));
}

TEST(SortedList, FourBeadsThatMeetAtOnce) {
  // Every order of arrival.
  std::vector<double> to{-3, -1, 1, 3};
  do {
    std::vector<double> from;
    for (const double x : to) from.push_back(-x);
    expect_all_crossings(moving_on_a_line(from, to));
  } while (std::next_permutation(to.begin(), to.end()));
}

TEST(SortedList, RandomMotionsFullOfTies) {
  std::mt19937 random(7);
  for (int round = 0; round < test::rounds(400); ++round) {
    const std::size_t beads = 2 + random() % 12;
    const unsigned range = 2 + static_cast<unsigned>(random() % 7);
    std::vector<double> from, to;
    for (std::size_t b = 0; b < beads; ++b) {
      from.push_back(static_cast<double>(random() % range));
      to.push_back(static_cast<double>(random() % range));
    }
    SCOPED_TRACE(
        text_of("round ", round, ": ", testing::PrintToString(from), " to ", testing::PrintToString(to)));
    const Line motion = moving_on_a_line(from, to);
    expect_all_crossings(motion);
    if (round % 4 == 0) expect_all_crossings(motion, Kernel::exact);
    if (HasFailure()) return;
  }
}

// The next step's motion decides events that happen exactly at a frame.
TEST(SortedList, RandomFramesFullOfTies) {
  std::mt19937 random(8);
  for (int round = 0; round < test::rounds(200); ++round) {
    const std::size_t beads = 2 + random() % 9;
    const unsigned range = 2 + static_cast<unsigned>(random() % 6);
    std::vector<std::vector<double>> frames(5);
    std::string trace = text_of("round ", round, ":");
    for (auto& frame : frames) {
      for (std::size_t b = 0; b < beads; ++b) frame.push_back(static_cast<double>(random() % range));
      trace += text_of(" ", testing::PrintToString(frame));
    }
    SCOPED_TRACE(trace);
    std::vector<Line> steps;
    for (std::size_t k = 0; k + 1 < frames.size(); ++k)
      steps.push_back(moving_on_a_line(frames[k], frames[k + 1]));
    SortedRig<Line> filtered(steps.front(), AuditMode::events);
    EXPECT_NO_THROW(filtered.run(steps));
    SortedRig<Line> exact(steps.front(), AuditMode::events, Kernel::exact);
    EXPECT_NO_THROW(exact.run(steps));
    EXPECT_EQ(filtered.simulator.fingerprint(), exact.simulator.fingerprint());
    EXPECT_TRUE(books_balance(filtered.structure.statistics));
    // No work is wasted: within a step no pair trades places twice.
    for (std::size_t k = 0; k < steps.size(); ++k) {
      std::map<std::pair<BeadId, BeadId>, int> times;
      for (const Event& e : filtered.history.of_step(k)) {
        const auto [low, high] = std::minmax(e.change.ids[0], e.change.ids[1]);
        EXPECT_EQ(++times[std::pair(low, high)], 1) << low << " " << high << " in step " << k;
      }
    }
    if (HasFailure()) return;
  }
}

// Two adjacent pairs cross at a frame; then a third neighbour crosses once.
TEST(SortedList, CrossingsAtAFrameLeaveNoCertificateBehind) {
  const std::vector<std::vector<double>> frames{{0, 2, 4}, {1, 1, 4}, {2, 0, 1}};
  std::vector<Line> steps;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k)
    steps.push_back(moving_on_a_line(frames[k], frames[k + 1]));
  SortedRig<Line> rig(steps.front(), AuditMode::events);
  ASSERT_NO_THROW(rig.run(steps));
  EXPECT_THAT(rig.structure.order(), testing::ElementsAre(1, 2, 0));
  EXPECT_EQ(rig.external_events(), 2U);
  EXPECT_TRUE(books_balance(rig.structure.statistics));
}

TEST(SortedList, DoesNothingForATranslation) {
  std::vector<double> from, to;
  for (int i = 0; i < 50; ++i) {
    from.push_back(i * 37 % 50);
    to.push_back(from.back() + 1000);
  }
  SortedRig<Line> rig(moving_on_a_line(from, to));
  rig.run();
  EXPECT_EQ(rig.history.events.size(), 0U);
  EXPECT_EQ(rig.structure.statistics.certificates.created, 49U);
  EXPECT_EQ(rig.structure.statistics.certificates.never_failing, 49U);
}

TEST(SortedList, AuditsNoticeEveryWrongOrder) {
  SortedRig<Line> rig(moving_on_a_line({0, 1, 2, 3}, {0, 1, 2, 3}));
  rig.run();
  for (BeadId b = 0; b < 3; ++b) {
    EXPECT_EQ(rig.structure.audit(Dyadic(0.5)), std::nullopt);
    rig.structure.apply({0, 2, {b, b + 1}});
    for (const double time : {0.0, 0.5, 1.0}) EXPECT_NE(rig.structure.audit(Dyadic(time)), std::nullopt);
    rig.structure.apply({0, 2, {b + 1, b}});
  }
}

TEST(SortedList, RefusesChangesThatCannotBe) {
  SortedRig<Line> rig(moving_on_a_line({0, 1, 2}, {0, 1, 2}));
  rig.run();
  EXPECT_THROW(rig.structure.apply({0, 2, {0, 2}}), std::invalid_argument);
  EXPECT_THROW(rig.structure.apply({0, 2, {1, 0}}), std::invalid_argument);
  EXPECT_THROW(rig.structure.apply({0, 2, {2, 3}}), std::invalid_argument);
  EXPECT_THROW(rig.structure.apply({0, 2, {7, 1}}), std::invalid_argument);
  rig.structure.apply({0, 2, {1, 2}});
  EXPECT_THAT(rig.structure.order(), testing::ElementsAre(0, 2, 1));
}

// The instances of data/kinetic, compared with the counts of CGAL's kinetic package (see the README there).

struct Instance1 {
  std::string name;
  std::uint64_t events;
};
void PrintTo(const Instance1& instance, std::ostream* out) { *out << instance.name; }

class SortedInstance : public testing::TestWithParam<Instance1> {
 protected:
  template <class M>
  void check() {
    const M motion = instance_motion<M>(GetParam().name);
    const bool small = motion.bead_count() <= 50;
    SortedRig<M> filtered(motion, small ? AuditMode::events : AuditMode::frames);
    filtered.run();
    EXPECT_EQ(filtered.history.events.size(), GetParam().events);
    EXPECT_EQ(filtered.external_events(), GetParam().events);
    EXPECT_TRUE(books_balance(filtered.structure.statistics));
    EXPECT_EQ(filtered.structure.statistics.certificates.failed, GetParam().events);
    SortedRig<M> replayed(motion, AuditMode::frames);
    replayed.replay({motion}, filtered.history);
    EXPECT_EQ(replayed.simulator.fingerprint(), filtered.simulator.fingerprint());
    EXPECT_EQ(replayed.structure.order(), filtered.structure.order());
    if (!small) return;
    SortedRig<M> exact(motion, AuditMode::events, Kernel::exact);
    exact.run();
    EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
    EXPECT_EQ(exact.structure.statistics.stages.coefficients + exact.structure.statistics.stages.isolation,
              0U);
  }
};

TEST_P(SortedInstance, HasTheEventsOfCgal) {
  if (GetParam().name.find("degree2") != std::string::npos) {
    check<BezierMotion<1, 2>>();
  } else if (GetParam().name.find("degree3") != std::string::npos) {
    check<BezierMotion<1, 3>>();
  } else {
    check<Line>();
  }
}

INSTANTIATE_TEST_SUITE_P(Data, SortedInstance,
                         testing::Values(Instance1{"d1_n20_linear", 97}, Instance1{"d1_n50_linear", 671},
                                         Instance1{"d1_n100_linear", 2743},
                                         Instance1{"d1_n200_linear", 10183},
                                         Instance1{"d1_n500_linear", 64078}, Instance1{"d1_n20_degree2", 171},
                                         Instance1{"d1_n50_degree2", 896}, Instance1{"d1_n100_degree2", 3735},
                                         Instance1{"d1_n20_degree3", 213}, Instance1{"d1_n50_degree3", 1254},
                                         Instance1{"d1_n100_degree3", 4791}),
                         [](const auto& test) { return test.param.name; });

// Every event creates certificates at their own root. The double stages must decide them.
TEST(SortedList, TheExactStageIsRareInGeneralPosition) {
  const auto check = [](const auto& motion) {
    SortedRig<std::decay_t<decltype(motion)>> rig(motion);
    rig.run();
    EXPECT_LT(rig.structure.statistics.stages.exact, rig.structure.statistics.certificates.created / 100);
  };
  check(instance_motion<Line>("d1_n100_linear"));
  check(instance_motion<BezierMotion<1, 3>>("d1_n100_degree3"));
}

// A structure that uses one axis of a motion in space.
TEST(SortedList, SortsAlongTheFirstAxis) {
  const auto motion = instance_motion<Space>("degenerate_d3_n64_gridint");
  SortedRig<Space> rig(motion, AuditMode::events);
  ASSERT_NO_THROW(rig.run());
  EXPECT_GT(rig.history.events.size(), 0U);
  SortedRig<Space> exact(motion, AuditMode::events, Kernel::exact);
  ASSERT_NO_THROW(exact.run());
  EXPECT_EQ(exact.simulator.fingerprint(), rig.simulator.fingerprint());
}

}  // namespace
}  // namespace kds::sorted_list_test
