// Highly regular scenes: lattices that move rigidly, also with one part that moves differently. Many balls
// lie on one sphere, many events are simultaneous, and flips block each other.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "motions/models/model.h"
#include "structures/power_diagram/diagram_events.h"
#include "structures/power_diagram/power_diagram.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::regular_scenes_test {
namespace {

using namespace test;
using SpaceRig = Rig<PowerDiagram<3>, Space>;

std::vector<Space> steps_through(const std::vector<Eigen::Matrix3Xd>& frames) {
  std::vector<Points> points;
  for (const Eigen::Matrix3Xd& frame : frames) {
    points.emplace_back();
    for (Eigen::Index b = 0; b < frame.cols(); ++b)
      points.back().push_back({frame(0, b), frame(1, b), frame(2, b)});
  }
  return through(points);
}

std::vector<Eigen::Matrix3Xd> model(const char* name, std::size_t beads, models::ShapeMotion motion) {
  const models::Settings settings{.beads = beads, .frames = 3, .motion = motion};
  return models::generate(*models::find_model(name), settings).front().frames;
}

std::vector<Eigen::Matrix3Xd> one_moves() {
  auto frames = model("grid", 27, models::ShapeMotion::rest);
  for (int k = 1; k < 3; ++k)
    frames[static_cast<std::size_t>(k)].col(13) += k * Eigen::Vector3d(0.3, 0.2, -0.4);
  return frames;
}

/// Makes a lattice of whole coordinates, transformed by `by`: sheared, scaled or turned by a quarter.
std::vector<Eigen::Matrix3Xd> whole_lattice(const Eigen::Matrix3d& by) {
  Eigen::Matrix3Xd points(3, 36);
  for (Eigen::Index b = 0; b < points.cols(); ++b)
    points.col(b) = Eigen::Vector3d(double(b % 3), double(b / 3 % 3), double(b / 9));
  return {points, by * points, by * by * points};
}

/// Makes rings of beads, one above the other, turned about a slanted axis and stretched.
std::vector<Eigen::Matrix3Xd> rings() {
  Eigen::Matrix3Xd points(3, 24);
  for (Eigen::Index b = 0; b < points.cols(); ++b) {
    const double angle = 2 * 3.14159265358979 * double(b % 8) / 8;
    points.col(b) = Eigen::Vector3d(3 * std::cos(angle), 3 * std::sin(angle), 0.75 * double(b / 8));
  }
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.25, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
  return {points, turn * points, turn * Eigen::Vector3d(1, 1.25, 1).asDiagonal() * points};
}

/// Makes a plane lattice that turns in space. The scene has a diagram only because its coordinates are
/// rounded.
std::vector<Eigen::Matrix3Xd> turning_plane() {
  Eigen::Matrix3Xd points(3, 16);
  for (Eigen::Index b = 0; b < points.cols(); ++b)
    points.col(b) = Eigen::Vector3d(2 * double(b % 4), 2 * double(b / 4), 0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.125, Eigen::Vector3d(2, 3, 6) / 7).toRotationMatrix();
  return {points, turn * points, turn * turn * points};
}

struct Scene {
  std::string name;
  std::vector<Eigen::Matrix3Xd> frames;
};

std::vector<Scene> scenes() {
  Eigen::Matrix3d shear, scale, turn;
  shear << 1, 1, 0, 0, 1, 0, 0, 0, 1;
  scale << 2, 0, 0, 0, 1, 0, 0, 0, 3;
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return {{"grid", model("grid", 27, models::ShapeMotion::rotate)},
          {"grid that wanders", model("grid", 27, models::ShapeMotion::wander)},
          {"helix", model("helix", 24, models::ShapeMotion::rotate)},
          {"grill", model("grill", 24, models::ShapeMotion::rotate)},
          {"rings", rings()},
          {"turning plane", turning_plane()},
          {"one bead moves", one_moves()},
          {"sheared", whole_lattice(shear)},
          {"scaled", whole_lattice(scale)},
          {"turned", whole_lattice(turn)}};
}

TEST(RegularScenes, KernelsAgreeAndAuditsPassBetweenAllEvents) {
  for (const Scene& scene : scenes()) {
    SCOPED_TRACE(scene.name);
    const std::vector<Space> steps = steps_through(scene.frames);
    SpaceRig filtered(steps[0], AuditMode::events), exact(steps[0], AuditMode::none, Kernel::exact);
    ASSERT_NO_THROW(filtered.run(steps));
    ASSERT_NO_THROW(exact.run(steps));
    EXPECT_EQ(filtered.simulator.fingerprint(), exact.simulator.fingerprint());
    EXPECT_TRUE(books_balance(filtered.structure.statistics));
    SpaceRig replayed(steps[0], AuditMode::frames);
    ASSERT_NO_THROW(replayed.replay(steps, filtered.history));
    EXPECT_EQ(replayed.simulator.fingerprint(), filtered.simulator.fingerprint());
  }
}

// If flips block each other, only a few cells are exchanged, not the whole diagram.
TEST(RegularScenes, BlockedFlipsAreRepairedWhereTheyAre) {
  const std::vector<Space> steps = steps_through(model("grid", 343, models::ShapeMotion::rotate));
  SpaceRig rig(steps[0]);
  rig.run({steps[0]});
  const auto& kinds = rig.structure.statistics.events_by_kind;
  EXPECT_GT(kinds[DiagramEvents<3>::repairs], 0U);
  EXPECT_LE(kinds[DiagramEvents<3>::rebuild], 2U);
  EXPECT_EQ(kinds[DiagramEvents<3>::rebuild] + kinds[DiagramEvents<3>::repairs],
            rig.structure.statistics.rebuilds);
  EXPECT_LE(kinds[DiagramEvents<3>::clears], 40 * kinds[DiagramEvents<3>::repairs]);
}

// A hidden bead becomes visible at the same moment at which flips elsewhere block each other.
TEST(RegularScenes, WhatHappensBesideABlockIsNotLost) {
  const auto motion = instance_motion<Space>("../hostile/appearance_beside_a_block");
  SpaceRig filtered(motion, AuditMode::events), exact(motion, AuditMode::none, Kernel::exact);
  ASSERT_NO_THROW(filtered.run());
  exact.run();
  EXPECT_EQ(filtered.simulator.fingerprint(), exact.simulator.fingerprint());
  EXPECT_GT(filtered.structure.statistics.rebuilds, 0U);
}

}  // namespace
}  // namespace kds::regular_scenes_test
