// The kinetic wrapped hierarchy of balls with any radii, in the plane and in space, and of balls with equal
// radii in the plane. Audits run between all events, and the definition over rationals judges each audit.
// Equal radii in space have their own file.

#include <gtest/gtest.h>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "structures/hierarchy/wrapped_hierarchy.h"
#include "structures/necklace/balls.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/enclosing_ball.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::ball_hierarchy_test {
namespace {

using namespace test;

template <class M, Kernel kernel, Radii radii>
struct BallRig : Rig<WrappedHierarchy<M::dimension>, M> {
  BallRig(const M& first, AuditMode audits, const std::vector<BeadRange>& necklaces,
          const NodeSelection& selection = {})
      : Rig<WrappedHierarchy<M::dimension>, M>(first, audits, kernel, necklaces, radii, selection) {}
};

template <class M>
std::vector<Ball> balls_of(const M& motion, const Basis& basis, const Dyadic& time) {
  std::vector<Ball> balls;
  for (const BeadId b : basis) balls.push_back(ball_at(motion, b, time));
  return balls;
}

/// Explains why the sphere of a node's basis is not the smallest sphere at `time`, or returns nothing. A
/// basis may have superfluous beads between events for a while.
template <class M>
std::optional<std::string> not_smallest(const M& motion, const BeadRange& range, const Basis& basis,
                                        const Dyadic& time) {
  const std::vector<Ball> members = balls_of(motion, basis, time);
  const auto sphere = touching_sphere(members);
  if (!sphere) return "no sphere touches the basis";
  for (const Enclosed& share : sphere->shares)
    if (share.sign() < 0) return "a ball is to spare";
  for (BeadId b = range.first; b <= range.last; ++b)
    if (!basis.contains(b) && sphere->holds(members[0], ball_at(motion, b, time)) < 0)
      return text_of("ball ", b, " sticks out");
  return std::nullopt;
}

template <Radii radii, Kernel K = Kernel::filtered, class M>
std::uint64_t run_audited(const std::vector<M>& steps, int stride = 1) {
  const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(steps.front().bead_count() - 1)}};
  BallRig<M, K, radii> rig(steps.front(), AuditMode::events, necklace);
  Witness witness(rig.simulator, [&, count = 0](const Dyadic& time) mutable -> std::optional<std::string> {
    if (count++ % stride != 0) return std::nullopt;
    for (NodeId node = 0; node < rig.structure.tree().node_count(); ++node) {
      const BeadRange range = rig.structure.tree().range(node);
      const Basis& basis = rig.structure.basis(node);
      if (!touching_sphere(balls_of(rig.motion, basis, time))) continue;  // dependent for a while
      if (auto wrong = not_smallest(rig.motion, range, basis, time))
        return text_of("node ", range.first, "-", range.last, ": ", *wrong);
    }
    return std::nullopt;
  });
  try {
    rig.run(steps);
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
    return 0;
  }
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  EXPECT_EQ(rig.structure.statistics.rebuilds, 0U);
  for (NodeId node = 0; node < rig.structure.tree().node_count(); ++node) {
    EXPECT_EQ(not_smallest(rig.motion, rig.structure.tree().range(node),
                           rig.structure.bases_at(Dyadic(1.0))[node], Dyadic(1.0)),
              std::nullopt);
  }
  BallRig<M, K, radii> replayed(steps.front(), AuditMode::frames, necklace);
  EXPECT_NO_THROW(replayed.replay(steps, rig.history));
  EXPECT_EQ(replayed.simulator.fingerprint(), rig.simulator.fingerprint());
  return rig.external_events();
}

template <Radii radii, Kernel K, class M>
std::uint64_t fingerprint_of(const std::vector<M>& steps) {
  const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(steps.front().bead_count() - 1)}};
  BallRig<M, K, radii> rig(steps.front(), AuditMode::none, necklace);
  rig.run(steps);
  return rig.simulator.fingerprint();
}

template <class M>
void make_equal(M& motion) {
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int k = 0; k <= M::degree; ++k) {
      motion.set_radius(b, k, 0.25);
      motion.set_weight(b, k, 0.0625);
    }
  }
}

