#include "structures/chord_cages/chord_cages.h"

#include <gmock/gmock.h>

#include "structures/chord_cages/chord_hierarchy.h"
#include "structures/enclosing_sphere/cage.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "tests/support/inputs/ball_sets.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/cages_hold.h"
#include "tests/support/rounds.h"

namespace kds::chord_cages_test {
namespace {

using namespace test;

template <int D>
using Wrapped = ChordCages<StaticWrappedHierarchy<D>>;
template <int D>
using Layered = ChordCages<LayeredHierarchy<D>>;

// Makes a necklace of a few beads, a necklace of a single bead, and a necklace of the rest.
std::vector<BeadRange> necklaces_of(std::size_t beads) {
  const auto n = static_cast<BeadId>(beads);
  if (n < 8) return {{0, n - 1}};
  return {{0, n / 3}, {n / 3 + 1, n / 3 + 1}, {n / 3 + 2, n - 1}};
}

/// Returns a random time: a multiple of 2^-53 or of the inverse of a prime, or an end of the step or a time
/// next to one.
Rational random_time(Random& random) {
  switch (random() % 8) {
    case 0:
      return Rational(0x1p-60);
    case 1:
      return 1 - Rational(0x1p-60);
    case 2:
      return Rational(random() % 10007) / 10007;
    default:
      return Rational(uniform(random, 0, 1));
  }
}

template <class Cages>
std::vector<Cage<Cages::dimension>> controls_of(const Cages& cages, NodeId node) {
  std::vector<Cage<Cages::dimension>> controls;
  for (int k = 0; k <= cages.degree(); ++k) controls.push_back(cages.cages(k)[node]);
  return controls;
}

template <class Cages, Motion M>
void expect_to_hold(const Cages& cages, const M& motion, Random& random, int times) {
  for (NodeId node = 0; node < cages.tree().node_count(); ++node) {
    const auto controls = controls_of(cages, node);
    for (int i = 0; i < times; ++i) {
      const Rational u = i == 0 ? Rational(0) : i == 1 ? Rational(1) : random_time(random);
      ASSERT_EQ(sticks_out<Cages::dimension>(motion, cages.tree().range(node), controls, u, u), std::nullopt);
    }
  }
}

template <template <int> class Cages, Motion M>
void expect_to_hold(const std::vector<M>& steps, Random& random, int times) {
  constexpr int d = M::dimension;
  Cages<d> cages(necklaces_of(steps.front().bead_count()), degree_of(steps.front()));
  cages.build(Curves<d>(steps.front()));
  for (const M& motion : steps) {
    cages.move_to(Curves<d>(motion));
    expect_to_hold(cages, motion, random, times);
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// 0: different and changing radii; 1: equal radii; 2: zero radii; 3: different constant radii.
template <Motion M>
void set_radii(M& motion, Random& random, int which) {
  if (which == 0) return;
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    const double radius = which == 1 ? 0.25 : which == 2 ? 0 : uniform(random, 0, 1);
    for (int k = 0; k <= M::degree; ++k) motion.set_radius(b, k, radius);
  }
}

template <class M>
class ChordCagesIn : public testing::Test {};
using Motions =
    testing::Types<BezierMotion<2, 1>, BezierMotion<3, 1>, BezierMotion<2, 3>, BezierMotion<3, 3>>;
TYPED_TEST_SUITE(ChordCagesIn, Motions);

TYPED_TEST(ChordCagesIn, HoldEveryBeadAtAllTimesOnHardMotions) {
  Random random(1);
  for (const MotionKind kind : all_motion_kinds) {
    for (int which = 0; which < 4; ++which) {
      for (const int exponent : {0, -400, 330, -1000}) {
        auto motion = random_motion<TypeParam>(random, static_cast<std::size_t>(pick(random, 2, 14)), kind);
        set_radii(motion, random, which);
        const bool fits = kind != MotionKind::mixed_scales || exponent == 0;
        if (fits) scale(motion, exponent);
        expect_to_hold<Wrapped>(std::vector{motion}, random, rounds(6, 3));
        expect_to_hold<Layered>(std::vector{motion}, random, rounds(6, 3));
        ASSERT_FALSE(this->HasFatalFailure())
            << "kind " << static_cast<int>(kind) << ", radii " << which << ", 2^" << exponent;
      }
    }
  }
}

// Beads turn by half a turn or more in a step, in opposite directions, so their chords pass near the middle.
TYPED_TEST(ChordCagesIn, HoldBeadsThatTurnFast) {
  constexpr int d = TypeParam::dimension;
  Random random(2);
  for (int round = 0; round < rounds(20, 4); ++round) {
    TypeParam motion(12);
    for (BeadId b = 0; b < 12; ++b) {
      const double angle = uniform(random, 0, 7), turn = (b % 2 == 0 ? 1 : -1) * uniform(random, 2, 4);
      for (int k = 0; k <= TypeParam::degree; ++k) {
        const double now = angle + turn * k / TypeParam::degree;
        motion.set_coordinate(b, k, 0, std::cos(now));
        motion.set_coordinate(b, k, 1, std::sin(now));
        if (d == 3) motion.set_coordinate(b, k, d - 1, 0.01 * b);
        motion.set_radius(b, k, round % 2 == 0 ? 0.1 : 0.02 * b);
      }
    }
    expect_to_hold<Wrapped>(std::vector{motion}, random, 20);
    expect_to_hold<Layered>(std::vector{motion}, random, 20);
    ASSERT_FALSE(this->HasFatalFailure());
  }
}

// Consecutive steps that continue each other, and one step that does not.
TYPED_TEST(ChordCagesIn, AreTheSmallestSpheresAtControlPoints) {
  constexpr int d = TypeParam::dimension;
  Random random(3);
  for (int round = 0; round < rounds(6, 3); ++round) {
    std::vector<TypeParam> steps;
    for (int s = 0; s < 4; ++s) {
      auto motion = random_motion<TypeParam>(random, 17, MotionKind::generic);
      set_radii(motion, random, 1 + round % 3);
      for (BeadId b = 0; b < 17 && s > 0 && s < 3; ++b) {
        for (int axis = 0; axis < d; ++axis)
          motion.set_coordinate(b, 0, axis, steps.back().coordinate(b, TypeParam::degree, axis));
        for (int k = 0; k <= TypeParam::degree; ++k) motion.set_radius(b, k, steps.back().radius(b, 0));
      }
      steps.push_back(motion);
    }
    Wrapped<d> cages(necklaces_of(17), TypeParam::degree);
    cages.build(Curves<d>(steps.front()));
    for (const TypeParam& motion : steps) {
      const Curves<d> curves(motion);
      cages.move_to(curves);
      for (int k = 0; k <= cages.degree(); ++k) {
        const Balls<d> balls(curves, k);
        for (NodeId node = 0; node < cages.tree().node_count(); ++node) {
          const BeadRange& range = cages.tree().range(node);
          const SmallestSphere slow =
              smallest_sphere(balls, range.first, range.last, {}, ExactUse::everywhere);
          const double radius = cages.cages(k)[node].radius;
          EXPECT_GE(radius, slow.sphere.radius * (1 - 0x1p-50));
          EXPECT_LE(radius, slow.sphere.radius * (1 + 1e-12) + 1e-14);
          if (k == cages.degree()) {
            EXPECT_EQ(cages.hierarchy().basis(node), slow.basis);
          }
        }
      }
    }
  }
}

TEST(ChordCages, HoldEveryBeadOfTrajectories) {
  Random random(4);
  for (const char* name : {"villin_hp36_300K.dcd", "random100_400K_first200.dcd"}) {
    ReadOptions options;
    options.frames = {0, rounds(31U, 11U), 10};
    const Trajectory trajectory = read_trajectory(data(std::string("trajectories/") + name), options);
    for (const FrameMotion motion : {FrameMotion::linear, FrameMotion::hermite}) {
      std::vector<double> radii(trajectory.bead_count(), 0.8);
      for (std::size_t b = 0; b < radii.size() && motion == FrameMotion::hermite; b += 3) radii[b] = 0.5;
      const Scene scene(std::span(&trajectory, 1), radii, motion);
      const auto run = [&]<class M>(M step) {
        Wrapped<3> wrapped(scene.necklaces(), M::degree);
        Layered<3> layered(scene.necklaces(), M::degree);
        for (std::size_t k = 0; k < scene.step_count(); ++k) {
          scene.load(k, step);
          wrapped.move_to(Curves<3>(step));
          layered.move_to(Curves<3>(step));
          expect_to_hold(wrapped, step, random, 4);
          expect_to_hold(layered, step, random, 4);
        }
      };
      if (motion == FrameMotion::linear) {
        run(BezierMotion<3, 1>(scene.bead_count()));
      } else {
        run(BezierMotion<3, 3>(scene.bead_count()));
      }
    }
  }
}

TEST(ChordCages, RadiiAreRoundedUpOnHardSets) {
  std::mt19937 random(5);
  for (std::size_t which = 0; which < hard_ball_sets; ++which) {
    for (int round = 0; round < rounds(6, 2); ++round) {
      const BallSet set = hard_ball_set(random, which, 9, round % 2 == 0, false);
      BezierMotion<3, 1> motion(9);
      for (BeadId b = 0; b < 9; ++b) {
        for (int k = 0; k <= 1; ++k) {
          for (int axis = 0; axis < 3; ++axis) motion.set_coordinate(b, k, axis, set.centers(axis, b));
          motion.set_radius(b, k, set.radii[b]);
        }
      }
      Random times(6);
      expect_to_hold<Wrapped>(std::vector{motion}, times, 3);
      expect_to_hold<Layered>(std::vector{motion}, times, 3);
      ASSERT_FALSE(HasFatalFailure()) << set.name;
    }
  }
}

TEST(ChordHierarchy, PassesItsAuditsAndRefusesChanges) {
  const std::vector<Space> steps = trajectory_steps("villin_hp36_300K.dcd", 0, 4);
  const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(steps.front().bead_count() - 1)}};
  Rig<ChordHierarchy<StaticWrappedHierarchy<3>>, Space> wrapped(steps.front(), AuditMode::frames, necklace);
  wrapped.run(steps);
  EXPECT_GT(wrapped.structure.statistics.audits_run, 3U);
  EXPECT_TRUE(wrapped.history.events.empty());
  EXPECT_EQ(wrapped.structure.name(), "wrapped");
  EXPECT_EQ(wrapped.structure.audit(Dyadic(0.375)), std::nullopt);
  EXPECT_THROW(wrapped.structure.apply({}), std::invalid_argument);
  Rig<ChordHierarchy<LayeredHierarchy<3>>, Space> layered(steps.front(), AuditMode::frames, necklace);
  layered.run(steps);
  EXPECT_EQ(layered.structure.name(), "layered");
  EXPECT_EQ(layered.structure.audit(Dyadic(0.375)), std::nullopt);
  // The audit compares cages of one step with the beads of another step, so it must report a fault.
  wrapped.motion = steps.front();
  EXPECT_THAT(*wrapped.structure.audit(Dyadic(0.375)), testing::HasSubstr("sticks out"));
  EXPECT_THAT(*wrapped.structure.audit(Dyadic(1.0)), testing::HasSubstr("outside"));
  layered.motion = steps.front();
  EXPECT_THAT(*layered.structure.audit(Dyadic(1.0)), testing::HasSubstr("not that of its children"));
}

TEST(RoundedUp, IsNeverTooSmall) {
  Random random(7);
  for (int round = 0; round < rounds(20000); ++round) {
    const int exponent = pick(random, -1070, 1020);
    Point<3> a, b;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      a[axis] = std::ldexp(uniform(random), exponent - pick(random, 0, 60));
      b[axis] = std::ldexp(uniform(random), exponent - pick(random, 0, 60));
    }
    const double r = std::ldexp(uniform(random, 0, 1), exponent);
    const double reach = reach_rounded_up<3>(a, b, r);
    if (std::isinf(reach)) continue;
    Rational square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Rational d = Rational(a[axis]) - Rational(b[axis]);
      square += d * d;
    }
    const Rational room = Rational(reach) - Rational(r);
    ASSERT_TRUE(room >= 0 && square <= room * room);
    const Rational less = Rational(reach) * (1 - Rational(0x1p-45)) - Rational(r) - 4 * Rational(0x1p-1074);
    ASSERT_TRUE(less < 0 || square >= less * less) << "not much too large";
  }
}

}  // namespace
}  // namespace kds::chord_cages_test
