// Compares the conditions of a necklace with all pairs over rationals.

#include "structures/necklace/necklace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "motions/base/input_error.h"
#include "motions/models/shapes.h"
#include "motions/numbers/exact_number.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"
#include "tests/support/rounds.h"

namespace kds::necklace_test {
namespace {

using List = std::vector<Violation>;

struct Scene {
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;
  std::vector<BeadRange> ranges;

  [[nodiscard]] std::vector<Necklace> necklaces() const {
    std::vector<Necklace> result;
    for (const BeadRange& range : ranges) result.emplace_back(range, centers, radii);
    return result;
  }
};

Rational squared(const Scene& scene, BeadId a, BeadId b) {
  Rational sum = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Rational x =
        Rational(scene.centers(axis, Eigen::Index{a})) - Rational(scene.centers(axis, Eigen::Index{b}));
    sum += x * x;
  }
  return sum;
}

// Follows the definitions in quadratic time.
std::array<List, 5> brute_force(const Scene& scene, double rho) {
  std::array<List, 5> found;
  const auto add = [&](Condition c, BeadId a, BeadId b) {
    found[static_cast<std::size_t>(c)].push_back({a, b});
  };
  const auto necklace_of = [&](BeadId bead) {
    return std::find_if(scene.ranges.begin(), scene.ranges.end(),
                        [&](const BeadRange& r) { return r.first <= bead && bead <= r.last; });
  };
  for (BeadId i = 0; i < scene.radii.size(); ++i) {
    for (BeadId j = i + 1; j < scene.radii.size(); ++j) {
      const Rational r(scene.radii[i]), s(scene.radii[j]), d = squared(scene, i, j);
      const bool adjacent = j == i + 1 && necklace_of(i) == necklace_of(j);
      const bool meet = d <= (r + s) * (r + s);
      if (adjacent && !meet) add(Condition::connected, i, j);
      if (!adjacent && meet) add(Condition::disjoint, i, j);
      if (d > (r - s) * (r - s)) continue;
      if (r < s) {
        add(Condition::uncontained, i, j);
      } else {
        add(Condition::uncontained, j, i);
      }
    }
  }
  for (const BeadRange& range : scene.ranges) {
    BeadId largest = range.first, longest = range.first;
    for (BeadId b = range.first; b <= range.last; ++b)
      if (scene.radii[b] > scene.radii[largest]) largest = b;
    for (BeadId b = range.first; b < range.last; ++b)
      if (squared(scene, b, b + 1) > squared(scene, longest, longest + 1)) longest = b;
    const auto too_small = [&](const Rational& x, const Rational& most, int power) {
      if (std::isinf(rho)) return x == 0 && most > 0;
      return x * (power == 2 ? Rational(rho) * Rational(rho) : Rational(rho)) < most;
    };
    for (BeadId b = range.first; b <= range.last; ++b)
      if (too_small(scene.radii[b], scene.radii[largest], 1)) add(Condition::uniform_radii, b, largest);
    for (BeadId b = range.first; b < range.last; ++b)
      if (too_small(squared(scene, b, b + 1), squared(scene, longest, longest + 1), 2))
        add(Condition::uniform_bonds, b, longest);
  }
  for (List& list : found) std::sort(list.begin(), list.end());
  return found;
}

// Returns the number of violations of each condition.
std::array<std::size_t, 5> check(const Scene& scene, double rho = std::numeric_limits<double>::infinity()) {
  const auto expected = brute_force(scene, rho);
  std::array<std::size_t, 5> counts{};
  for (const std::size_t most : {std::numeric_limits<std::size_t>::max(), std::size_t{3}, std::size_t{0}}) {
    const NecklaceReport report = validate(scene.necklaces(), {rho, most});
    for (const Condition condition : kConditions) {
      const auto c = static_cast<std::size_t>(condition);
      List listed = expected[c];
      counts[c] = listed.size();
      EXPECT_EQ(report[condition].count, listed.size()) << name_of(condition);
      if (listed.size() > most) listed.resize(most);
      EXPECT_EQ(report[condition].listed, listed) << name_of(condition);
    }
    EXPECT_EQ(report.proper(), std::all_of(counts.begin(), counts.end(), [](auto n) { return n == 0; }));
  }
  return counts;
}

Scene scene(const std::vector<Eigen::Vector4d>& balls, std::vector<BeadRange> ranges = {}) {
  Scene result{Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(balls.size())), {}, std::move(ranges)};
  for (const Eigen::Vector4d& ball : balls) {
    result.centers.col(static_cast<Eigen::Index>(result.radii.size())) = ball.head<3>();
    result.radii.push_back(ball[3]);
  }
  if (result.ranges.empty()) result.ranges = {{0, static_cast<BeadId>(balls.size() - 1)}};
  return result;
}

TEST(Necklace, TouchingBallsInARowAreProper) {
  EXPECT_EQ(check(scene({{0, 0, 0, 1}, {2, 0, 0, 1}, {5, 0, 0, 2}})), (std::array<std::size_t, 5>{}));
  EXPECT_EQ(check(scene({{0, 0, 0, 0}})), (std::array<std::size_t, 5>{}));
}