/// Adds a second step that starts where the first ends and ends at the mirror image of the first's start.
template <class M>
std::vector<M> there_and_back(const M& motion) {
  std::vector<M> steps(2, motion);
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int axis = 0; axis < M::dimension; ++axis) {
      for (int k = 0; k <= M::degree; ++k) {
        const double mirror = axis == 0 && k == M::degree ? -1 : 1;
        steps[1].set_coordinate(b, k, axis, mirror * motion.coordinate(b, M::degree - k, axis));
      }
    }
    for (int k = 0; k <= M::degree; ++k) {
      steps[1].set_radius(b, k, motion.radius(b, M::degree - k));
      steps[1].set_weight(b, k, motion.weight(b, M::degree - k));
    }
  }
  return steps;
}

/// Runs all kinds of motion, two steps each; returns the number of events.
template <class M, Radii radii>
std::uint64_t run_random(unsigned rounds, std::size_t most_beads) {
  std::uint64_t events = 0;
  for (unsigned seed = 0; seed < rounds; ++seed) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", kind " << static_cast<int>(kind));
      Random random(1000 * seed + static_cast<unsigned>(kind));
      auto motion = random_motion<M>(random, 2 + random() % (most_beads - 1), kind);
      if (radii == Radii::equal) make_equal(motion);
      const std::vector<M> steps = there_and_back(motion);
      events += run_audited<radii>(steps);
      if (testing::Test::HasFailure()) return events;
      if (seed % 4 == 0) {
        EXPECT_EQ((fingerprint_of<radii, Kernel::exact>(steps)),
                  (fingerprint_of<radii, Kernel::filtered>(steps)));
      }
      if (testing::Test::HasFailure()) return events;
    }
  }
  return events;
}

TEST(BallHierarchy, RandomBallsInSpace) {
  EXPECT_GT((run_random<BezierMotion<3, 1>, Radii::any>(test::rounds(8U), 7)), test::rounds(200U));
}
TEST(BallHierarchy, RandomBallsInThePlane) {
  EXPECT_GT((run_random<BezierMotion<2, 1>, Radii::any>(test::rounds(8U), 7)), test::rounds(200U));
}
// The code for any radii gives the same events for equal radii as the code for equal radii.
TEST(BallHierarchy, EqualRadiiEitherWay) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Random random(seed);
    auto motion = random_motion<Space>(random, 12, MotionKind::generic);
    make_equal(motion);
    EXPECT_EQ((fingerprint_of<Radii::any, Kernel::filtered>(std::vector{motion})),
              (fingerprint_of<Radii::equal, Kernel::filtered>(std::vector{motion})));
  }
}

// A ball grows until it contains the others, and shrinks again; another ball passes through it.
TEST(BallHierarchy, ABallThatHoldsOthers) {
  for (const double largest : {3.0, 8.0}) {
    Space motion(3);
    const double x[3][2] = {{-2, -2}, {2, 2}, {-6, 6}};
    for (BeadId b = 0; b < 3; ++b) {
      for (int k = 0; k <= 1; ++k) {
        motion.set_coordinate(b, k, 0, x[b][k]);
        motion.set_coordinate(b, k, 1, b == 2 ? 0.5 : 0);
        motion.set_radius(b, k, b == 0 ? (k == 0 ? 1 : largest) : 0.5);
      }
    }
    EXPECT_GT(run_audited<Radii::any>(there_and_back(motion)), 0U);
  }
}

