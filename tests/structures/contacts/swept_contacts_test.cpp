#include "structures/contacts/swept_contacts.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "structures/chord_cages/chord_cages.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/cages_hold.h"
#include "tests/support/rounds.h"

namespace kds::swept_contacts_test {
namespace {

using namespace test;

/// Returns whether two balls meet in linear motion. The squared distance minus the squared sum of radii is a
/// quadratic over rationals, which is evaluated at its minimum.
template <class M>
bool meet(const M& motion, const BeadPair& pair) {
  const auto excess = [&](const Rational& u) {
    const auto a = ball_of<M::dimension>(motion, pair.first, u),
               b = ball_of<M::dimension>(motion, pair.second, u);
    Rational sum = -(a.radius + b.radius) * (a.radius + b.radius);
    for (std::size_t axis = 0; axis < M::dimension; ++axis)
      sum += (a.center[axis] - b.center[axis]) * (a.center[axis] - b.center[axis]);
    return sum;
  };
  const Rational half = Rational(1) / 2;
  const Rational start = excess(0), middle = excess(half), end = excess(1);
  if (start <= 0 || end <= 0) return true;
  const Rational curvature = 2 * (start + end - 2 * middle), slope = end - start - curvature;
  if (curvature <= 0) return false;
  const Rational u = -slope / (2 * curvature);
  return u > 0 && u < 1 && excess(u) <= 0;
}

template <class M>
std::vector<BeadPair> all_that_meet(const M& motion, const PairsAsked& asked) {
  std::vector<BeadPair> pairs;
  for (BeadId a = 0; a < motion.bead_count(); ++a)
    for (BeadId b = a + 1; b < motion.bead_count(); ++b)
      if (asked.asks({a, b}) && meet(motion, {a, b})) pairs.push_back({a, b});
  return pairs;
}

template <class Hierarchy, class M>
void expect_all_found(const M& motion, const PairsAsked& asked, std::size_t& meeting) {
  constexpr int d = M::dimension;
  const Curves<d> curves(motion);
  ChordCages<Hierarchy> cages(asked.necklaces, 1);
  cages.move_to(curves);
  SweptContacts<d> query(cages.tree(), asked);
  FoundPairs found;
  query.find(cages.cages(0), cages.cages(1), curves, found);
  std::sort(found.pairs.begin(), found.pairs.end());
  ASSERT_EQ(found.pairs, all_that_meet(motion, asked));
  meeting += found.pairs.size();
  // A motion at rest: the pairs that meet are those that meet at the start.
  M still = motion;
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int axis = 0; axis < d; ++axis) still.set_coordinate(b, 1, axis, motion.coordinate(b, 0, axis));
    still.set_radius(b, 1, motion.radius(b, 0));
  }
  query.find_static(cages.cages(0), curves, 0, found);
  std::sort(found.pairs.begin(), found.pairs.end());
  ASSERT_EQ(found.pairs, all_that_meet(still, asked));
}

template <class M>
class SweptContactsIn : public testing::Test {};
using Motions = testing::Types<BezierMotion<2, 1>, BezierMotion<3, 1>>;
TYPED_TEST_SUITE(SweptContactsIn, Motions);

TYPED_TEST(SweptContactsIn, FindAllThatMeetInAStepAndNoOthers) {
  constexpr int d = TypeParam::dimension;
  Random random(21);
  std::size_t meeting = 0;
  for (const MotionKind kind : all_motion_kinds) {
    for (int round = 0; round < rounds(12); ++round) {
      auto motion = random_motion<TypeParam>(random, 14, kind);
      for (BeadId b = 0; b < 14 && round % 3 > 0; ++b) {
        const double radius = round % 3 == 1 ? 0.125 : uniform(random, 0, 0.3);
        for (int k = 0; k <= 1; ++k) motion.set_radius(b, k, radius);
      }
      if (round >= 9 && kind != MotionKind::mixed_scales) scale(motion, round == 9 ? 400 : -400);
      PairsAsked asked{
          {{0, 7}, {8, 8}, {9, 13}}, round % 4 != 1, static_cast<BeadId>(pick(random, 1, 4)), round % 4 != 2};
      if (round % 7 == 4) asked.at_rest = {true, false, true};
      if (round % 5 == 3) asked.groups = {1, 1, 0, 2, 3, 2, 0, 1, 2, 2, 1, 3, 0, 2};
      expect_all_found<StaticWrappedHierarchy<d>>(motion, asked, meeting);
      expect_all_found<LayeredHierarchy<d>>(motion, asked, meeting);
      ASSERT_FALSE(this->HasFatalFailure()) << static_cast<int>(kind) << ", round " << round;
    }
  }
  EXPECT_GT(meeting, rounds(300U));
}

// Touching at one moment, and missing each other by an ulp.
TEST(SweptContacts, TouchingCounts) {
  const double gap = 0x1p-50;
  for (const double height : {1.0, 1.0 + gap}) {
    Space motion = moving({{-1, 0, 0}, {0, height, 0}}, {{1, 0, 0}, {0, height, 0}});
    for (BeadId b = 0; b < 2; ++b)
      for (int k = 0; k <= 1; ++k) motion.set_radius(b, k, 0.5);
    std::size_t meeting = 0;
    expect_all_found<StaticWrappedHierarchy<3>>(motion, {{{0, 1}}, true, 1, true}, meeting);
    EXPECT_EQ(meeting, height == 1 ? 1U : 0U);
  }
}

TEST(SweptContacts, FindThoseOfTrajectories) {
  for (Space& motion : trajectory_steps("villin_hp36_300K.dcd", 0, 1)) {
    std::size_t meeting = 0;
    for (BeadId b = 0; b < motion.bead_count(); ++b)
      for (int k = 0; k <= 1; ++k) motion.set_radius(b, k, 3);
    const PairsAsked asked{{{0, static_cast<BeadId>(motion.bead_count() - 1)}}, true, 4, true};
    expect_all_found<StaticWrappedHierarchy<3>>(motion, asked, meeting);
    EXPECT_GT(meeting, 10U);
  }
}

TEST(SweptContacts, RefusesCurves) {
  const BezierMotion<3, 3> motion(4);
  const std::vector<BeadRange> necklace{{0, 3}};
  ChordCages<StaticWrappedHierarchy<3>> cages(necklace, 3);
  cages.move_to(Curves<3>(motion));
  SweptContacts<3> query(cages.tree(), {necklace, true, 1, true});
  FoundPairs found;
  EXPECT_THROW(query.find(cages.cages(0), cages.cages(3), Curves<3>(motion), found), std::invalid_argument);
}

}  // namespace
}  // namespace kds::swept_contacts_test
