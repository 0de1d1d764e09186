// The kinetic wrapped hierarchy with relaxed spheres. Between all events, judged over rationals, each basis
// is the basis of its own minimum enclosing sphere, and that sphere enlarged by the relaxation contains all
// beads of the node.

#include <gtest/gtest.h>

#include "motions/curves/bezier_motion.h"
#include "structures/hierarchy/wrapped_hierarchy.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/cgal_sphere.h"
#include "tests/support/judges/enclosing_ball.h"
#include "tests/support/judges/exact_checks.h"
#include "tests/support/rounds.h"

namespace kds::relaxed_hierarchy_test {
namespace {

using namespace test;

template <class M>
struct RelaxedRig : Rig<WrappedHierarchy<M::dimension>, M> {
  RelaxedRig(const M& first, AuditMode audits, Kernel kernel, double share, Radii radii = Radii::equal)
      : Rig<WrappedHierarchy<M::dimension>, M>(
            first, audits, kernel, std::vector<BeadRange>{{0, static_cast<BeadId>(first.bead_count() - 1)}},
            radii, NodeSelection{}, Relaxation::of(share)) {}
};

std::span<const BeadId> beads_of(const Basis& basis) { return {basis.begin(), basis.end()}; }

Rational square_of_distance(const ExactPoint& p, const test::ExactSphere& sphere) {
  Rational square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Rational along = p[axis] - sphere.center[axis];
    square += along * along;
  }
  return square;
}

/// Explains, for points, why a basis is not the basis of its own smallest sphere, or which bead is too far
/// out. The sphere passes through all members of the basis, so no member can be outside.
std::optional<std::string> not_relaxed(std::span<const ExactPoint> points, const BeadRange& range,
                                       const Basis& basis, const Relaxation& relaxation) {
  const auto found = sphere_through(points, beads_of(basis));
  if (!found) return std::nullopt;  // beads that coincide for a while
  for (const Rational& weight : found->second)
    if (weight < 0) return "the centre is not inside the basis";
  const Rational larger = 1 + Rational(relaxation.share());
  const Rational most = larger * larger * found->first.square;
  for (BeadId b = range.first; b <= range.last; ++b)
    if (square_of_distance(points[b], found->first) > most) return text_of("bead ", b, " is too far out");
  return std::nullopt;
}

/// Returns the positions of all beads, or of some beads; the other positions are zero.
template <class M>
std::vector<ExactPoint> points_at(const M& motion, const Dyadic& time, std::optional<BeadRange> of = {}) {
  std::vector<ExactPoint> points(motion.bead_count());
  const BeadRange some = of.value_or(BeadRange{0, static_cast<BeadId>(motion.bead_count() - 1)});
  for (BeadId b = some.first; b <= some.last; ++b) {
    const auto position = exact_position(motion, b, time);
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(M::dimension); ++axis)
      points[b][axis] = position[axis];
  }
  return points;
}

/// Runs with audits between all events; returns the number of events.
template <class M>
std::uint64_t run_audited(const std::vector<M>& steps, double share, Kernel kernel = Kernel::filtered,
                          int stride = 1) {
  RelaxedRig<M> rig(steps.front(), AuditMode::events, kernel, share);
  const WrappedHierarchy<M::dimension>& hierarchy = rig.structure;
  Witness witness(rig.simulator, [&, count = 0](const Dyadic& time) mutable -> std::optional<std::string> {
    if (count++ % stride != 0) return std::nullopt;
    const auto points = points_at(rig.motion, time);
    for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
      const BeadRange& range = hierarchy.tree().range(node);
      if (auto wrong = not_relaxed(points, range, hierarchy.basis(node), hierarchy.relaxation()))
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
  EXPECT_TRUE(books_balance(hierarchy.statistics));
  EXPECT_EQ(hierarchy.statistics.rebuilds, 0U);
  RelaxedRig<M> replayed(steps.front(), AuditMode::frames, kernel, share);
  EXPECT_NO_THROW(replayed.replay(steps, rig.history));
  EXPECT_EQ(replayed.simulator.fingerprint(), rig.simulator.fingerprint());
  return rig.external_events();
}

template <class M>
std::uint64_t fingerprint_of(const std::vector<M>& steps, double share, Kernel kernel) {
  RelaxedRig<M> rig(steps.front(), AuditMode::none, kernel, share);
  rig.run(steps);
  return rig.simulator.fingerprint();
}

template <class M>
void make_equal(M& motion) {
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int k = 0; k <= degree_of(motion); ++k) {
      motion.set_radius(b, k, 0.25);
      motion.set_weight(b, k, 0.0625);
    }
  }
}

