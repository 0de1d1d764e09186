#include "motions/scene/scene.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/motions/test_files.h"

namespace kds::scene_test {
namespace {

Trajectory random_trajectory(std::mt19937_64& random, const std::string& file, int beads,
                             std::size_t frames) {
  Trajectory trajectory;
  trajectory.file = file;
  for (std::size_t k = 0; k < frames; ++k) {
    Eigen::Matrix3Xd frame(3, beads);
    for (Eigen::Index i = 0; i < frame.size(); ++i)
      frame(i) = std::uniform_real_distribution<double>(-9, 9)(random);
    trajectory.frames.push_back(frame);
  }
  return trajectory;
}

TEST(Scene, PutsNecklacesOneAfterAnother) {
  std::mt19937_64 random(51);
  const std::vector<Trajectory> necklaces{random_trajectory(random, "a", 4, 3),
                                          random_trajectory(random, "b", 1, 3),
                                          random_trajectory(random, "c", 2, 3)};
  const Scene scene(necklaces, {1, 1, 1, 1, 2, 3, 3});
  EXPECT_EQ(scene.dimension(), 3);
  EXPECT_EQ(scene.degree(), 1);
  EXPECT_EQ(scene.bead_count(), 7U);
  EXPECT_EQ(scene.frame_count(), 3U);
  EXPECT_EQ(scene.step_count(), 2U);
  EXPECT_FALSE(scene.equal_radii());
  EXPECT_EQ(scene.necklaces(), (std::vector<BeadRange>{{0, 3}, {4, 4}, {5, 6}}));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(scene.centers(k).leftCols(4), necklaces[0].frames[k]);
    EXPECT_EQ(scene.centers(k).col(4), necklaces[1].frames[k].col(0));
    EXPECT_EQ(scene.centers(k).rightCols(2), necklaces[2].frames[k]);
    EXPECT_EQ(scene.weights(k), (std::vector<double>{1, 1, 1, 1, 4, 9, 9}));
  }
}

TEST(Scene, HermiteMeetsFramesAndKeepsVelocities) {
  std::mt19937_64 random(53);
  const std::vector<Trajectory> necklaces{random_trajectory(random, "a", 5, 4)};
  const auto& frames = necklaces[0].frames;
  const Scene scene(necklaces, std::vector<double>(5, 0.3), FrameMotion::hermite);
  EXPECT_EQ(scene.degree(), 3);
  BezierMotion<3, 3> before(5), motion(5);
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    scene.load(step, motion);
    for (BeadId b = 0; b < 5; ++b) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto c = [&](const auto& m, int k) { return m.coordinate(b, k, axis); };
        EXPECT_EQ(c(motion, 0), frames[step](axis, b));
        EXPECT_EQ(c(motion, 3), frames[step + 1](axis, b));
        if (step > 0) {
          EXPECT_NEAR(c(before, 3) - c(before, 2), c(motion, 1) - c(motion, 0), 1e-14);
          EXPECT_NEAR(3 * (c(motion, 1) - c(motion, 0)),
                      (frames[step + 1](axis, b) - frames[step - 1](axis, b)) / 2, 1e-13);
        } else {
          EXPECT_NEAR(3 * (c(motion, 1) - c(motion, 0)), frames[1](axis, b) - frames[0](axis, b), 1e-13);
        }
      }
    }
    before = motion;
  }
}

TEST(Scene, HermiteOfTwoFramesIsAStraightLine) {
  std::mt19937_64 random(54);
  const std::vector<Trajectory> necklaces{random_trajectory(random, "a", 3, 2)};
  const Scene scene(necklaces, std::vector<double>(3, 1), FrameMotion::hermite);
  BezierMotion<3, 3> motion(3);
  scene.load(0, motion);
  for (BeadId b = 0; b < 3; ++b)
    EXPECT_NEAR(motion.coordinate(b, 1, 0),
                (2 * necklaces[0].frames[0](0, b) + necklaces[0].frames[1](0, b)) / 3, 1e-14);
}

TEST(Scene, HermiteRefusesWhatOverflows) {
  Trajectory far;
  far.file = "far";
  far.frames = {Eigen::Matrix3Xd::Constant(3, 1, -1.7e308), Eigen::Matrix3Xd::Constant(3, 1, 1.7e308)};
  const Scene scene(std::vector<Trajectory>{far}, {1}, FrameMotion::hermite);
  BezierMotion<3, 3> motion(1);
  EXPECT_THROW(scene.load(0, motion), InputError);
}

