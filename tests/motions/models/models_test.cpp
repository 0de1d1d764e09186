// Tests the models: their elementary functions, shapes and motions, and that results are the same on all
// platforms.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "motions/models/elementary.h"
#include "motions/models/model.h"
#include "motions/models/shape_motion.h"
#include "motions/models/shapes.h"
#include "tests/motions/test_files.h"

namespace kds::models::models_test {
namespace {

TEST(Elementary, AgreesWithTheLibrary) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> turns(-3, 3), exponent(-300, 300);
  for (int i = 0; i < 20000; ++i) {
    const double t = turns(random);
    const auto [sine, cosine] = sine_cosine(t);
    const double part = 2 * std::numbers::pi * (t - std::nearbyint(t));
    EXPECT_NEAR(sine, std::sin(part), 1e-15);
    EXPECT_NEAR(cosine, std::cos(part), 1e-15);
    const double x = std::exp2(exponent(random));
    EXPECT_NEAR(logarithm(x), std::log(x), 4e-16 * std::max(1.0, std::abs(std::log(x))));
    EXPECT_NEAR(cube_root(x) / std::cbrt(x), 1, 1e-15);
  }
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const auto [sine, cosine] = sine_cosine(quarter / 4.0);
    EXPECT_EQ(std::abs(sine), quarter % 2 == 0 ? 0 : 1);
    EXPECT_EQ(cosine, quarter % 2 != 0 ? 0 : quarter % 4 == 0 ? 1 : -1);
  }
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_EQ(cube_root(0), 0);
  EXPECT_EQ(cube_root(27), 3);
}

TEST(ModelRandom, IsUniform) {
  Random random(2);
  double sum = 0;
  Eigen::Vector3d directions = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform();
    EXPECT_TRUE(x >= 0 && x < 1);
    sum += x;
    const Eigen::Vector3d d = random.direction();
    EXPECT_NEAR(d.norm(), 1, 1e-15);
    directions += d;
    squares += d.cwiseProduct(d);
  }
  EXPECT_NEAR(sum / 20000, 0.5, 0.01);
  EXPECT_LT(directions.norm() / 20000, 0.02);
  for (Eigen::Index axis = 0; axis < 3; ++axis) EXPECT_NEAR(squares[axis] / 20000, 1.0 / 3, 0.01);
}

std::uint64_t hash(const std::vector<Trajectory>& trajectories) {
  std::uint64_t h = 0xcbf29ce484222325;
  for (const Trajectory& trajectory : trajectories)
    for (const auto& frame : trajectory.frames)
      for (Eigen::Index i = 0; i < frame.size(); ++i) {
        h ^= std::bit_cast<std::uint64_t>(frame.data()[i]);
        h *= 0x100000001b3;
      }
  return h;
}

// Results are equal bit for bit on every platform. The values change only if a model is changed on purpose.
TEST(Models, AreTheSameOnEveryPlatform) {
  const std::vector<std::pair<std::string_view, std::uint64_t>> golden{
      {"spline", 0x7dcf35374a956249},        {"helix", 0xe59b6022e8135d07},
      {"scaling-helix", 0x78a88e535404d14b}, {"spiral", 0x72b24035a4cc9064},
      {"two-spirals", 0x1fc7f39b65b44453},   {"grill", 0x3e11b198f0fb2730},
      {"grid", 0x2fd4c5a5c4120cda},          {"random-chain", 0x091cdef48c7f53fe}};
  ASSERT_EQ(golden.size(), all_models().size());
  for (const auto& [name, expected] : golden) {
    const Model* model = find_model(name);
    ASSERT_NE(model, nullptr) << name;
    Settings settings;
    settings.beads = 200;
    settings.frames = 4;
    settings.seed = 42;
    if (model->takes(Setting::turns)) settings.turns = model->defaults.turns;
    EXPECT_EQ(hash(generate(*model, settings)), expected) << name;
  }
}

