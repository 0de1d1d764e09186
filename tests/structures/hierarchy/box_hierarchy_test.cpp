// The kinetic hierarchy of boxes, in the plane and in space, for equal and unequal radii. Audits run between
// all events, and brute force over rationals judges each audit.

#include "structures/hierarchy/box_hierarchy.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "motions/curves/lifted_motion.h"
#include "structures/box/enclosing_box.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/enclosing_ball.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::box_hierarchy_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

template <class M>
using BoxesRig = Rig<BoxHierarchy<M::dimension>, M>;
using Ranges = std::vector<BeadRange>;

Ranges one_necklace(std::size_t beads) { return {{0, static_cast<BeadId>(beads - 1)}}; }

/// Returns whether a + b sqrt(square) is positive.
bool is_positive(const Rational& a, const Rational& b, int square) {
  if (a >= 0 && b >= 0) return a > 0 || b > 0;
  if (a <= 0 && b <= 0) return false;
  return a > 0 ? a * a > square * b * b : square * b * b > a * a;
}

/// Explains which support is not the furthest bead of its node, or returns nothing.
template <class M>
std::optional<std::string> fault_of(const BoxHierarchy<M::dimension>& boxes, const M& motion, Radii radii,
                                    const Dyadic& time) {
  std::vector<Ball> balls;
  for (BeadId b = 0; b < motion.bead_count(); ++b) balls.push_back(ball_at(motion, b, time));
  for (NodeId node = 0; node < boxes.tree().node_count(); ++node) {
    if (!boxes.keeps(node)) continue;
    const auto [first, last] = boxes.tree().range(node);
    for (std::uint32_t side = 0; side < boxes.side_count(); ++side) {
      const SlabDirection& direction = boxes.directions()[side / 2];
      const BeadId support = boxes.supports(node)[side];
      if (support < first || last < support) return text_of("bead ", support, " is not below the node");
      for (BeadId b = first; b <= last; ++b) {
        Rational along = 0;
        for (std::size_t axis = 0; axis < M::dimension; ++axis)
          along += direction.steps[axis] * (balls[b].center[axis] - balls[support].center[axis]);
        if (side % 2 == 0) along = -along;
        const Rational larger = radii == Radii::equal ? 0 : Rational(balls[b].radius - balls[support].radius);
        if (is_positive(along, larger, direction.square()))
          return text_of("node ", first, "-", last, ", side ", side, ": bead ", b, " is beyond ", support);
      }
    }
  }
  return std::nullopt;
}

template <class M>
History expect_right(const std::vector<M>& steps, const Ranges& necklaces, Radii radii, int directions,
                     const NodeSelection& nodes = {}) {
  BoxesRig<M> rig(steps.front(), AuditMode::events, necklaces, radii, directions, nodes);
  const Witness witness(rig.simulator,
                        [&](const Dyadic& time) { return fault_of(rig.structure, rig.motion, radii, time); });
  EXPECT_NO_THROW(rig.run(steps));
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  BoxesRig<M> exact(steps.front(), AuditMode::none, Kernel::exact, necklaces, radii, directions, nodes);
  exact.run(steps);
  EXPECT_EQ(exact.simulator.fingerprint(), rig.simulator.fingerprint());
  BoxesRig<M> again(steps.front(), AuditMode::frames, necklaces, radii, directions, nodes);
  EXPECT_NO_THROW(again.replay(steps, rig.history));
  EXPECT_EQ(again.simulator.fingerprint(), rig.simulator.fingerprint());
  return rig.history;
}

/// Makes the next step of random motion, which starts at the end of the previous one.
template <class M>
M next_step(Random& random, const M& before, MotionKind kind) {
  M next = random_motion<M>(random, before.bead_count(), kind);
  for (BeadId b = 0; b < before.bead_count(); ++b) {
    for (int axis = 0; axis < M::dimension; ++axis)
      next.set_coordinate(b, 0, axis, before.coordinate(b, M::degree, axis));
    next.set_radius(b, 0, before.radius(b, M::degree));
  }
  return next;
}

template <class M>
std::size_t try_random_motions(unsigned seed, Radii radii, std::size_t most_beads) {
  Random random(seed);
  std::size_t events = 0;
  const std::span<const int> counts = box_direction_counts<M::dimension>();
  for (std::size_t round = 0; round < static_cast<std::size_t>(rounds(2)); ++round) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(text_of("kind ", static_cast<int>(kind), ", round ", round));
      const std::size_t beads = 1 + random() % most_beads;
      std::vector<M> steps{random_motion<M>(random, beads, kind)};
      steps.push_back(next_step(random, steps.front(), kind));
      Ranges necklaces = one_necklace(beads);
      if (beads > 2 && round % 2 == 1) necklaces = {{0, 0}, {1, static_cast<BeadId>(beads - 1)}};
      events += expect_right(steps, necklaces, radii,
                             counts[(round + static_cast<std::size_t>(kind)) % counts.size()])
                    .events.size();
      if (testing::Test::HasFailure()) return events;
    }
  }
  return events;
}