TEST(Scene, AStepEndsWhereTheNextBegins) {
  std::mt19937_64 random(52);
  const std::vector<Trajectory> necklaces{random_trajectory(random, "a", 5, 4)};
  const Scene scene(necklaces, std::vector<double>(5, 0.3));
  EXPECT_TRUE(scene.equal_radii());
  BezierMotion<3, 1> motion(5);
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    scene.load(step, motion);
    for (BeadId b = 0; b < 5; ++b) {
      for (int k = 0; k <= 1; ++k) {
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_EQ(motion.coordinate(b, k, axis),
                    necklaces[0].frames[step + static_cast<std::size_t>(k)](axis, b));
        EXPECT_EQ(motion.weight(b, k), 0.3 * 0.3);
        EXPECT_EQ(motion.radius(b, k), 0.3);
      }
    }
  }
}

TEST(Scene, ANecklaceOfOneFrameIsAtRest) {
  std::mt19937_64 random(53);
  for (const bool rest_first : {false, true}) {
    std::vector<Trajectory> necklaces{random_trajectory(random, "moving", 2, 3),
                                      random_trajectory(random, "at rest", 3, 1)};
    if (rest_first) std::swap(necklaces[0], necklaces[1]);
    const Scene scene(necklaces, std::vector<double>(5, 1));
    EXPECT_EQ(scene.frame_count(), 3U);
    const BeadRange rest = scene.necklaces()[rest_first ? 0 : 1];
    const auto& frame = necklaces[rest_first ? 0 : 1].frames[0];
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(scene.centers(k).middleCols(rest.first, 3), frame);
  }
}

TEST(Scene, BeadsThatKeepToAPlaneMakeAPlanarScene) {
  std::mt19937_64 random(57);
  for (const Eigen::Index across : {0, 1, 2}) {
    std::vector<Trajectory> necklaces{random_trajectory(random, "a", 4, 3),
                                      random_trajectory(random, "b", 2, 1)};
    for (Trajectory& necklace : necklaces)
      for (Eigen::Matrix3Xd& frame : necklace.frames) frame.row(across).setConstant(-2.5);
    const Scene scene(necklaces, std::vector<double>(6, 1), FrameMotion::hermite);
    ASSERT_EQ(scene.dimension(), 2);
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Matrix3Xd centers = scene.centers(k);
      EXPECT_TRUE((centers.row(2).array() == 0).all());
      for (Eigen::Index b = 0; b < 4; ++b)
        EXPECT_EQ(scene.in_input(centers.col(b)), necklaces[0].frames[k].col(b));
      for (Eigen::Index b = 4; b < 6; ++b)
        EXPECT_EQ(scene.in_input(centers.col(b)), necklaces[1].frames[0].col(b - 4));
    }
    BezierMotion<2, 3> motion(6);
    scene.load(1, motion);
    for (BeadId b = 0; b < 6; ++b)
      for (int axis = 0; axis < 2; ++axis)
        EXPECT_EQ(motion.coordinate(b, 3, axis), scene.centers(2)(axis, b));

    necklaces[0].frames[1](across, 3) = std::nextafter(-2.5, 0);  // leaves the plane in one frame
    const Scene solid(necklaces, std::vector<double>(6, 1));
    EXPECT_EQ(solid.dimension(), 3);
    EXPECT_EQ(solid.centers(1).leftCols(4), necklaces[0].frames[1]);
    EXPECT_EQ(solid.in_input(Eigen::Vector3d(1, 2, 3)), Eigen::Vector3d(1, 2, 3));
  }
}

void expect_refused(const std::vector<Trajectory>& necklaces, std::initializer_list<std::string_view> parts,
                    const std::vector<double>& radii = {}) {
  test::expect_refused([&] { const Scene scene(necklaces, radii); }, parts);
}

// tests/motions/frames/frame_source_test.cpp has further refusals.
TEST(Scene, RefusesInputsThatCannotMove) {
  std::mt19937_64 random(54);
  expect_refused({random_trajectory(random, "still.pdb", 2, 1)}, {"still.pdb", "two frames"});
  expect_refused({random_trajectory(random, "a.pdb", 2, 1), random_trajectory(random, "b.pdb", 2, 1)},
                 {"two frames"});
  expect_refused({}, {"no input"});
}