TEST(Necklace, EachConditionIsReportedByItsBeads) {
  // 0 and 1 are apart; 1 and 3 touch; 3 contains 4 and touches it from inside; 5 is a point.
  const Scene broken =
      scene({{-3, 0, 0, 0.9}, {0, 0, 0, 2}, {3, 0, 0, 1}, {0, 4, 0, 2}, {0, 5, 0, 1}, {0, 6, 0, 0}});
  const NecklaceReport report = validate(broken.necklaces());
  EXPECT_EQ(report[Condition::connected].listed, (List{{0, 1}, {2, 3}}));
  EXPECT_EQ(report[Condition::disjoint].listed, (List{{1, 3}, {3, 5}}));
  EXPECT_EQ(report[Condition::uncontained].listed, (List{{4, 3}, {5, 3}, {5, 4}}));
  EXPECT_EQ(report[Condition::uniform_radii].listed, (List{{5, 1}}));
  EXPECT_EQ(report[Condition::uniform_bonds].count, 0U);
  EXPECT_FALSE(report.proper());
  const NecklaceReport strict = broken.necklaces().front().validate({2, 10});
  EXPECT_EQ(strict[Condition::uniform_radii].listed, (List{{0, 1}, {5, 1}}));  // the ratio 2 is just uniform
  EXPECT_EQ(strict[Condition::uniform_bonds].listed, (List{{3, 2}, {4, 2}}));
  check(broken);
  check(broken, 2);
}

TEST(Necklace, AnUlpDecides) {
  const double above = std::nextafter(2.0, 3.0), below = std::nextafter(2.0, 1.0);
  EXPECT_EQ(check(scene({{0, 0, 0, 1}, {above, 0, 0, 1}}))[0], 1U);
  EXPECT_EQ(check(scene({{0, 0, 0, 1}, {2, 0, 0, 1}}))[0], 0U);
  EXPECT_EQ(check(scene({{0, 0, 0, 1}, {below, 0, 0, 1}}))[0], 0U);
  EXPECT_EQ(check(scene({{0, 0, 0, 1}, {0x1p-30, above, 0, 1}}))[0], 1U);
  // Beads 0 and 2 have distance 5, by the triangle 3, 4, 5. Doubles cannot represent an overlap of 2^-60 in
  // one coordinate.
  EXPECT_EQ(check(scene({{0, 0, 0, 2}, {1, 1, 0, 1}, {3, 4, 0, 3}}))[1], 1U);
  EXPECT_EQ(check(scene({{0, 0, 0, 2}, {1, 1, 0, 1}, {3, 4, 0x1p-60, 3}}))[1], 0U);
  // Bead 1 is inside by an ulp, or is not inside.
  EXPECT_EQ(check(scene({{0, 0, 0, 3}, {2, 0, 0, 1}}))[2], 1U);
  EXPECT_EQ(check(scene({{0, 0, 0, 3}, {2, 0x1p-60, 0, 1}}))[2], 0U);
  // Radii are uniform by an ulp, or are not.
  EXPECT_EQ(check(scene({{0, 0, 0, 1}, {2, 0, 0, 2}}), 2)[3], 0U);
  EXPECT_EQ(check(scene({{0, 0, 0, 1}, {2, 0, 0, above}}), 2)[3], 1U);
  EXPECT_EQ(check(scene({{0, 0, 0, 1}, {1, 0, 0, 1}, {3, 0, 0, 1}}), 2)[4], 0U);
  EXPECT_EQ(check(scene({{0, 0, 0, 1}, {1, 0, 0, 1}, {3, 0x1p-40, 0, 1}}), 2)[4], 1U);
}

TEST(Necklace, AtExtremesOfScale) {
  const std::vector<Eigen::Vector4d> chain{
      {0, 0, 0, 1}, {2, 0, 0, 1}, {3, 1, 0, 0.5}, {2, 3, 0, 1}, {2, 3, 0, 1}};
  for (const double scale : {0x1p-1073, 0x1p-1000, 0x1p-500, 0x1p500, 0x1p1000, 0x1p1021}) {
    auto scaled = chain;
    for (auto& ball : scaled) ball *= scale;
    EXPECT_EQ(check(scene(scaled)), check(scene(chain))) << scale;
    if (scale < 0x1p-1070) continue;  // half of the smallest number rounds to zero
    EXPECT_EQ(check(scene(scaled), 1.5), check(scene(chain), 1.5)) << scale;
  }
  check(scene({{0, 0, 0, 1e-300}, {1e-300, 0, 0, 1}, {1e300, 0, 0, 1e300}, {-1e300, 0, 0, 1e-308}}), 1e9);
}