TEST(BoxHierarchy, PointsInThePlane) {
  EXPECT_GT((try_random_motions<BezierMotion<2, 1>>(1, Radii::equal, 9)), 100U);
}
TEST(BoxHierarchy, PointsInSpace) {
  EXPECT_GT((try_random_motions<BezierMotion<3, 1>>(2, Radii::equal, 7)), 100U);
}
TEST(BoxHierarchy, PointsOnCurves) {
  EXPECT_GT((try_random_motions<BezierMotion<2, 3>>(3, Radii::equal, 6)), 100U);
  EXPECT_GT((try_random_motions<BezierMotion<3, 3>>(4, Radii::equal, 5)), 100U);
}
TEST(BoxHierarchy, BallsInThePlane) {
  EXPECT_GT((try_random_motions<BezierMotion<2, 1>>(5, Radii::any, 6)), 100U);
}
TEST(BoxHierarchy, BallsInSpace) {
  EXPECT_GT((try_random_motions<BezierMotion<3, 1>>(6, Radii::any, 5)), 100U);
}
TEST(BoxHierarchy, BallsOnCurves) {
  EXPECT_GT((try_random_motions<BezierMotion<2, 3>>(7, Radii::any, 3)), rounds(100U));
  EXPECT_GT((try_random_motions<BezierMotion<3, 3>>(8, Radii::any, 3)), rounds(100U));
}

/// The events of a node, as (step, side, was, is), in order.
template <class Events>
std::vector<std::array<std::size_t, 4>> of_node(const Events& events, const BeadRange& range) {
  std::vector<std::array<std::size_t, 4>> some;
  for (const Event& e : events)
    if (e.change.ids[0] == range.first && e.change.ids[1] == range.last)
      some.push_back({e.step, e.change.ids[2], e.change.ids[3], e.change.ids[4]});
  return some;
}

// The box at the root is the enclosing box of all beads, which another structure keeps.
TEST(BoxHierarchy, TheRootsBoxIsTheEnclosingBox) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 3);
  const std::size_t beads = steps.front().bead_count();
  Rig<EnclosingBox<3>, Space> box(steps.front());
  box.run(steps);
  BoxesRig<Space> boxes(steps.front(), AuditMode::none, one_necklace(beads), Radii::equal, 13);
  boxes.run(steps);
  std::vector<std::array<std::size_t, 4>> ends;
  for (const Event& e : box.history.events)
    if (e.change.kind > 0)
      ends.push_back({e.step, static_cast<std::size_t>(e.change.kind - 1), e.change.ids[0], e.change.ids[1]});
  auto of_root = of_node(boxes.history.events, {0, static_cast<BeadId>(beads - 1)});
  std::erase_if(of_root, [](const auto& e) { return e[1] >= 6; });
  EXPECT_THAT(ends, testing::Not(IsEmpty()));
  EXPECT_EQ(of_root, ends);
}

// Directions are independent of each other: those of the axes have the same events, whatever directions
// follow.
TEST(BoxHierarchy, MoreDirectionsAddEvents) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 1);
  const Ranges necklace = one_necklace(steps.front().bead_count());
  std::map<int, std::vector<std::array<BeadId, 5>>> events;
  for (const int directions : {3, 7, 13}) {
    BoxesRig<Space> rig(steps.front(), AuditMode::none, necklace, Radii::equal, directions);
    rig.run(steps);
    for (const Event& e : rig.history.events)
      events[directions].push_back(
          {e.change.ids[0], e.change.ids[1], e.change.ids[2], e.change.ids[3], e.change.ids[4]});
  }
  for (const int directions : {3, 7}) {
    auto some = events[13];
    std::erase_if(some, [&](const auto& e) { return e[2] >= static_cast<BeadId>(2 * directions); });
    EXPECT_THAT(some, testing::UnorderedElementsAreArray(events[directions]));
    EXPECT_GT(events[13].size(), events[directions].size());
  }
}

TEST(BoxHierarchy, ReportsWhereASupportChanges) {
  // Bead 2 overtakes bead 1 along x, and then the root's support too.
  const auto steps = through({{{4, 0, 0}, {0, 0, 0}, {3, 0, 0}, {0, 0, 0}},  //
                              {{4, 0, 0}, {0, 0, 0}, {5, 0, 0}, {0, 0, 0}}});
  const History history = expect_right(steps, one_necklace(4), Radii::equal, 3);
  ASSERT_THAT(history.events, SizeIs(1));
  const Event& event = history.events[0];
  EXPECT_EQ(event.change, (Change{0, 5, {0, 3, 1, 0, 2}}));
  EXPECT_NEAR(event.lower, 0.5, 1e-12);
}

