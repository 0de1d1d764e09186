#include "structures/enclosing_sphere/basis.h"

#include <gmock/gmock.h>

#include "motions/views/integer_view.h"

#include "structures/enclosing_sphere/exact_sphere.h"
#include "structures/hierarchy/signs_just_after.h"
#include "structures/necklace/bead_pairs.h"
#include "tests/support/inputs/ball_sets.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/judges/exact_checks.h"

namespace kds::basis_test {
namespace {

using namespace test;

Basis basis_of(std::initializer_list<BeadId> beads) { return Basis(std::span(beads.begin(), beads.size())); }

/// Computes signs at the start, in integers.
struct AtStart {
  const Space& motion;
  template <class Certificate>
  int operator()(const Certificate& c) const {
    return sgn(function_of(c, MomentView<Space>(motion, c.beads, Dyadic(0.0))).scaled[0]);
  }
  template <int Dimension, int Size>
  int operator()(const BallInSphere<Dimension, Size>&) const {
    ADD_FAILURE() << "radii are equal";
    return 0;
  }
};
MembershipSigns<3, AtStart> signs_of(const Space& motion) {
  return {Curves<3>(motion), Radii::equal, {motion}};
}
static_assert(SphereSigns<MembershipSigns<3, AtStart>>);

/// Always gives the same answer: zero (undecided), or an answer that contradicts the positions.
template <int answer>
struct Always {
  static constexpr int dimension = 3;
  int membership(const Basis&, BeadId, bool, int) const { return answer; }
  int orientation(const Basis&) const { return answer; }
};

/// Computes signs by exact spheres, without certificates.
template <int Dimension>
struct BySpheres {
  static constexpr int dimension = Dimension;
  const Balls<Dimension>& balls;
  int unit = whole_unit(balls, 0, static_cast<BeadId>(balls.size() - 1));

