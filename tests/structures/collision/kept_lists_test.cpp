// Pair lists that are kept from frame to frame, compared with all pairs at every frame, for beads that move
// in many ways.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "structures/collision/auto_detector.h"
#include "structures/collision/cell_list.h"
#include "tests/structures/collision/collision_scenes.h"
#include "tests/support/rounds.h"

namespace kds::kept_lists_test {
namespace {

using namespace test;

enum class Moves { rest, slow, fast, slow_then_jump, one_teleports, all_fly_on, together, tail, any };
constexpr unsigned moves_count = 9;

/// Moves the beads by one frame; returns an upper bound of the largest displacement.
double move(CollisionScene& scene, Moves moves, int frame, Random& random) {
  const Eigen::Matrix3Xd before = scene.centers;
  const double unit = 0.5;
  double step = 0;
  if (moves == Moves::slow || moves == Moves::slow_then_jump) step = 0.01 * unit;
  if (moves == Moves::fast) step = unit;
  if (moves == Moves::any && random() % 3 != 0) step = unit * std::exp(uniform(random, -8, 1));
  for (Eigen::Index b = 0; b < scene.centers.cols(); ++b)
    scene.centers.col(b) +=
        step * Eigen::Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  if (moves == Moves::tail) {
    scene.centers.array() += 1e-4;
    for (Eigen::Index b = scene.centers.cols() * 9 / 10; b < scene.centers.cols(); ++b)
      scene.centers.col(b) +=
          unit * Eigen::Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  }
  if (moves == Moves::together) scene.centers.row(0).array() += 0.05;
  if (moves == Moves::all_fly_on) scene.centers *= 1.01;
  if ((moves == Moves::slow_then_jump && frame % 12 == 11) || moves == Moves::one_teleports)
    scene.centers.col(static_cast<Eigen::Index>(random() % scene.radii.size())) *= uniform(random, -2, 2);
  return (scene.centers - before).colwise().norm().maxCoeff() * (1 + 1e-12);
}

/// Returns the number of repairs.
template <int Dimension>
std::uint64_t follow(unsigned seed) {
  Random random(seed);
  CollisionScene scene;
  do {
    scene = random_scene(random, 80);
  } while (scene.centers.cwiseAbs().maxCoeff() > 1e5 || scene.centers.cwiseAbs().maxCoeff() < 1e-5);
  const auto moves = static_cast<Moves>(seed % moves_count);
  constexpr int frames = 40;
  std::vector<Balls<Dimension>> balls;
  std::vector<std::vector<BeadPair>> expected;
  double speed = 0;
  for (int k = 0; k < frames; ++k) {
    if (k > 0) speed = std::max(speed, move(scene, moves, k, random));
    balls.emplace_back(scene.centers, scene.radii);
    expected.push_back(all_pairs(scene.centers, scene.radii, scene.asked, Dimension));
  }
  VerletList<Dimension> verlet(scene.asked, 0.5);
  AutoDetector<Dimension> automatic(scene.asked), plain(scene.asked, std::nullopt, VectorTarget::plain);
  AutoDetector<Dimension> told(scene.asked, speed);
  for (std::size_t k = 0; k < frames; ++k) {
    const std::string what = scene.name + ", frame " + std::to_string(k) + ", moves " +
                             std::to_string(seed % moves_count) + ", seed " + std::to_string(seed);
    EXPECT_EQ(verlet.pairs(balls[k]), expected[k]) << "Verlet list, " << what;
    EXPECT_EQ(automatic.pairs(balls[k]), expected[k]) << "auto, " << what;
    EXPECT_EQ(plain.pairs(balls[k]), expected[k]) << "auto without vectors, " << what;
    EXPECT_EQ(told.pairs(balls[k]), expected[k]) << "auto with a declared speed, " << what;
    if (::testing::Test::HasFailure()) return 0;
  }
  // All vector targets do the same work.
  EXPECT_EQ(automatic.counts().rebuilds, plain.counts().rebuilds);
  EXPECT_EQ(automatic.counts().from_scratch, plain.counts().from_scratch);
  EXPECT_EQ(automatic.counts().repairs, plain.counts().repairs);
  // Pairs of beads at rest are kept from one search on, unless too many are near.
  if (moves == Moves::rest && automatic.counts().from_scratch < frames) {
    EXPECT_EQ(automatic.counts().rebuilds, 1U) << scene.name;
  }
  return automatic.counts().repairs + told.counts().repairs;
}

TEST(KeptLists, SamePairsAtEveryFrameHoweverBeadsMove) {
  std::uint64_t repairs = 0;
  for (unsigned seed = 0; seed < rounds(450U); ++seed) {
    repairs += follow<3>(seed) + follow<2>(seed);
    if (HasFailure()) return;
  }
  EXPECT_GT(repairs, rounds(450U));
}

/// Makes a gas, whose beads are put into spatial order with the last beads in a corner, or straight chains
/// side by side whose beads touch exactly.
CollisionScene many_beads(Random& random, int dimension, bool gas, bool equal) {
  constexpr Eigen::Index beads = 4000;
  CollisionScene scene{
      gas ? "gas" : "chains", Eigen::Matrix3Xd(3, beads), std::vector<double>(beads, 0.5), {}};
  const double size = dimension == 2 ? 100 : 20;
  for (Eigen::Index b = 0; b < beads; ++b) {
    const auto along = static_cast<double>(b % 100), chain = static_cast<double>(b / 100);
    const Eigen::Vector3d anywhere(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1));
    scene.centers.col(b) = Eigen::Vector3d(along, chain, 0);
    if (gas)
      scene.centers.col(b) = size * (b < 3800 ? anywhere : Eigen::Vector3d(0.3 * anywhere.array() + 1));
    if (!equal) scene.radii[static_cast<std::size_t>(b)] = 0.25 * static_cast<double>(1 + b % 2);
  }
  scene.asked = {{{0, 1999}, {2000, 2989}, {2990, 3999}}, true, 2, true};
  return scene;
}

// A tail swings, one bead repeatedly leaves the range of the float conversion and comes back, and all other
// beads creep.
template <int Dimension>
void swing_tail(bool gas, bool equal) {
  Random random(1);
  CollisionScene scene = many_beads(random, Dimension, gas, equal);
  AutoDetector<Dimension> detector(scene.asked);
  CellList<Dimension> cells(scene.asked);
  constexpr std::uint64_t frames = 40;
  for (std::uint64_t k = 0; k < frames; ++k) {
    for (Eigen::Index b = 3800; b < 4000; ++b)
      scene.centers.col(b) +=
          0.3 * Eigen::Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    scene.centers.row(0).array() += 0.002;
    if (k % 10 == 7) scene.centers.col(100) *= -1e3;
    if (k % 10 == 8) scene.centers.col(100) /= -1e3;
    const Balls<Dimension> balls(scene.centers, scene.radii);
    ASSERT_EQ(detector.pairs(balls), cells.pairs(balls)) << scene.name << ", frame " << k;
  }
  EXPECT_GE(detector.counts().repairs, gas ? 1 : frames / 2) << scene.name;
  // Whether repairs pay for beads in spatial order depends on the processor's vector width, so only chains
  // are checked.
  if (!gas) {
    EXPECT_LE(detector.counts().from_scratch + detector.counts().rebuilds, frames / 3) << scene.name;
  }
}

TEST(KeptLists, PairsOfFewBlocksAreRepaired) {
  for (const bool gas : {false, true}) {
    for (const bool equal : {false, true}) {
      swing_tail<3>(gas, equal);
      swing_tail<2>(gas, equal);
    }
  }
}

Eigen::Matrix3Xd straight(std::size_t beads, double y) {
  Eigen::Matrix3Xd c(3, static_cast<Eigen::Index>(beads));
  for (Eigen::Index b = 0; b < c.cols(); ++b) c.col(b) = Eigen::Vector3d(static_cast<double>(b), y, 0);
  return c;
}

// Two distant necklaces. Once the distance is known, no coordinates are read until the necklaces could have
// come near.
TEST(KeptLists, DistantNecklacesAreNotReadWithADeclaredSpeed) {
  Eigen::Matrix3Xd centers(3, 200);
  centers << straight(100, 0), straight(100, 1000);
  const std::vector<double> radii(200, 0.5);
  AutoDetector<3> detector({{{0, 99}, {100, 199}}, false, 2, true}, 0.1);
  for (int k = 0; k < 9995; ++k) {
    const Balls<3> balls(centers, radii);
    const bool meet = centers(1, 100) - centers(1, 0) <= 1;
    const auto& found = detector.pairs(balls);
    ASSERT_EQ(found.empty(), !meet) << k;
    if (k > 9985) {
      ASSERT_EQ(found, all_pairs(centers, radii, detector.tree().asked(), 3)) << k;
    }
    centers.row(1).head(100).array() += 0.05;
    centers.row(1).tail(100).array() -= 0.05;
  }
  EXPECT_GT(detector.counts().unread, 4 * (detector.counts().read + detector.counts().rebuilds));
}

// Two clouds at some distance. A skin as wide as the distance would have to keep all pairs between the
// clouds.
TEST(KeptLists, SkinsAreNotWidenedUntilEverythingIsNear) {
  Random random(1);
  constexpr Eigen::Index count = rounds(6000, 2000);
  Eigen::Matrix3Xd centers(3, 2 * count);
  for (Eigen::Index b = 0; b < centers.cols(); ++b)
    centers.col(b) = Eigen::Vector3d(uniform(random, 0, 20) + (b < count ? 0 : 40), uniform(random, 0, 20),
                                     uniform(random, 0, 20));
  const std::vector<double> radii(2 * count, 0.1);
  const PairsAsked asked{{{0, count - 1}, {count, 2 * count - 1}}, false, 2, true};
  AutoDetector<3> detector(asked);
  for (int k = 0; k < 30; ++k) {
    centers.row(0).head(count).array() += 0.5;
    const Balls<3> balls(centers, radii);
    const auto& found = detector.pairs(balls);
    ASSERT_EQ(found, CellList<3>(asked).pairs(balls)) << k;
    ASSERT_LE(detector.kept(), 32U * 2 * count);
  }
}

// A pair is found again while its unmarked bead is displaced, and meets when that bead is back at its place.
TEST(KeptLists, ABeadWithoutAMarkMayGoBack) {
  const std::vector<double> radii(2, 0.5);
  Eigen::Matrix3Xd centers = straight(2, 0);
  const Balls<3> together(centers, radii);
  centers(0, 1) = 1.4;
  const Balls<3> away(centers, radii);
  KeptPairs<3> kept;
  const std::vector<BeadPair> both{{0, 1}};
  const std::vector<unsigned char> first_is_marked{1, 0};
  std::vector<BeadPair> meeting;
  kept.keep(together, both, 1, fit_float_conversion(scene_box(together), 1));
  kept.replace(away, first_is_marked, both, 0.4);
  EXPECT_EQ(kept.size(), 1U);
  kept.find_meeting(away, 0.4, meeting);
  EXPECT_TRUE(meeting.empty());
  kept.find_meeting(together, 0, meeting);
  EXPECT_EQ(meeting, both);
}

TEST(KeptLists, ChangedRadiiAreNoticed) {
  const Eigen::Matrix3Xd centers = straight(50, 0);
  AutoDetector<3> detector({{{0, 49}}, true, 2, true});
  for (const double radius : {0.4, 0.4, 0.4, 1.1, 1.1, 1.1, 0.4}) {
    const std::vector<double> radii(50, radius);
    ASSERT_EQ(detector.pairs(Balls<3>(centers, radii)),
              all_pairs(centers, radii, detector.tree().asked(), 3));
  }
}

TEST(KeptLists, SlowMotionKeepsAndFastMotionDoesNot) {
  Random random(1);
  for (const double step : {0.001, 2.0}) {
    Eigen::Matrix3Xd centers = straight(300, 0);
    const std::vector<double> radii(300, 0.5);
    AutoDetector<3> detector({{{0, 299}}, true, 2, true});
    constexpr unsigned frames = rounds(60U, 20U);
    for (unsigned k = 0; k < frames; ++k) {
      for (Eigen::Index b = 0; b < centers.cols(); ++b)
        centers.col(b) += step * Eigen::Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), 0);
      ASSERT_EQ(detector.pairs(Balls<3>(centers, radii)),
                all_pairs(centers, radii, detector.tree().asked(), 3));
    }
    if (step < 1) {
      EXPECT_GE(detector.counts().read, frames - 10);
    } else {
      EXPECT_GE(detector.counts().from_scratch, frames - 10);
    }
  }
}

}  // namespace
}  // namespace kds::kept_lists_test