TEST(Scene, RefusesRadiiThatDoNotFit) {
  std::mt19937_64 random(55);
  const std::vector<Trajectory> fine{random_trajectory(random, "a.dcd", 2, 2)};
  for (const double wrong : {HUGE_VAL, std::numeric_limits<double>::quiet_NaN(), 1e200})
    EXPECT_THROW(Scene(fine, std::vector<double>{1, wrong}), InputError);
  const std::vector<Trajectory> necklaces{random_trajectory(random, "a.dcd", 3, 2),
                                          random_trajectory(random, "b.dcd", 2, 1)};
  for (const std::size_t count : {0U, 1U, 4U, 6U})
    expect_refused(necklaces, {"a.dcd: 5 beads in all, expected as many radii, found"},
                   std::vector<double>(count, 1));
}

Instance instance(int columns, int degree, std::vector<double> control_points) {
  Instance made;
  made.columns = columns;
  made.degree = degree;
  made.control_points = std::move(control_points);
  return made;
}

TEST(Scene, AnInstanceIsOneStep) {
  // Two points in space with weights, of degree 2: three control points for each of x, y, z and w.
  const Scene scene(instance(4, 2, {0, 1, 2, 3,  4,  5,  6,  7,  8,  4, 5, 9,  //
                                    9, 8, 7, -6, -5, -4, 30, 20, 10, 1, 2, -3}));
  EXPECT_EQ(scene.dimension(), 3);
  EXPECT_EQ(scene.degree(), 2);
  EXPECT_EQ(scene.bead_count(), 2U);
  EXPECT_EQ(scene.frame_count(), 2U);
  EXPECT_EQ(scene.necklaces(), (std::vector<BeadRange>{{0, 1}}));
  EXPECT_EQ(scene.radii(), (std::vector<double>{2, 1}));
  EXPECT_FALSE(scene.equal_radii());
  BezierMotion<3, 2> motion(2);
  scene.load(0, motion);
  EXPECT_EQ(motion.coordinate(0, 1, 0), 1);
  EXPECT_EQ(motion.coordinate(0, 2, 2), 8);
  EXPECT_EQ(motion.coordinate(1, 1, 1), -5);
  EXPECT_EQ(motion.weight(0, 2), 9);
  EXPECT_EQ(motion.weight(1, 2), -3);
  EXPECT_EQ(motion.radius(0, 2), 0);
  EXPECT_EQ(scene.centers(0).col(1), Eigen::Vector3d(9, -6, 30));
  EXPECT_EQ(scene.centers(1).col(1), Eigen::Vector3d(7, -4, 10));
  EXPECT_EQ(scene.weights(0), (std::vector<double>{4, 1}));
  EXPECT_EQ(scene.weights(1), (std::vector<double>{9, -3}));
}

TEST(Scene, AnInstanceWithoutWeightsHasPoints) {
  const Scene plane(instance(2, 1, {0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(plane.dimension(), 2);
  EXPECT_EQ(plane.radii(), (std::vector<double>{0, 0}));
  EXPECT_TRUE(plane.equal_radii());
  EXPECT_EQ(plane.centers(1).col(0), Eigen::Vector3d(1, 3, 0));
  const Scene line(instance(1, 1, {0, 1, 2, 3}));
  EXPECT_EQ(line.dimension(), 1);
  EXPECT_EQ(line.bead_count(), 2U);
}

TEST(Scene, AnInstanceOfNumbersWithoutAnExactValueIsRefused) {
  for (std::size_t place = 0; place < 8; ++place) {
    std::vector<double> numbers{0, 1, 2, 3, 4, 5, 6, 7};
    numbers[place] =
        place % 2 == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(Scene(instance(4, 1, numbers)), InputError);
  }
}

TEST(Scene, RadiiAreEqualOnlyIfWeightsStaySo) {
  EXPECT_TRUE(Scene(instance(4, 1, {0, 1, 0, 1, 0, 1, 4, 4, 2, 3, 2, 3, 2, 3, 4, 4})).equal_radii());
  EXPECT_FALSE(Scene(instance(4, 1, {0, 1, 0, 1, 0, 1, 4, 4, 2, 3, 2, 3, 2, 3, 4, 5})).equal_radii());
}

// A weight that underflows has changed, and is reported.
TEST(Scene, WeightsTooSmallAreTold) {
  Trajectory necklace;
  necklace.frames.assign(2, Eigen::Matrix3Xd::Random(3, 4));
  const std::span<const Trajectory> necklaces(&necklace, 1);
  for (const auto& radii : {std::vector<double>{1, 2, 0, 0x1p-511}, std::vector<double>(4, 0x1p-600)})
    EXPECT_NO_THROW(Scene(necklaces, radii).require_weights());
  test::expect_refused(
      [&] {
        Scene(necklaces, {1, 2, 0, 0x1p-512}).require_weights();
      },
      {"bead 3: the square of its radius"});
}

}  // namespace
}  // namespace kds::scene_test
