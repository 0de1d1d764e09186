#include "structures/basis.h"
#include "motions/whole_view.h"

#include <gmock/gmock.h>

#include "structures/bead_names.h"
#include "tests/support/exact_checks.h"
#include "tests/support/moving_beads.h"

namespace kds {
namespace {

using namespace test;

Basis basis_of(std::initializer_list<BeadId> beads) { return Basis(std::span(beads.begin(), beads.size())); }

/// Signs at a time, on integers.
struct Decide {
  const Space& motion;
  Dyadic time{0.0};
  template <class Certificate>
  int operator()(const Certificate& c) const {
    return function_of(c, MomentView<Space>(motion, c.beads, time)).scaled[0].sign();
  }
};
static_assert(SignDecider<Decide>);

/// Does not know.
struct Zero {
  template <class Certificate>
  int operator()(const Certificate&) const {
    return 0;
  }
};
struct Contrary {
  template <class Certificate>
  int operator()(const Certificate&) const {
    return -1;
  }
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
  Decide decide{motion};
  const auto inside = [&](const Basis& basis, BeadId bead) {
    return is_inside(basis, bead, orientation_of(basis, decide), decide);
  };
  const auto sign = [&](const Basis& basis, BeadId bead, bool wanted) {
    return visit_membership(basis, bead, wanted, orientation_of(basis, decide),
                            [&](const auto& c) { return decide(c); });
  };
  EXPECT_TRUE(inside(basis_of({0}), 7));  // the same place
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
  Decide decide{motion};
  EXPECT_FALSE(is_proper(Basis(), decide));
  EXPECT_TRUE(is_proper(basis_of({3}), decide));
  EXPECT_TRUE(is_proper(basis_of({0, 1}), decide));
  EXPECT_FALSE(is_proper(basis_of({0, 6}), decide));     // in one place
  EXPECT_FALSE(is_proper(basis_of({0, 1, 2}), decide));  // a right angle
  EXPECT_TRUE(is_proper(basis_of({0, 1, 3}), decide));   // acute
  EXPECT_FALSE(is_proper(basis_of({0, 1, 4}), decide));  // obtuse
  EXPECT_TRUE(is_proper(basis_of({0, 1, 3, 5}), decide));
  EXPECT_FALSE(is_proper(basis_of({0, 1, 4, 5}), decide));  // the centre is off the tetrahedron
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
    Decide decide{motion};
    const auto basis = basis_among(beads, decide);
    ASSERT_TRUE(basis) << testing::PrintToString(points);
    ++sizes[basis->size];
    ASSERT_EQ(not_smallest_sphere(exact_points(motion, Dyadic(0.0)), 0, static_cast<BeadId>(count - 1),
                                  {basis->begin(), basis->end()}, true),
              std::nullopt)
        << testing::PrintToString(points);
    ASSERT_TRUE(is_proper(*basis, decide));
  }
  for (std::size_t size = 1; size <= 4; ++size) EXPECT_GT(sizes[size], 50) << size;
}

TEST(Basis, NoneIfTheSignsContradictThemselves) {
  const std::vector<BeadId> beads{0, 1, 2, 3, 4};
  Zero zero;
  Contrary contrary;
  EXPECT_TRUE(basis_among(beads, zero).has_value());  // all in one place, for all it knows
  EXPECT_FALSE(basis_among(beads, contrary).has_value());
  EXPECT_EQ(basis_among(std::span(beads).first(1), contrary)->size, 1);
}

TEST(BeadNames, NamesInfinity) {
  EXPECT_EQ(bead_names(std::array<BeadId, 3>{3, 7, no_bead}), "3, 7, infinity");
  EXPECT_EQ(bead_names({}), "");
}

}  // namespace
}  // namespace kds