// Four balls of three sizes pass through a plane, with their centres on an ellipse. A fifth ball reaches
// their sphere at the same moment.
TEST(BallHierarchy, AFullBasisTurnsOverWhileABallEnters) {
  const double bead[5][3] = {{0, 16, 1}, {0, -16, 1}, {10, 0, -1}, {-40, 0, -1}, {1, 2, 0.125}};
  for (const double last : {1.0, 20.0, 24.0, 30.0, 36.0}) {
    const double radius[5] = {25, 25, 31, 1, last};
    Space motion(5);
    for (BeadId b = 0; b < 5; ++b) {
      for (int k = 0; k <= 1; ++k) {
        for (int axis = 0; axis < 3; ++axis)
          motion.set_coordinate(b, k, axis, bead[b][axis] * (axis == 2 && k == 1 && b < 4 ? -1 : 1));
        motion.set_radius(b, k, radius[b]);
        motion.set_weight(b, k, radius[b] * radius[b]);
      }
    }
    SCOPED_TRACE(last);
    run_audited<Radii::any>(there_and_back(motion));
    EXPECT_EQ((fingerprint_of<Radii::any, Kernel::exact>(std::vector{motion})),
              (fingerprint_of<Radii::any, Kernel::filtered>(std::vector{motion})));
  }
}

// Lifted motion has fictitious weights between frames, so its radii would be fictitious too.
TEST(BallHierarchy, RefusesLiftedMotion) {
  const LiftedMotion<3> motion(3);
  const std::vector<BeadRange> necklace{{0, 2}};
  Simulator simulator;
  for (const Radii radii : {Radii::equal, Radii::any})
    EXPECT_THROW(WrappedHierarchy<3>(simulator, motion, necklace, radii), std::invalid_argument);
}

// The bounds on paths of spheres are compiled up to degree three. Motion of a higher degree runs without the
// bounds.
TEST(BallHierarchy, MotionOfAHigherDegree) {
  const std::vector<BeadRange> necklace{{0, 5}};
  for (const Radii radii : {Radii::equal, Radii::any}) {
    Random random(7);
    AnyDegreeMotion<3> quartic(6, 4);
    for (BeadId b = 0; b < 6; ++b) {
      for (int k = 0; k <= 4; ++k) {
        for (int axis = 0; axis < 3; ++axis) quartic.set_coordinate(b, k, axis, uniform(random));
        quartic.set_radius(b, k, radii == Radii::equal ? 0.25 : 0.25 + 0.125 * (b % 3));
      }
    }
    Rig<WrappedHierarchy<3>, AnyDegreeMotion<3>> filtered(quartic, AuditMode::events, necklace, radii);
    filtered.run();
    EXPECT_GT(filtered.external_events(), 0U);
    Rig<WrappedHierarchy<3>, AnyDegreeMotion<3>> exact(quartic, AuditMode::none, Kernel::exact, necklace,
                                                       radii);
    exact.run();
    EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
  }
}

// Norms for unequal radii have twelve times the degree of the motion; functions for equal radii have half of
// that.
TEST(BallHierarchy, RefusesMotionWhoseFunctionsHaveTooHighADegree) {
  const std::vector<BeadRange> necklace{{0, 5}};
  const auto make = [&](Radii radii, int degree) {
    const AnyDegreeMotion<3> motion(6, degree);
    Simulator simulator;
    const WrappedHierarchy<3> hierarchy(simulator, motion, necklace, radii);
  };
  EXPECT_NO_THROW(make(Radii::any, 5));
  EXPECT_THROW(make(Radii::any, 6), std::invalid_argument);
  EXPECT_NO_THROW(make(Radii::equal, 10));
  EXPECT_THROW(make(Radii::equal, 11), std::invalid_argument);
}

// Selections keep only the nodes that a scene needs.

TEST(NodeSelection, LevelsAndBeads) {
  const std::vector<BeadRange> necklaces{{0, 15}, {16, 19}};
  const NecklaceTree tree(necklaces);
  const auto count = [&](const NodeSelection& selection) {
    const auto flags = select_nodes(tree, selection);
    return std::count(flags.begin(), flags.end(), 1);
  };
  EXPECT_EQ(count({}), 18);
  EXPECT_EQ(count({0, 0, {}}), 2);
  EXPECT_EQ(count({1, 2, {}}), 8);
  EXPECT_EQ(count({0, 9, BeadRange{0, 7}}), 7);
  EXPECT_EQ(count({0, 9, BeadRange{1, 2}}), 0);
  EXPECT_EQ(count({0, 9, BeadRange{12, 19}}), 6);
}