  int membership(const Basis& basis, BeadId bead, bool inside, int) const {
    std::vector<IntegerBall<Dimension>> members;
    for (const BeadId b : basis) members.push_back(whole_ball(balls, b, unit));
    const auto sphere = kds::ExactSphere<Dimension>::touching(members);
    // The algorithm must ask only about proper bases.
    EXPECT_TRUE(sphere && sphere->is_proper());
    const bool holds = sphere && sphere->holds(whole_ball(balls, bead, unit));
    return holds == inside ? 1 : -1;
  }
  int orientation(const Basis&) const { return 1; }
};

TEST(Basis, HoldsItsBeadsAscending) {
  const Basis basis = basis_of({7, 2, 9, 4});
  EXPECT_THAT(std::vector(basis.begin(), basis.end()), testing::ElementsAre(2, 4, 7, 9));
  EXPECT_EQ(basis, basis_of({9, 7, 4, 2}));
  EXPECT_FALSE(basis == basis_of({9, 7, 4}));
  EXPECT_FALSE(basis_of({1, 2}) == basis_of({1, 3}));
  EXPECT_TRUE(basis.contains(9));
  EXPECT_FALSE(basis.contains(3));
  EXPECT_FALSE(basis_of({1}).contains(0));  // unused places do not count
  EXPECT_EQ(Basis(), Basis());
}

TEST(Basis, Without) {
  EXPECT_EQ(without(basis_of({2, 4, 7, 9}), 7), basis_of({2, 4, 9}));
  EXPECT_EQ(without(basis_of({2, 4}), 2), basis_of({4}));
  EXPECT_EQ(without(basis_of({2, 4}), 5), basis_of({2, 4}));
}

TEST(Basis, MembershipOfEverySize) {
  const Space motion = moving(
      {{0, 0, 0}, {4, 0, 0}, {2, 5, 0}, {2, 2, 4}, {2, 1, 1}, {2, -2, 0}, {9, 9, 9}, {0, 0, 0}}, Points(8));
  auto signs = signs_of(motion);
  const auto inside = [&](const Basis& basis, BeadId bead) {
    return is_inside(basis, bead, orientation_of(basis, signs), signs);
  };
  const auto sign = [&](const Basis& basis, BeadId bead, bool wanted) {
    return signs.membership(basis, bead, wanted, orientation_of(basis, signs));
  };
  EXPECT_TRUE(inside(basis_of({0}), 7));  // the same position
  EXPECT_FALSE(inside(basis_of({0}), 1));
  EXPECT_TRUE(inside(basis_of({0, 1}), 4));
  EXPECT_TRUE(inside(basis_of({0, 1}), 5));  // on the sphere
  EXPECT_EQ(sign(basis_of({0, 1}), 5, true), 0);
  EXPECT_FALSE(inside(basis_of({0, 1}), 2));
  for (const std::vector<BeadId>& beads : {std::vector<BeadId>{0, 1}, {0, 1, 2}, {0, 1, 2, 3}}) {
    const Basis basis{std::span(beads)};
    EXPECT_TRUE(inside(basis, 4)) << beads.size();
    EXPECT_FALSE(inside(basis, 6)) << beads.size();
    EXPECT_EQ(sign(basis, 4, true), 1) << beads.size();
    EXPECT_EQ(sign(basis, 4, false), -1) << beads.size();
    EXPECT_EQ(sign(basis, 6, true), -1) << beads.size();
  }
}

TEST(Basis, ProperIffNoBeadIsToSpare) {
  const Space motion =
      moving({{-4, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 5, 0}, {0, 1, 0}, {0, 0, 6}, {-4, 0, 0}, {0, -2, -3}},
             Points(8));
  auto signs = signs_of(motion);
  EXPECT_FALSE(is_proper(Basis(), signs));
  EXPECT_TRUE(is_proper(basis_of({3}), signs));
  EXPECT_TRUE(is_proper(basis_of({0, 1}), signs));
  EXPECT_FALSE(is_proper(basis_of({0, 6}), signs));     // in one place
  EXPECT_FALSE(is_proper(basis_of({0, 1, 2}), signs));  // a right angle
  EXPECT_TRUE(is_proper(basis_of({0, 1, 3}), signs));   // acute
  EXPECT_FALSE(is_proper(basis_of({0, 1, 4}), signs));  // obtuse
  EXPECT_TRUE(is_proper(basis_of({0, 1, 3, 5}), signs));
  EXPECT_FALSE(is_proper(basis_of({0, 1, 4, 5}), signs));  // the centre is outside the tetrahedron
}

TEST(Basis, AmongUpToFiveBeads) {
  std::mt19937 random(31);
  std::array<int, 5> sizes{};
  for (int round = 0; round < 3000; ++round) {
    const std::size_t count = 1 + random() % 5;
    const int range = 2 + static_cast<int>(random() % 8);
    const Points points = random_grid_points(random, count, range);
    const Space motion = moving(points, points);
    std::vector<BeadId> beads(count);
    for (BeadId b = 0; b < count; ++b) beads[b] = b;
    std::shuffle(beads.begin(), beads.end(), random);
    auto signs = signs_of(motion);
    const auto basis = basis_of_points(beads, signs);
    ASSERT_TRUE(basis) << testing::PrintToString(points);
    ++sizes[basis->size];
    ASSERT_EQ(not_smallest_sphere(exact_points(motion, Dyadic(0.0)), 0, static_cast<BeadId>(count - 1),
                                  {basis->begin(), basis->end()}, true),
              std::nullopt)
        << testing::PrintToString(points);
    ASSERT_TRUE(is_proper(*basis, signs));
  }
  for (std::size_t size = 1; size <= 4; ++size) EXPECT_GT(sizes[size], 50) << size;
}

TEST(Basis, NoneIfTheSignsContradictThemselves) {
  const std::vector<BeadId> beads{0, 1, 2, 3, 4};
  Always<0> zero;
  Always<-1> contrary;
  EXPECT_TRUE(basis_of_points(beads, zero).has_value());  // zero signs mean that all beads may coincide
  EXPECT_FALSE(basis_of_points(beads, contrary).has_value());
  EXPECT_EQ(basis_of_points(std::span(beads).first(1), contrary)->size, 1);
}

template <int Dimension>
void expect_bases_of_balls(std::array<int, 5>& sizes) {
  std::mt19937 random(32);
  for (int round = 0; round < 1200; ++round) {
    const std::size_t count = 1 + random() % (Dimension + 2);
    const BallSet set = hard_ball_set(random, static_cast<std::size_t>(round) % hard_ball_sets,
                                      static_cast<Eigen::Index>(count), round % 7 == 0, Dimension == 2);
    const Balls<Dimension> balls(set.centers, set.radii);
    std::vector<BeadId> beads(set.radii.size());
    for (BeadId b = 0; b < beads.size(); ++b) beads[b] = b;
    BySpheres<Dimension> signs{balls};
    const auto basis = BasisOfBalls(beads, signs).find();
    ASSERT_TRUE(basis);
    ++sizes[basis->size];
    ASSERT_TRUE(std::is_sorted(basis->begin(), basis->end()));
    ASSERT_EQ(not_smallest_ball(set, 0, count - 1, {basis->begin(), basis->end()},
                                exact_sphere_of(*basis, balls).radius),
              std::nullopt)
        << set.name;
  }
}

TEST(Basis, OfBallsAsksOnlyWhatHasAnAnswer) {
  std::array<int, 5> sizes{};
  expect_bases_of_balls<3>(sizes);
  for (std::size_t size = 1; size <= 4; ++size) EXPECT_GT(sizes[size], 5) << size;
  sizes = {};
  expect_bases_of_balls<2>(sizes);
  for (std::size_t size = 1; size <= 3; ++size) EXPECT_GT(sizes[size], 5) << size;
}

TEST(Basis, NoneOfBallsIfTheSignsContradictThemselves) {
  const std::vector<BeadId> beads{0, 1, 2, 3, 4};
  Always<-1> contrary;
  Always<1> holding;
  EXPECT_FALSE(BasisOfBalls(beads, contrary).find());
  EXPECT_EQ(BasisOfBalls(beads, holding).find()->size, 1);
}

TEST(BeadNames, NamesInfinity) {
  EXPECT_EQ(bead_names(std::array<BeadId, 3>{3, 7, no_bead}), "3, 7, infinity");
  EXPECT_EQ(bead_names({}), "");
}

}  // namespace
}  // namespace kds::basis_test
