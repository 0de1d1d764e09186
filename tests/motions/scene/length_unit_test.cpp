// Molecules in nanometres are noticed, and other small scenes are not taken for molecules.

#include "motions/scene/length_unit.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "motions/readers/read_trajectory.h"
#include "tests/motions/test_files.h"

namespace kds::length_unit_test {
namespace {

using Beads = Eigen::Matrix3Xd;

Beads protein(const std::string& name, const std::string& selection) {
  return read_trajectory(test::data_file("trajectories/" + name),
                         {.selection = *Selection::parse(selection, "")})
      .frames.front();
}

/// Returns a walk whose steps have the length of `step` and random directions.
template <class Step>
Beads walk(int beads, Step step) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Beads all = Beads::Zero(3, beads);
  for (int i = 1; i < beads; ++i) {
    const Eigen::Vector3d along(normal(random), normal(random), normal(random));
    all.col(i) = all.col(i - 1) + step(random) * along.normalized();
  }
  return all;
}

Beads constant_walk(double length) {
  return walk(40, [=](auto&) { return length; });
}

Beads gaussian_walk(double sigma) {
  return walk(40, [=](std::mt19937& random) {
    std::normal_distribution<double> normal(0, sigma);
    return std::hypot(normal(random), normal(random), normal(random));
  });
}

Beads random_points(double side) {
  std::mt19937 random(3);
  return Beads::NullaryExpr(3, 60, [&] { return std::uniform_real_distribution<double>(0, side)(random); });
}

Beads lattice(double spacing) {
  return Beads::NullaryExpr(3, 64, [=](Eigen::Index axis, Eigen::Index i) {
    return spacing * static_cast<double>(axis == 0 ? i % 4 : axis == 1 ? i / 4 % 4 : i / 16);
  });
}

Beads line(double spacing) {
  return Beads::NullaryExpr(3, 40, [=](Eigen::Index axis, Eigen::Index i) {
    return axis == 0 ? spacing * static_cast<double>(i) : 0;
  });
}

Beads circle(int beads) {
  return Beads::NullaryExpr(3, beads, [=](Eigen::Index axis, Eigen::Index i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / beads;
    return axis == 0 ? std::cos(angle) : axis == 1 ? std::sin(angle) : 0;
  });
}

TEST(LengthUnit, NanometresAreToldFromOtherScenes) {
  const Beads villin = protein("villin_hp36_300K.pdb", "backbone"),
              chain = protein("dhodh363_1000K.pdb", "ca");
  struct Case {
    std::string what;
    Beads beads;
    std::string expected;  // part of the doubt; empty if there is none
  };
  const std::vector<Case> cases{
      {"backbone", villin / 10, "0.148 angstrom, which fits bonded atoms in nanometres"},
      {"backbone of a large protein", protein("dhodh363_1000K.pdb", "backbone") / 10, "bonded atoms"},
      {"C-alpha atoms", chain / 10, "0.385 angstrom, which fits C-alpha atoms in nanometres"},
      {"C-alpha atoms of villin", protein("villin_hp36_300K.pdb", "ca") / 10, "C-alpha atoms"},
      {"a model of C-alpha atoms", constant_walk(0.38), "C-alpha atoms"},
      {"Martini", constant_walk(0.35), "C-alpha atoms"},
      {"nine beads", chain.leftCols(9) / 10, "C-alpha atoms"},

      {"backbone in angstrom", villin, ""},
      {"C-alpha atoms in angstrom", chain, ""},
      {"in metres", villin / 1e10, ""},
      {"eight beads", chain.leftCols(8) / 10, ""},
      {"a walk of steps 0.1", constant_walk(0.1), ""},
      {"a walk of steps 0.2", constant_walk(0.2), ""},
      {"a walk of steps 0.3", constant_walk(0.3), ""},
      {"a walk of steps 1", constant_walk(1), ""},
      {"a diffusing point, median 0.154", gaussian_walk(0.1), ""},
      {"a diffusing point, median 0.38", gaussian_walk(0.25), ""},
      {"points in a unit cube", random_points(1), ""},
      {"points in a cube of side 0.25", random_points(0.25), ""},
      {"points in a cube of side 0.6", random_points(0.6), ""},
      {"lattice of spacing 0.1", lattice(0.1), ""},
      {"lattice of spacing 0.2", lattice(0.2), ""},
      {"a line of spacing 0.38", line(0.38), ""},
      {"a line of spacing 0.15", line(0.15), ""},
      {"a circle of 16 beads, 0.39 apart", circle(16), ""},
      {"coincident beads", Beads::Zero(3, 30), ""},
      {"no beads", Beads(3, 0), ""},
  };
  for (const Case& one : cases) {
    const std::string doubt = nanometres_doubt(one.beads);
    if (one.expected.empty())
      EXPECT_EQ(doubt, "") << one.what;
    else
      EXPECT_THAT(doubt, testing::HasSubstr(one.expected)) << one.what;
  }
}

TEST(LengthUnit, BreaksAreNoBonds) {
  Beads beads(3, 20);
  beads << protein("villin_hp36_300K.pdb", "ca").leftCols(10) / 10,
      protein("villin_hp36_300K.pdb", "ca").leftCols(10);
  EXPECT_EQ(nanometres_doubt(beads), "");
  std::vector<std::size_t> breaks;
  for (std::size_t b = 9; b < 19; ++b) breaks.push_back(b);
  EXPECT_NE(nanometres_doubt(beads, breaks), "");
}

}  // namespace
}  // namespace kds::length_unit_test