// A selected node has the same events as in a run with all nodes.
TEST(NodeSelection, OtherNodesMakeNoDifference) {
  const Space motion = instance_motion<Space>("d3_n50_linear");
  const std::vector<BeadRange> necklace{{0, 49}};
  const auto events_of = [](const History& history, const BeadRange& range) {
    std::vector<std::array<BeadId, 10>> some;
    for (const Event& e : history.events)
      if (e.change.ids[0] == range.first && e.change.ids[1] == range.last) some.push_back(e.change.ids);
    return some;
  };
  BallRig<Space, Kernel::filtered, Radii::equal> all(motion, AuditMode::none, necklace);
  all.run();
  const NodeSelection selection{2, 3, {}};
  BallRig<Space, Kernel::filtered, Radii::equal> some(motion, AuditMode::events, necklace, selection);
  some.run();
  std::size_t kept = 0;
  for (NodeId node = 0; node < all.structure.tree().node_count(); ++node) {
    const BeadRange range = all.structure.tree().range(node);
    if (some.structure.keeps(node)) {
      ++kept;
      EXPECT_EQ(events_of(some.history, range), events_of(all.history, range));
    } else {
      EXPECT_TRUE(events_of(some.history, range).empty());
      EXPECT_THROW(some.structure.apply({0, 4, {range.first, range.last, range.first, range.last}}),
                   std::invalid_argument);
    }
  }
  EXPECT_EQ(kept, 12U);
  EXPECT_LT(some.structure.statistics.certificates.created, all.structure.statistics.certificates.created);
}

// At the frame between two steps, the beads of a basis may be affinely dependent or coincide.
TEST(NodeSelection, AQueryAtADegenerateFrame) {
  const auto square = [](double z) { return Points{{4, 0, z}, {-4, 0, z}, {0, 4, -z}, {0, -4, -z}}; };
  const Points apart{{-1, 0, 0}, {1, 0, 0}}, together{{0, 0, 0}, {0, 0, 0}};
  for (const auto& frames :
       {std::vector{square(1), square(0), square(-1)}, std::vector{apart, together, apart}}) {
    const auto steps = through(frames);
    const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(steps.front().bead_count() - 1)}};
    BallRig<Space, Kernel::filtered, Radii::equal> rig(steps.front(), AuditMode::frames, necklace);
    std::vector<double> radii;
    rig.structure.keep_what_is_asked_for([&](const auto& sphere) { radii.push_back(sphere(0).radius); });
    rig.run(steps);
    ASSERT_EQ(radii.size(), 2U);
    EXPECT_DOUBLE_EQ(radii[1], steps.front().bead_count() == 4 ? 4 : 0);
  }
}

// A query that descends into the wider child.
TEST(NodeSelection, WhatAQueryAsksFor) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 6);
  const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(steps.front().bead_count() - 1)}};
  BallRig<Space, Kernel::filtered, Radii::equal> rig(steps.front(), AuditMode::frames, necklace);
  const NecklaceTree& tree = rig.structure.tree();
  std::vector<std::vector<NodeId>> asked;
  rig.structure.keep_what_is_asked_for([&](const auto& sphere) {
    asked.emplace_back();
    for (NodeId node = 0; node != NecklaceTree::leaf;) {
      EXPECT_GT(sphere(node).radius, 0);
      asked.back().push_back(node);
      const NodeId left = tree.left(node), right = tree.right(node);
      if (left == NecklaceTree::leaf || right == NecklaceTree::leaf) break;
      asked.back().push_back(left);
      asked.back().push_back(right);
      node = sphere(left).radius >= sphere(right).radius ? left : right;
    }
  });
  rig.run(steps);
  EXPECT_EQ(asked.size(), steps.size());
  for (NodeId node = 0; node < tree.node_count(); ++node) {
    EXPECT_EQ(rig.structure.keeps(node),
              std::find(asked.back().begin(), asked.back().end(), node) != asked.back().end());
  }
  rig.structure.keep_what_is_asked_for([](const auto& sphere) { (void)sphere(100000); });
  EXPECT_THROW(rig.step(steps[0]), std::invalid_argument);
}

}  // namespace
}  // namespace kds::ball_hierarchy_test