TEST(Necklace, SeveralInOneScene) {
  // The last bead of one necklace touches the first bead of the other: that is no bond, but a contact.
  const Scene two = scene({{0, 0, 0, 1}, {2, 0, 0, 1}, {4, 0, 0, 1}, {6, 0, 0, 4}}, {{0, 1}, {2, 3}});
  const NecklaceReport report = validate(two.necklaces(), {2});
  EXPECT_EQ(report[Condition::connected].count, 0U);
  EXPECT_EQ(report[Condition::disjoint].listed, (List{{1, 2}, {1, 3}}));
  EXPECT_EQ(report[Condition::uniform_radii].listed, (List{{2, 3}}));
  EXPECT_TRUE(two.necklaces()[0].validate({2}).proper());
  check(two, 2);
  EXPECT_TRUE(validate(scene({{0, 0, 0, 1}, {9, 0, 0, 4}}, {{0, 0}, {1, 1}}).necklaces(), {2}).proper());
}

TEST(Necklace, AgainstAllPairsOnRandomScenes) {
  std::mt19937 random(7);
  const auto number = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  std::array<std::size_t, 5> total{};
  for (int round = 0; round < test::rounds(300); ++round) {
    std::vector<Eigen::Vector4d> balls;
    const int beads = number(1, 40);
    for (int i = 0; i < beads; ++i)  // whole numbers, which make many ties
      balls.emplace_back(number(-4, 4), number(-4, 4), round % 2 == 0 ? 0 : number(-4, 4),
                         round % 3 == 0 ? 1 : std::exp2(number(-3, 1)) * (number(0, 9) > 0));
    std::vector<BeadRange> ranges;
    for (BeadId first = 0; first < balls.size();) {
      const auto last =
          std::min<BeadId>(first + static_cast<BeadId>(number(0, 30)), static_cast<BeadId>(beads) - 1);
      ranges.push_back({first, last});
      first = last + 1;
    }
    const auto counts =
        check(scene(balls, ranges), round % 4 == 0 ? 2.0 : std::numeric_limits<double>::infinity());
    for (std::size_t c = 0; c < 5; ++c) total[c] += counts[c];
  }
  for (const std::size_t count : total) EXPECT_GT(count, test::rounds(50U));
}

TEST(Necklace, Extents) {
  const Scene chain = scene({{0, 0, 0, 1}, {3, 4, 0, 2}, {3, 5, 0, 4}});
  const Necklace necklace = chain.necklaces().front();
  EXPECT_EQ(necklace.radii().ratio(), 4);
  EXPECT_EQ(necklace.bonds().least, 1);
  EXPECT_EQ(necklace.bonds().most, 5);
  EXPECT_EQ(necklace.bonds().ratio(), 5);
  EXPECT_EQ(Necklace({1, 1}, chain.centers, chain.radii).bonds().ratio(), 1);
}

TEST(Necklace, RefusesNumbersThatAreNone) {
  for (const double wrong : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    EXPECT_THROW(static_cast<void>(scene({{0, wrong, 0, 1}}).necklaces()), InputError);
    EXPECT_THROW(static_cast<void>(scene({{0, 0, 0, wrong}}).necklaces()), InputError);
  }
  EXPECT_THROW(static_cast<void>(scene({{0, 0, 0, -1}}).necklaces()), InputError);
}

TEST(Necklace, OfRealFiles) {
  const auto counts = [](const std::string& name, const std::string& radius) {
    const std::vector<Trajectory> read{
        read_trajectory(std::string(KDS_DATA_DIR) + "/" + name, {.frames = {0, 1}})};
    const auto beads = static_cast<BeadId>(read[0].bead_count());
    return check({read[0].frames[0], bead_radii(radius, read), {{0, beads - 1}}});
  };
  // The radius "auto", half of the longest bond, connects all consecutive beads up to its rounding, and
  // separates the other beads.
  const auto villin = counts("trajectories/villin_hp36_300K.pdb", "auto");
  EXPECT_LE(villin[0], 1U);
  EXPECT_EQ(villin[1], 0U);
  EXPECT_EQ(villin[2], 0U);
  EXPECT_GT(counts("trajectories/villin_hp36_300K.pdb", "element")[1], 100U);
  EXPECT_EQ(counts("trajectories/villin_hp36_300K.pdb", "element:fit")[1], 0U);
  EXPECT_GE(counts("proteins/2f4k.pdb", "0.7")[0], 20U);  // all bonds except C-N are longer than 1.4
}

TEST(Necklace, ManyBeadsTakeLittleTime) {
  // Quadratic time would take minutes. The grid has many ties, because all bonds and all rows touch.
  Eigen::Matrix3Xd grid = models::packed_grid(50000, 3, 0, 1);
  const std::vector<double> radii(50000, 1);
  const NecklaceReport report = Necklace({0, 49999}, grid, radii).validate({2, 5});
  EXPECT_GT(report[Condition::disjoint].count, 50000U);
  EXPECT_EQ(report[Condition::disjoint].listed.size(), 5U);
  EXPECT_EQ(report[Condition::uncontained].count, 0U);
}

}  // namespace
}  // namespace kds::necklace_test