// If balls reach equally far for the rest of a step, the least ball is the support.
TEST(BoxHierarchy, OfBallsThatTieTheLeastIsTheSupport) {
  const Points all_in_one(5, {1, 1, 1});
  const std::vector steps{moving(all_in_one, Points(5, {2, 0, 1}))};
  BoxesRig<Space> rig(steps.front(), AuditMode::events, one_necklace(5), Radii::equal, 13);
  rig.run(steps);
  EXPECT_THAT(rig.history.events, IsEmpty());
  for (const BeadId support : rig.structure.supports(0)) EXPECT_EQ(support, 0U);
}

// However many beads meet at one time, a support changes at most once, and the changes are in order.
TEST(BoxHierarchy, WhereManyMeetASupportChangesOnce) {
  Points from, to;
  for (int b = 0; b < 8; ++b) {
    from.push_back({1.0 * b, 0, 0});
    to.push_back({-1.0 * b, 0, 0});
  }
  const History history = expect_right<Space>({moving(from, to)}, one_necklace(8), Radii::equal, 3);
  EXPECT_THAT(history.events, SizeIs(7 * 2));
  for (std::size_t k = 1; k < history.events.size(); ++k) {
    const auto place = [&](std::size_t i) {
      const auto& ids = history.events[i].change.ids;
      return std::array{ids[0], ~ids[1], ids[2]};  // parents before their children
    };
    EXPECT_LT(place(k - 1), place(k));
  }
}

TEST(BoxHierarchy, ReportsSelectedNodesOnly) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 1);
  const BeadId last = static_cast<BeadId>(steps.front().bead_count() - 1);
  NodeSelection roots;
  roots.last_level = 0;
  BoxesRig<Space> all(steps.front(), AuditMode::none, Ranges{{0, last}}, Radii::equal, 3);
  all.run(steps);
  BoxesRig<Space> some(steps.front(), AuditMode::frames, Ranges{{0, last}}, Radii::equal, 3, roots);
  some.run(steps);
  EXPECT_TRUE(some.structure.keeps(0));
  EXPECT_FALSE(some.structure.keeps(1));
  EXPECT_GT(some.history.events.size(), 0U);
  EXPECT_EQ(of_node(some.history.events, {0, last}), of_node(all.history.events, {0, last}));
  EXPECT_THAT(some.history.events, SizeIs(of_node(some.history.events, {0, last}).size()));
  BoxesRig<Space> again(steps.front(), AuditMode::frames, Ranges{{0, last}}, Radii::equal, 3, roots);
  EXPECT_NO_THROW(again.replay(steps, some.history));
}

// In lifted motion radii have no meaning, but centres move linearly.
TEST(BoxHierarchy, LiftedMotionNeedsEqualRadii) {
  Random random(9);
  LiftedMotion<3> motion(6);
  for (BeadId b = 0; b < 6; ++b)
    for (int k = 0; k <= 1; ++k)
      for (int axis = 0; axis < 3; ++axis) motion.set_coordinate(b, k, axis, uniform(random));
  BoxesRig<LiftedMotion<3>> rig(motion, AuditMode::events, one_necklace(6), Radii::equal, 7);
  EXPECT_NO_THROW(rig.run());
  EXPECT_GT(rig.history.events.size(), 0U);
  Simulator simulator;
  EXPECT_THROW((BoxHierarchy<3>(simulator, motion, one_necklace(6), Radii::any)), std::invalid_argument);
}

TEST(BoxHierarchy, HasTheDirectionsOfKDops) {
  for (const int count : {3, 7, 13}) {
    std::map<int, int> of_square;
    for (const SlabDirection& direction : box_directions<3>(count)) {
      EXPECT_TRUE(direction.is_canonical());
      ++of_square[direction.square()];
    }
    EXPECT_EQ(of_square[1], 3);
    EXPECT_EQ(of_square[3], count == 3 ? 0 : 4);
    EXPECT_EQ(of_square[2], count == 13 ? 6 : 0);
  }
  EXPECT_THAT(box_directions<2>(4), SizeIs(4));
  for (const int count : {0, 2, 4, 12, 14})
    EXPECT_THROW(static_cast<void>(box_directions<3>(count)), std::invalid_argument);
  for (const int count : {1, 3, 7, 13})
    EXPECT_THROW(static_cast<void>(box_directions<2>(count)), std::invalid_argument);
}