TEST(Models, RandomOnesDependOnTheSeedAlone) {
  Settings settings;
  settings.beads = 100;
  settings.frames = 3;
  const Model& chain = *find_model("random-chain");
  const std::uint64_t first = hash(generate(chain, settings));
  EXPECT_EQ(hash(generate(chain, settings)), first);
  settings.seed = 2;
  EXPECT_NE(hash(generate(chain, settings)), first);
  EXPECT_EQ(find_model("chain"), nullptr);
}

TEST(Models, TakeTwoBeads) {
  for (const Model& model : all_models()) {
    Settings settings;
    settings.frames = 2;
    for (const Trajectory& trajectory : generate(model, settings)) {
      EXPECT_EQ(trajectory.bead_count(), 2U) << model.name;
      EXPECT_EQ(trajectory.frames.size(), 2U);
      EXPECT_EQ(trajectory.frame_numbers, (std::vector<std::size_t>{0, 1}));
      for (const auto& frame : trajectory.frames) {
        EXPECT_TRUE(frame.allFinite()) << model.name;
        EXPECT_LT((frame.col(0) - frame.col(1)).norm(), 2.0) << model.name;
      }
    }
  }
}

TEST(Helix, LiesInACubeAndHasItsTurns) {
  const Shape shape = helix(1001, 10);
  const double side = shape(2, 1000) - shape(2, 0);
  EXPECT_NEAR(shape.row(0).maxCoeff(), side / 2, 1e-9 * side);
  for (Eigen::Index b = 0; b <= 1000; ++b) EXPECT_NEAR(shape.col(b).head<2>().norm(), side / 2, 1e-9 * side);
  for (Eigen::Index b = 0; b < 1000; ++b) EXPECT_NEAR((shape.col(b + 1) - shape.col(b)).norm(), 1.998, 1e-9);
  for (Eigen::Index turn = 0; turn <= 10; ++turn) EXPECT_NEAR(shape(1, 100 * turn), 0, 1e-9);
  // Consecutive turns are two bonds apart.
  const double turns = turns_at_pitch(10000, 2);
  const Shape scaling = helix(10000, turns);
  EXPECT_NEAR((scaling(2, 9999) - scaling(2, 0)) / turns, 2 * 1.998, 0.02);
}

TEST(Grill, HasSixSegments) {
  const Shape shape = grill(1000);
  Eigen::Index segments = 0;
  bool straight_before = false;
  for (Eigen::Index b = 0; b + 1 < shape.cols(); ++b) {
    const bool straight = std::abs(shape(1, b + 1) - shape(1, b)) < 1e-9;
    segments += straight && !straight_before;
    straight_before = straight;
  }
  EXPECT_EQ(segments, 6);
  EXPECT_EQ(shape.row(2).cwiseAbs().maxCoeff(), 0);
}

TEST(Grid, FillsACube) {
  const Shape shape = packed_grid(8000, 3, 0.05, 0.999);
  const Eigen::Vector3d extent = shape.rowwise().maxCoeff() - shape.rowwise().minCoeff();
  EXPECT_LT(extent.maxCoeff(), 1.2 * extent.minCoeff());
  const Shape flat = packed_grid(900, 2, 0.05, 0.999);
  EXPECT_EQ(flat.row(2).cwiseAbs().maxCoeff(), 0);
}

TEST(Spiral, RollsUpAtConstantLength) {
  for (const double rolled : {0.0, 0.01, 0.3, 1.0}) {
    const Shape shape = spiral(2000, 6, rolled);
    double turned = 0;
    for (Eigen::Index b = 0; b + 1 < shape.cols(); ++b) {
      const Eigen::Vector3d bond = shape.col(b + 1) - shape.col(b);
      EXPECT_LE(bond.norm(), 1.998 + 1e-9);
      EXPECT_GT(bond.norm(), 1.99);
      if (b == 0) continue;
      const Eigen::Vector3d before = shape.col(b) - shape.col(b - 1);
      turned += std::asin(before.cross(bond).z() / (before.norm() * bond.norm()));
    }
    EXPECT_NEAR(turned / (2 * std::numbers::pi), 6 * rolled, 0.01);
    EXPECT_NEAR(shape.rowwise().mean().norm(), 0, 1e-9);
    const Shape other = facing_spiral(shape, 1.5);
    const double length = 1.998 * 1999;
    EXPECT_NEAR(other.row(1).mean(), 1.5 * length, 1e-6);
    EXPECT_LT(shape.colwise().norm().maxCoeff(), length / 2 + 1e-6);
  }
}