/// Returns the step, and a second step that goes back to the start.
template <class M>
std::vector<M> there_and_back(const M& motion) {
  std::vector<M> steps(2, motion);
  const int degree = degree_of(motion);
  for (BeadId b = 0; b < motion.bead_count(); ++b)
    for (int axis = 0; axis < M::dimension; ++axis)
      for (int k = 0; k <= degree; ++k)
        steps[1].set_coordinate(b, k, axis, motion.coordinate(b, degree - k, axis));
  return steps;
}

// A bead that moves straight outwards is added to the basis when it is a quarter of the radius outside, at u
// = 5/8. The next sphere contains it.
TEST(RelaxedHierarchy, AnEscapeWaits) {
  const Space motion = moving({{-4, 0, 0}, {4, 0, 0}, {0, 0, 0}}, {{-4, 0, 0}, {4, 0, 0}, {0, 8, 0}});
  const auto first_event = [&](double share) {
    RelaxedRig<Space> rig(motion, AuditMode::events, Kernel::filtered, share);
    rig.run();
    EXPECT_EQ(rig.history.events.size(), share < 1 ? 1U : 0U);
    return rig.history.events.empty() ? Event{} : rig.history.events.front();
  };
  const auto is_at = [](const Event& event, double u) { return event.lower <= u && u <= event.upper; };
  EXPECT_TRUE(is_at(first_event(0), 0.5));
  EXPECT_TRUE(is_at(first_event(0.25), 0.625));
  EXPECT_TRUE(is_at(first_event(0.5), 0.75));
  first_event(1);
}

// Without a relaxation the hierarchy is the wrapped hierarchy. Fingerprints of known runs are in
// tests/support/fingerprints.csv.
TEST(RelaxedHierarchy, NoneIsTheWrappedHierarchy) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 4);
  Rig<WrappedHierarchy<3>, Space> plain(steps.front(), AuditMode::none, Kernel::filtered,
                                        std::vector<BeadRange>{{0, 107}}, Radii::equal);
  plain.run(steps);
  EXPECT_EQ(fingerprint_of(steps, 0, Kernel::filtered), plain.simulator.fingerprint());
}

TEST(RelaxedHierarchy, RandomMotionsInSpaceAndInThePlane) {
  std::uint64_t events = 0;
  for (int round = 0; round < rounds(12); ++round) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(testing::Message() << "round " << round << ", kind " << static_cast<int>(kind));
      Random random(3000U * static_cast<unsigned>(round) + static_cast<unsigned>(kind));
      const double share = std::array{0.01, 0.03, 0.3, 1.0, 0x1p-20}[static_cast<std::size_t>(round) % 5];
      const std::size_t beads = 2 + random() % 8;
      auto space = random_motion<Space>(random, beads, kind);
      auto plane = random_motion<BezierMotion<2, 1>>(random, beads, kind);
      make_equal(space);
      make_equal(plane);
      events += run_audited(there_and_back(space), share) + run_audited(there_and_back(plane), share);
      if (round % 3 == 0) {
        EXPECT_EQ(fingerprint_of(there_and_back(space), share, Kernel::exact),
                  fingerprint_of(there_and_back(space), share, Kernel::filtered));
        EXPECT_EQ(fingerprint_of(there_and_back(plane), share, Kernel::exact),
                  fingerprint_of(there_and_back(plane), share, Kernel::filtered));
      }
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(events, static_cast<std::uint64_t>(rounds(100)));
}

TEST(RelaxedHierarchy, MotionsFullOfTies) {
  std::mt19937 random(31);
  for (int round = 0; round < rounds(60); ++round) {
    const std::size_t beads = 3 + random() % 7;
    std::vector<Points> frames;
    for (int k = 0; k < 3; ++k)
      frames.push_back(k > 0 && random() % 4 == 0 ? frames.back() : random_grid_points(random, beads, 3));
    // With these shares, enlarged spheres may pass exactly through grid points.
    const double share = round % 2 == 0 ? 0.125 : 0.5;
    SCOPED_TRACE(text_of("round ", round, ": ", testing::PrintToString(frames)));
    run_audited(through(frames), share);
    EXPECT_EQ(fingerprint_of(through(frames), share, Kernel::exact),
              fingerprint_of(through(frames), share, Kernel::filtered));
    if (HasFailure()) return;
  }
}

TEST(RelaxedHierarchy, CurvedMotions) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    Random random(seed);
    auto cubic = random_motion<BezierMotion<3, 3>>(random, 8, MotionKind::generic);
    make_equal(cubic);
    EXPECT_GT(run_audited(there_and_back(cubic), 0.03), 0U);
    EXPECT_EQ(fingerprint_of(there_and_back(cubic), 0.03, Kernel::exact),
              fingerprint_of(there_and_back(cubic), 0.03, Kernel::filtered));
    AnyDegreeMotion<3> quartic(6, 4);
    for (BeadId b = 0; b < 6; ++b)
      for (int k = 0; k <= 4; ++k)
        for (int axis = 0; axis < 3; ++axis) quartic.set_coordinate(b, k, axis, uniform(random));
    EXPECT_EQ(fingerprint_of(std::vector{quartic}, 0.03, Kernel::exact),
              fingerprint_of(std::vector{quartic}, 0.03, Kernel::filtered));
  }
}

