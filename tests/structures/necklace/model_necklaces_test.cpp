// The models are proper necklaces in every frame, and between frames if the model promises that.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "motions/models/model.h"
#include "motions/models/shapes.h"
#include "motions/readers/write_trajectory.h"
#include "structures/necklace/necklace.h"

namespace kds::models::model_necklaces_test {
namespace {

NecklaceReport validate_frame(const Eigen::Matrix3Xd& frame) {
  const std::vector<double> radii(static_cast<std::size_t>(frame.cols()), radius);
  return Necklace({0, static_cast<BeadId>(frame.cols() - 1)}, frame, radii).validate({.most_listed = 3});
}

void expect_proper(const Eigen::Matrix3Xd& frame, const std::string& where) {
  const NecklaceReport report = validate_frame(frame);
  for (const Condition condition : kConditions) {
    const Violations& violations = report[condition];
    if (violations.count == 0) continue;
    ADD_FAILURE() << where << ": " << name_of(condition) << " " << violations.count << ", first "
                  << violations.listed[0].first << " " << violations.listed[0].second;
  }
}

void expect_proper(std::string_view model, const Settings& settings) {
  for (const Trajectory& trajectory : generate(*find_model(model), settings)) {
    ASSERT_EQ(trajectory.bead_count(), settings.beads);
    ASSERT_EQ(trajectory.frames.size(), settings.frames);
    for (std::size_t k = 0; k < settings.frames; ++k)
      expect_proper(trajectory.frames[k], trajectory.file + " frame " + std::to_string(k));
  }
}

Settings sized(std::size_t beads, std::size_t frames = 3) {
  Settings settings;
  settings.beads = beads;
  settings.frames = frames;
  return settings;
}

TEST(ModelNecklaces, AreProper) {
  for (const std::size_t beads : {10U, 50U, 640U, 5000U}) {
    expect_proper("spline", sized(beads));
    expect_proper("scaling-helix", sized(beads));
    expect_proper("random-chain", sized(beads));
    expect_proper("grid", sized(beads));
    Settings flat = sized(beads);
    flat.dimension = 2;
    expect_proper("grid", flat);
  }
  for (const std::size_t beads : {40U, 89U, 3000U}) expect_proper("grill", sized(beads));
  for (const std::size_t beads : {640U, 10240U}) expect_proper("helix", sized(beads));
  expect_proper("spiral", sized(4000, 21));
  expect_proper("two-spirals", sized(4000, 5));
  for (const double turns : {1.0, 5.0, 9.0}) {
    Settings rolled = sized(1000, 11);
    rolled.turns = turns;
    expect_proper("spiral", rolled);
  }
}

// With their default turns the models are proper. Splines and grills need a minimum number of beads for their
// bends.
TEST(ModelNecklaces, AreProperByDefault) {
  for (const models::Model& model : models::all_models()) {
    std::size_t beads = model.name == "grill" ? 40 : model.name == "spline" ? 8 : 2;
    for (; beads < 400; beads += 1 + beads / 12) expect_proper(model.name, sized(beads));
    expect_proper(model.name, sized(1000, 11));
    expect_proper(model.name, sized(2000));
  }
}

TEST(ModelNecklaces, TooManyTurnsMeet) {
  Settings settings = sized(1000, 2);
  settings.turns = 18;
  const Trajectory spiral = generate(*find_model("spiral"), settings)[0];
  EXPECT_TRUE(validate_frame(spiral.frames[0]).proper());
  EXPECT_GT(validate_frame(spiral.frames[1])[Condition::disjoint].count, 0U);
  EXPECT_FALSE(validate_frame(helix(100, 10)).proper());
}

TEST(ModelNecklaces, StayProperInPdb) {
  for (const char* model : {"spline", "scaling-helix", "random-chain", "grid", "grill"}) {
    Settings settings = sized(600, 5);
    const Trajectory written = as_in_pdb(generate(*find_model(model), settings)[0], "x.pdb");
    for (const auto& frame : written.frames) expect_proper(frame, model);
  }
}

TEST(ModelNecklaces, WanderingStaysProperBetweenFrames) {
  for (const double step : {0.03, 0.3, 1.0}) {
    Settings settings = sized(400, 12);
    settings.step = step;
    settings.seed = 5;
    const Trajectory chain = generate(*find_model("random-chain"), settings)[0];
    std::size_t moved = 0;
    for (std::size_t k = 0; k + 1 < settings.frames; ++k) {
      const auto &before = chain.frames[k], &after = chain.frames[k + 1];
      for (const double u : {0.0, 0.125, 0.25, 0.5, 0.75, 0.875, 1.0})
        expect_proper((1 - u) * before + u * after, "step " + std::to_string(step));
      for (Eigen::Index bead = 0; bead < before.cols(); ++bead) {
        const double way = (after.col(bead) - before.col(bead)).norm();
        EXPECT_TRUE(way == 0 || std::abs(way - step) < 1e-12) << way;
        moved += way > 0;
      }
    }
    EXPECT_GT(static_cast<double>(moved), 0.6 * 400 * 11) << step;  // few beads find no free place
  }
}

}  // namespace
}  // namespace kds::models::model_necklaces_test
