// Writes trajectories and reads them back.

#include "motions/readers/write_trajectory.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "motions/models/model.h"
#include "motions/readers/read_trajectory.h"
#include "tests/motions/test_files.h"

namespace kds::write_trajectory_test {
namespace {

Trajectory of_frames(std::vector<Eigen::Matrix3Xd> frames) {
  Trajectory trajectory;
  trajectory.frames = std::move(frames);
  return trajectory;
}

Trajectory through_file(const Trajectory& trajectory, const std::string& name) {
  std::ostringstream stream;
  if (name.ends_with(".xyz")) {
    write_xyz(stream, trajectory, "a comment");
  } else {
    write_pdb(stream, trajectory, "a title");
  }
  return read_trajectory(test::write_file(name, stream.str()));
}

TEST(WriteTrajectory, XyzReadsBackExactly) {
  std::mt19937_64 random(1);
  std::vector<Eigen::Matrix3Xd> frames;
  for (int k = 0; k < 4; ++k) {
    Eigen::Matrix3Xd frame(3, 50);
    for (Eigen::Index i = 0; i < frame.size(); ++i) {
      do {
        frame.data()[i] = std::bit_cast<double>(random());
      } while (!std::isfinite(frame.data()[i]));
    }
    frames.push_back(frame);
  }
  frames[0].col(0) << std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max(), -0.1;
  const Trajectory read = through_file(of_frames(frames), "random.xyz");
  ASSERT_EQ(read.frames.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(read.frames[k], frames[k]);
  EXPECT_TRUE(read.element_radii.empty());
}

TEST(WriteTrajectory, EveryModelIsRead) {
  for (const models::Model& model : models::all_models()) {
    models::Settings settings;
    settings.beads = 100;
    settings.frames = 3;
    for (const Trajectory& trajectory : models::generate(model, settings)) {
      const Trajectory xyz = through_file(trajectory, "model.xyz");
      EXPECT_EQ(xyz.frames, trajectory.frames) << model.name;
      EXPECT_TRUE(xyz.breaks.empty() && xyz.warnings.empty()) << model.name;
      const Trajectory rounded = as_in_pdb(trajectory, "model.pdb");
      const Trajectory pdb = through_file(rounded, "model.pdb");
      EXPECT_EQ(pdb.frames, rounded.frames) << model.name;
      EXPECT_TRUE(pdb.breaks.empty() && pdb.warnings.empty()) << model.name;
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LT((pdb.frames[k] - trajectory.frames[k]).cwiseAbs().maxCoeff(), 0.00051);
    }
  }
}

TEST(WriteTrajectory, PdbTakesWhatFitsItsColumns) {
  Eigen::Matrix3Xd frame = Eigen::Matrix3Xd::Zero(3, 9999);
  for (Eigen::Index b = 0; b < 9999; ++b) frame(0, b) = static_cast<double>(b);
  frame(1, 17) = -999.999;
  frame(2, 17) = 9999.999;
  frame(1, 18) = -0.0001;
  const Trajectory rounded = as_in_pdb(of_frames({frame}), "full.pdb");
  EXPECT_EQ(through_file(rounded, "full.pdb").frames, rounded.frames);
  EXPECT_EQ(rounded.frames[0](1, 17), -999.999);

  frame(2, 17) = 9999.9996;
  test::expect_refused([&] { (void)as_in_pdb(of_frames({frame}), "full.pdb"); },
                       {"full.pdb", "frame 0", "bead 17", "z"});
  frame(2, 17) = std::nan("");
  test::expect_refused([&] { (void)as_in_pdb(of_frames({frame}), "full.pdb"); }, {"full.pdb", "bead 17"});
  frame(2, 17) = -1000;
  test::expect_refused([&] { (void)as_in_pdb(of_frames({frame}), "full.pdb"); }, {"full.pdb", "bead 17"});
  const Eigen::Matrix3Xd many = Eigen::Matrix3Xd::Zero(3, 10000);
  test::expect_refused([&] { (void)as_in_pdb(of_frames({many}), "full.pdb"); }, {"full.pdb", "10000 beads"});
  const std::vector<Eigen::Matrix3Xd> long_run(10000, Eigen::Matrix3Xd::Zero(3, 1));
  test::expect_refused([&] { (void)as_in_pdb(of_frames(long_run), "full.pdb"); },
                       {"full.pdb", "10000 frames"});
}

TEST(PdbReader, ACoarseGrainedModelIsReadByItsCa) {
  const std::string lines = test::pdb_line({.number = 1}) + test::pdb_line({.number = 2, .x = 3.8});
  const std::filesystem::path path = test::write_file("ca.pdb", lines);
  EXPECT_EQ(read_trajectory(path).bead_count(), 2U);
  EXPECT_EQ(read_trajectory(path, {.selection = Selection::ca}).bead_count(), 2U);
  test::expect_refused([&] { (void)read_trajectory(path, {.selection = Selection::backbone}); },
                       {"--select"});
}

}  // namespace
}  // namespace kds::write_trajectory_test