TEST(RelaxedHierarchy, DegenerateInstances) {
  for (const char* name :
       {"static", "half", "rigid", "gridrigid", "gridscale", "converge", "gridrand", "gridint", "swap"}) {
    SCOPED_TRACE(name);
    run_audited(std::vector{instance_motion<Space>(std::string("degenerate_d3_n64_") + name)}, 0.03,
                Kernel::filtered, 20);
  }
}

// Checks a protein at 10^4 random times: the radius of the smallest sphere lies between the radius of the
// basis' sphere and the enlarged radius. CGAL computes the smallest sphere.
TEST(RelaxedHierarchy, HoldsAllBeadsOfAProteinAtRandomTimes) {
  const auto steps = trajectory_steps("villin_hp36_300K.dcd", 0, 40);
  for (const double share : {0.01, 0.1}) {
    RelaxedRig<Space> rig(steps.front(), AuditMode::none, Kernel::filtered, share);
    rig.simulator.build();
    const NecklaceTree& tree = rig.structure.tree();
    const Rational larger = 1 + Rational(rig.structure.relaxation().share());
    std::mt19937 random(41);
    std::size_t looked_at = 0, events = 0, cgal = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      std::vector<Basis> bases;
      for (NodeId node = 0; node < tree.node_count(); ++node) bases.push_back(rig.structure.basis(node));
      const std::size_t before = rig.history.events.size();
      rig.step(steps[k]);
      std::vector<double> times(static_cast<std::size_t>(rounds(125)));
      for (double& u : times) u = std::ldexp(static_cast<double>(random() % (1U << 20)), -20);
      std::sort(times.begin(), times.end());
      std::size_t next = before;
      for (const double u : times) {
        for (; next < rig.history.events.size() && rig.history.events[next].upper <= u; ++next) {
          const Change& change = rig.history.events[next].change;
          const auto node = tree.find({change.ids[0], change.ids[1]});
          bases[*node] = Basis(std::span(change.ids).subspan(2, change.size - 2U));
        }
        if (next < rig.history.events.size() && rig.history.events[next].lower < u)
          continue;  // the next event happens at about this time
        const NodeId node = static_cast<NodeId>(random() % tree.node_count());
        const BeadRange& range = tree.range(node);
        const auto points = points_at(steps[k], Dyadic(u), range);
        ASSERT_EQ(not_relaxed(points, range, bases[node], rig.structure.relaxation()), std::nullopt);
        ++looked_at;
        if (looked_at % 50 != 0) continue;
        const Rational ours = sphere_through(points, beads_of(bases[node]))->first.square;
        const Rational least = cgal_smallest_sphere(points, range.first, range.last).square;
        ASSERT_LE(ours, least);
        ASSERT_LE(least, larger * larger * ours);
        cgal += least > ours ? 1 : 0;
      }
      events += rig.history.events.size() - before;
    }
    EXPECT_GT(looked_at, static_cast<std::size_t>(rounds(4700)));
    EXPECT_GE(cgal, rounds(5U) / 5);  // frequent checks find some bead outside its basis' sphere
    Rig<WrappedHierarchy<3>, Space> plain(steps.front(), AuditMode::none, Kernel::filtered,
                                          std::vector<BeadRange>{{0, 107}}, Radii::equal);
    plain.run(steps);
    EXPECT_LT(events * (share < 0.05 ? 3 : 10), plain.external_events() * 2);
  }
}

// The audit must be able to fail: it rejects a basis that is too small, and a basis with a superfluous bead.
TEST(RelaxedHierarchy, AuditsNoticeBeadsTooFarOut) {
  const Space motion = moving({{-4, 0, 0}, {4, 0, 0}, {0, 4.5, 0}}, {{-4, 0, 0}, {4, 0, 0}, {0, 4.5, 0}});
  const auto fault = [&](double share, std::initializer_list<BeadId> basis) {
    RelaxedRig<Space> rig(motion, AuditMode::frames, Kernel::filtered, share);
    rig.run();
    Change change{0, static_cast<std::uint8_t>(2 + basis.size()), {0, 2}};
    std::copy(basis.begin(), basis.end(), change.ids.begin() + 2);
    rig.structure.apply(change);
    return rig.structure.audit(Dyadic(0.5));
  };
  EXPECT_EQ(fault(0.125, {0, 1}), std::nullopt);
  EXPECT_NE(fault(0.12, {0, 1}), std::nullopt);
  EXPECT_NE(fault(0, {0, 1}), std::nullopt);
  EXPECT_NE(fault(0.125, {0, 2}), std::nullopt);
  EXPECT_EQ(fault(0.12, {0, 1, 2}), std::nullopt);
}