TEST(BoxHierarchy, ABeadHasFewCertificates) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 1);
  const std::size_t beads = steps.front().bead_count();
  BoxesRig<Space> rig(steps.front(), AuditMode::none, one_necklace(beads), Radii::equal, 3);
  rig.run(steps);
  const CertificateCounts& counts = rig.structure.statistics.certificates;
  EXPECT_EQ(counts.peak, 6 * (beads - 1));
  EXPECT_LE(counts.per_bead_max, 6 * (std::bit_width(beads - 1) + 0U));
  EXPECT_LT(rig.structure.statistics.stages.exact, counts.created / 100);
}

/// Returns the most certificates that name one bead, counted anew: each node has one for each side, which
/// compares the supports of its children.
template <int Dimension>
std::uint64_t most_on_one_bead(const BoxHierarchy<Dimension>& boxes) {
  std::map<BeadId, std::uint64_t> named;
  const NecklaceTree& tree = boxes.tree();
  for (NodeId node = 0; node < tree.node_count(); ++node)
    for (std::uint32_t side = 0; side < boxes.side_count(); ++side) {
      const auto [first, last] = tree.range(node);
      const NodeId left = tree.left(node), right = tree.right(node);
      ++named[left == NecklaceTree::leaf ? first : boxes.supports(left)[side]];
      ++named[right == NecklaceTree::leaf ? last : boxes.supports(right)[side]];
    }
  std::uint64_t most = 0;
  for (const auto& [bead, count] : named) most = std::max(most, count);
  return most;
}

TEST(BoxHierarchy, FollowsTheCertificatesOfABeadAtAllTimes) {
  using M = BezierMotion<2, 1>;
  Random random(5);
  int above = 0;  // runs in which a bead has most certificates between starts of steps
  for (int round = 0; round < 20; ++round) {
    std::vector<M> steps{random_motion<M>(random, 12, all_motion_kinds[0])};
    steps.push_back(next_step(random, steps.front(), all_motion_kinds[0]));
    BoxesRig<M> rig(steps.front(), AuditMode::events, one_necklace(12), Radii::equal, 4);
    rig.structure.follow_certificates();
    std::uint64_t most = 0;
    const Witness witness(rig.simulator, [&](const Dyadic&) {
      most = std::max(most, most_on_one_bead(rig.structure));
      rig.structure.count_certificates();
      return std::nullopt;
    });
    rig.run(steps);
    EXPECT_EQ(rig.structure.statistics.certificates.per_bead_max, most);
    BoxesRig<M> plain(steps.front(), AuditMode::none, one_necklace(12), Radii::equal, 4);
    plain.run(steps);
    EXPECT_LE(plain.structure.statistics.certificates.per_bead_max, most);
    above += plain.structure.statistics.certificates.per_bead_max < most ? 1 : 0;
  }
  EXPECT_GT(above, 0);
}

TEST(BoxHierarchy, AuditsNoticeEveryWrongSupport) {
  const Points points{{0, 0, 0}, {1, 2, 4}, {2, 4, 8}};
  BoxesRig<Space> rig(moving(points, points), AuditMode::none, one_necklace(3), Radii::equal, 13);
  rig.run();
  for (NodeId node = 0; node < 2; ++node) {
    const auto [first, last] = rig.structure.tree().range(node);
    for (std::uint32_t side = 0; side < 26; ++side) {
      EXPECT_EQ(rig.structure.audit(Dyadic(0.5)), std::nullopt);
      const BeadId right = rig.structure.supports(node)[side];
      const BeadId wrong = right == first ? first + 1 : first;
      rig.structure.apply({0, 5, {first, last, side, right, wrong}});
      EXPECT_NE(rig.structure.audit(Dyadic(0.5)), std::nullopt);
      rig.structure.apply({0, 5, {first, last, side, wrong, right}});
    }
  }
}

TEST(BoxHierarchy, RefusesChangesThatCannotBe) {
  const Points points{{0, 0, 0}, {1, 2, 4}, {2, 4, 8}};
  BoxesRig<Space> rig(moving(points, points), AuditMode::none, one_necklace(3), Radii::equal, 3);
  rig.run();
  const auto apply = [&](std::array<BeadId, 10> ids) { rig.structure.apply({0, 5, ids}); };
  EXPECT_THROW(apply({0, 2, 0, 1, 2}), std::invalid_argument);  // the support is bead 0
  EXPECT_THROW(apply({0, 2, 0, 0, 3}), std::invalid_argument);  // no such bead
  EXPECT_THROW(apply({0, 2, 6, 0, 1}), std::invalid_argument);  // no such side
  EXPECT_THROW(apply({1, 2, 0, 1, 2}), std::invalid_argument);  // no such node
  EXPECT_THROW(apply({0, 1, 0, 0, 2}), std::invalid_argument);  // bead 2 is not below the node
  EXPECT_THROW(static_cast<void>(rig.structure.supports(2)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(rig.structure.keeps(2)), std::invalid_argument);
}

}  // namespace
}  // namespace kds::box_hierarchy_test