TEST(RandomChain, FillsItsShare) {
  Random random(3);
  const Shape shape = random_chain(3000, 0.2, random);
  const double side = std::cbrt(3000 * 4 * std::numbers::pi / 3 / 0.2);
  EXPECT_GE(shape.minCoeff(), 0);
  EXPECT_LE(shape.maxCoeff(), side);
  for (Eigen::Index b = 0; b + 1 < shape.cols(); ++b)
    EXPECT_NEAR((shape.col(b + 1) - shape.col(b)).norm(), 1.998, 1e-9);
  test::expect_refused(
      [] {
        Random again(1);
        static_cast<void>(random_chain(1000, 0.7, again));
      },
      {"--fill", "0.7"});
}

TEST(ModelRotating, IsRigidAndTakesItsSteps) {
  const Shape shape = helix(300, 4);
  const std::vector<Shape> frames = rotating(shape, 6, 0.25);
  ASSERT_EQ(frames.size(), 6U);
  EXPECT_EQ(frames[0], shape);
  for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
    const double farthest = (frames[k + 1] - frames[k]).colwise().norm().maxCoeff();
    EXPECT_NEAR(farthest, 0.25, 1e-4);
    for (Eigen::Index b = 1; b < 300; ++b)
      EXPECT_NEAR((frames[k + 1].col(b) - frames[k + 1].col(0)).norm(), (shape.col(b) - shape.col(0)).norm(),
                  1e-10);
  }
  EXPECT_EQ(rotating(shape, 2, 0)[1], shape);
}

TEST(PlanarModels, StayInTheirPlaneWhateverTheMotion) {
  Settings settings{.beads = 60, .frames = 20, .motion = {}, .step = 0.3, .dimension = 2, .jitter = 0.2};
  for (const char* const model : {"grid", "spline"})
    for (const ShapeMotion motion : {ShapeMotion::rest, ShapeMotion::rotate, ShapeMotion::wander}) {
      settings.motion = motion;
      const Trajectory moving = generate(*find_model(model), settings).front();
      ASSERT_EQ(moving.frames.size(), 20U);
      for (const Shape& frame : moving.frames) EXPECT_EQ(frame.row(2).cwiseAbs().maxCoeff(), 0);
      const double moved = (moving.frames[19] - moving.frames[0]).colwise().norm().maxCoeff();
      EXPECT_EQ(moved > 0.5, motion != ShapeMotion::rest);
    }
}

TEST(ModelWandering, DoesNotMakeWorseWhatIsWrongAlready) {
  Shape broken(3, 4);  // bond 0-1 is too long, and 1-3 are too near
  broken << 0, 3, 4.5, 4, 0, 0, 0, 0.5, 0, 0, 0, 0;
  Random random(4);
  const std::vector<Shape> frames = wandering(broken, 40, 0.2, random);
  double bond = 3, distance = (broken.col(3) - broken.col(1)).norm();
  for (const Shape& frame : frames) {
    const double now = (frame.col(1) - frame.col(0)).norm(), apart = (frame.col(3) - frame.col(1)).norm();
    EXPECT_LE(now, std::max(bond, 1.998) + 1e-12);
    EXPECT_GE(apart, std::min(distance, 2.002) - 1e-12);
    bond = now;
    distance = apart;
  }
  EXPECT_LE(bond, 1.998 + 1e-12);
  EXPECT_GE(distance, 2.002 - 1e-12);
}

}  // namespace
}  // namespace kds::models::models_test