// Tests for balls of unequal radii.

/// Explains why the sphere of radius (1 + share) R does not contain a ball of the node, or why the basis has
/// no proper sphere. Interval enclosures decide.
template <class M>
std::optional<std::string> ball_too_far_out(const M& motion, const BeadRange& range, const Basis& basis,
                                            const Rational& share, const Dyadic& time) {
  std::vector<Ball> members;
  for (const BeadId b : basis) members.push_back(ball_at(motion, b, time));
  const auto sphere = touching_sphere(members);
  if (!sphere) return std::nullopt;  // dependent for a while
  for (const Enclosed& part : sphere->shares)
    if (part.sign() < 0) return "a ball is to spare";
  const Enclosed larger = sphere->radius + Enclosed(share) * (sphere->radius + Enclosed(members[0].radius));
  for (BeadId b = range.first; b <= range.last; ++b) {
    const Ball ball = ball_at(motion, b, time);
    const Enclosed room = larger - Enclosed(Rational(ball.radius - members[0].radius));
    const BallCenter d = minus(ball.center, members[0].center);
    Enclosed distance(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Enclosed along = sphere->center[axis] - Enclosed(d[axis]);
      distance = distance + along * along;
    }
    if (room.sign() < 0 || (room * room - distance).sign() < 0) return text_of("ball ", b, " is too far out");
  }
  return std::nullopt;
}

/// Runs with audits of the structure and a judge by the definition between all events; returns the number of
/// events.
template <class M>
std::uint64_t run_balls(const std::vector<M>& steps, double share) {
  RelaxedRig<M> rig(steps.front(), AuditMode::events, Kernel::filtered, share, Radii::any);
  const auto& hierarchy = rig.structure;
  Witness witness(rig.simulator, [&](const Dyadic& time) -> std::optional<std::string> {
    for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node)
      if (auto wrong = ball_too_far_out(rig.motion, hierarchy.tree().range(node), hierarchy.basis(node),
                                        Rational(hierarchy.relaxation().share()), time))
        return wrong;
    return std::nullopt;
  });
  try {
    rig.run(steps);
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
    return 0;
  }
  EXPECT_TRUE(books_balance(hierarchy.statistics));
  RelaxedRig<M> exact(steps.front(), AuditMode::none, Kernel::exact, share, Radii::any);
  exact.run(steps);
  EXPECT_EQ(exact.simulator.fingerprint(), rig.simulator.fingerprint());
  return rig.external_events();
}

TEST(RelaxedHierarchy, UnequalRadiiInSpaceAndInThePlane) {
  std::uint64_t events = 0;
  for (int round = 0; round < rounds(4); ++round) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(testing::Message() << "round " << round << ", kind " << static_cast<int>(kind));
      Random random(5000U * static_cast<unsigned>(round) + static_cast<unsigned>(kind));
      const double share = std::array{0.03, 0.25, 1.0, 0.01}[static_cast<std::size_t>(round) % 4];
      const std::size_t beads = 3 + random() % 5;
      events += run_balls(there_and_back(random_motion<Space>(random, beads, kind)), share);
      events += run_balls(there_and_back(random_motion<BezierMotion<2, 1>>(random, beads, kind)), share);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(events, static_cast<std::uint64_t>(rounds(40)));
}

// A protein with beads of two sizes, where most nodes are large enough to be relaxed.
TEST(RelaxedHierarchy, AProteinWithTwoSizesOfBeads) {
  std::vector<Space> steps = trajectory_steps("villin_hp36_300K.dcd", 0, 2);
  for (Space& motion : steps) {
    for (BeadId b = 0; b < motion.bead_count(); ++b) {
      const double radius = b % 3 == 0 ? 0.5 : 0.75;
      for (int k = 0; k <= 1; ++k) {
        motion.set_radius(b, k, radius);
        motion.set_weight(b, k, radius * radius);
      }
    }
  }
  const std::uint64_t relaxed = run_balls(steps, 0.03);
  EXPECT_GT(relaxed, 0U);
  RelaxedRig<Space> plain(steps.front(), AuditMode::none, Kernel::filtered, 0, Radii::any);
  plain.run(steps);
  EXPECT_LT(3 * relaxed, 2 * plain.external_events());
}

}  // namespace
}  // namespace kds::relaxed_hierarchy_test
