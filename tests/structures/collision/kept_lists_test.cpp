// Lists kept from frame to frame, on beads that move in every way, against all pairs at every frame.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "structures/collision/auto_detector.h"
#include "structures/collision/cell_list.h"
#include "structures/collision/verlet_list.h"
#include "tests/structures/collision/collision_scenes.h"
#include "tests/support/rounds.h"

namespace kds {
namespace {

using namespace test;

enum class Moves { rest, slow, fast, slow_then_jump, one_teleports, all_fly_on, together, any };

/// How far the farthest bead goes in this frame.
double move(CollisionScene& scene, Moves moves, int frame, Chance& chance) {
  const Eigen::Matrix3Xd before = scene.centers;
  const double unit = 0.5;
  double step = 0;
  if (moves == Moves::slow || moves == Moves::slow_then_jump) step = 0.01 * unit;
  if (moves == Moves::fast) step = unit;
  if (moves == Moves::any && chance() % 3 != 0) step = unit * std::exp(uniform(chance, -8, 1));
  for (Eigen::Index b = 0; b < scene.centers.cols(); ++b)
    scene.centers.col(b) +=
        step * Eigen::Vector3d(uniform(chance, -1, 1), uniform(chance, -1, 1), uniform(chance, -1, 1));
  if (moves == Moves::together) scene.centers.row(0).array() += 0.05;
  if (moves == Moves::all_fly_on) scene.centers *= 1.01;
  if ((moves == Moves::slow_then_jump && frame % 12 == 11) || moves == Moves::one_teleports)
    scene.centers.col(static_cast<Eigen::Index>(chance() % scene.radii.size())) *= uniform(chance, -2, 2);
  return (scene.centers - before).colwise().norm().maxCoeff() * (1 + 1e-12);
}

template <int Dimension>
void follow(unsigned seed) {
  Chance chance(seed);
  CollisionScene scene;
  do {
    scene = random_scene(chance, 80);
  } while (scene.centers.cwiseAbs().maxCoeff() > 1e5 || scene.centers.cwiseAbs().maxCoeff() < 1e-5);
  const auto moves = static_cast<Moves>(seed % 8);
  constexpr int frames = 40;
  std::vector<Balls<Dimension>> balls;
  std::vector<std::vector<BeadPair>> expected;
  double speed = 0;
  for (int k = 0; k < frames; ++k) {
    if (k > 0) speed = std::max(speed, move(scene, moves, k, chance));
    balls.emplace_back(scene.centers, scene.radii);
    expected.push_back(all_pairs(scene.centers, scene.radii, scene.asked, Dimension));
  }
  VerletList<Dimension> verlet(scene.asked, 0.5);
  AutoDetector<Dimension> automatic(scene.asked), plain(scene.asked, std::nullopt, VectorTarget::plain);
  AutoDetector<Dimension> told(scene.asked, speed);
  for (std::size_t k = 0; k < frames; ++k) {
    const std::string what = scene.name + ", frame " + std::to_string(k) + ", moves " +
                             std::to_string(seed % 8) + ", seed " + std::to_string(seed);
    ASSERT_EQ(verlet.pairs(balls[k]), expected[k]) << "Verlet list, " << what;
    ASSERT_EQ(automatic.pairs(balls[k]), expected[k]) << "auto, " << what;
    ASSERT_EQ(plain.pairs(balls[k]), expected[k]) << "auto without vectors, " << what;
    ASSERT_EQ(told.pairs(balls[k]), expected[k]) << "auto with a declared speed, " << what;
  }
  // The same work on all targets.
  EXPECT_EQ(automatic.counts().rebuilds, plain.counts().rebuilds);
  EXPECT_EQ(automatic.counts().from_scratch, plain.counts().from_scratch);
  if (moves == Moves::rest) {
    EXPECT_EQ(automatic.counts().rebuilds, 1U) << scene.name;
  }
}

TEST(KeptLists, SamePairsAtEveryFrameHoweverBeadsMove) {
  for (unsigned seed = 0; seed < rounds(400U); ++seed) {
    follow<3>(seed);
    follow<2>(seed);
    if (HasFatalFailure()) return;
  }
}

Eigen::Matrix3Xd straight(std::size_t beads, double y) {
  Eigen::Matrix3Xd c(3, static_cast<Eigen::Index>(beads));
  for (Eigen::Index b = 0; b < c.cols(); ++b) c.col(b) = Eigen::Vector3d(static_cast<double>(b), y, 0);
  return c;
}

// Two distant necklaces: once their distance is known, nothing is read until they can have come near.
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

// Two clouds at some distance: a skin as wide as that would have all pairs of them to keep.
TEST(KeptLists, SkinsAreNotWidenedUntilEverythingIsNear) {
  Chance chance(1);
  constexpr Eigen::Index count = 6000;
  Eigen::Matrix3Xd centers(3, 2 * count);
  for (Eigen::Index b = 0; b < centers.cols(); ++b)
    centers.col(b) = Eigen::Vector3d(uniform(chance, 0, 20) + (b < count ? 0 : 40), uniform(chance, 0, 20),
                                     uniform(chance, 0, 20));
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
  Chance chance(1);
  for (const double step : {0.001, 2.0}) {
    Eigen::Matrix3Xd centers = straight(300, 0);
    const std::vector<double> radii(300, 0.5);
    AutoDetector<3> detector({{{0, 299}}, true, 2, true});
    for (int k = 0; k < 60; ++k) {
      for (Eigen::Index b = 0; b < centers.cols(); ++b)
        centers.col(b) += step * Eigen::Vector3d(uniform(chance, -1, 1), uniform(chance, -1, 1), 0);
      ASSERT_EQ(detector.pairs(Balls<3>(centers, radii)),
                all_pairs(centers, radii, detector.tree().asked(), 3));
    }
    if (step < 1) {
      EXPECT_GE(detector.counts().read, 50U);
    } else {
      EXPECT_GE(detector.counts().from_scratch, 50U);
    }
  }
}

}  // namespace
}  // namespace kds
