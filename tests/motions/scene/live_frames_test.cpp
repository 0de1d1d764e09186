#include "motions/scene/live_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/curves/bezier_motion.h"
#include "motions/scene/scene.h"
#include "tests/support/inputs/frames_one_by_one.h"
#include "tests/support/inputs/random.h"

namespace kds::live_frames_test {
namespace {

using namespace test;
using ::testing::HasSubstr;

using Linear = BezierMotion<3, 1>;
using Cubic = BezierMotion<3, 3>;
constexpr std::size_t beads = 6;

/// Frames of six beads at random places, two picoseconds apart.
std::vector<FrameRead> some_frames(std::size_t count, bool in_cell = false) {
  Random random(5);
  std::vector<FrameRead> frames(count);
  for (std::size_t k = 0; k < count; ++k) {
    frames[k].stamp = {k, 2.0 * static_cast<double>(k)};
    frames[k].positions.resize(3, beads);
    for (double& x : frames[k].positions.reshaped()) x = uniform(random, -4, 4);
    if (in_cell) frames[k].cell = Cell(Eigen::Vector3d(20, 21, 22).asDiagonal());
  }
  return frames;
}

std::unique_ptr<LiveFrames> live(std::vector<FrameRead> frames, bool broken = false) {
  return std::make_unique<LiveFrames>(std::make_unique<FramesOneByOne>(
      std::vector<NecklaceBeads>{{.file = "sim", .count = beads}}, std::move(frames), broken));
}

Scene scene_of(std::unique_ptr<LiveFrames> frames, FrameMotion motion) {
  const FrameSurvey survey = frames->survey();
  return {std::move(frames), survey, std::vector<double>(beads, 1), motion};
}

/// The control points of all steps.
template <class Motion>
std::vector<double> control_points(const Scene& scene) {
  std::vector<double> all;
  Motion motion(beads);
  for (std::size_t step = 0; scene.has_step(step); ++step) {
    scene.load(step, motion);
    for (BeadId bead = 0; bead < beads; ++bead)
      for (int k = 0; k <= Motion::degree; ++k)
        for (int axis = 0; axis < 3; ++axis) all.push_back(motion.coordinate(bead, k, axis));
  }
  return all;
}

TEST(LiveFrames, GiveTheStepsOfTheSameFramesInMemory) {
  std::vector<double> coordinates;
  std::vector<FrameStamp> stamps;
  for (const FrameRead& frame : some_frames(9)) {
    coordinates.insert(coordinates.end(), frame.positions.data(),
                       frame.positions.data() + frame.positions.size());
    stamps.push_back(frame.stamp);
  }
  const auto kept = [&](FrameMotion motion) {
    auto frames =
        std::make_unique<MemoryFrames>(std::vector<NecklaceBeads>{{.count = beads}}, coordinates, stamps);
    const FrameSurvey survey = survey_frames(*frames, false);
    return Scene(std::move(frames), survey, std::vector<double>(beads, 1), motion);
  };
  const Scene linear = scene_of(live(some_frames(9)), FrameMotion::linear);
  EXPECT_TRUE(linear.is_live());
  EXPECT_EQ(linear.frame_count(), 2U);  // those of the first step
  EXPECT_EQ(linear.frames(), nullptr);
  EXPECT_EQ(control_points<Linear>(linear), control_points<Linear>(kept(FrameMotion::linear)));
  EXPECT_EQ(linear.frame_count(), 9U);
  EXPECT_EQ(linear.stamp(0).picoseconds, 0.0);
  EXPECT_EQ(linear.stamp(8).picoseconds, 16.0);
  EXPECT_EQ(linear.live()->taken, 9U);
  EXPECT_EQ(control_points<Cubic>(scene_of(live(some_frames(9)), FrameMotion::hermite)),
            control_points<Cubic>(kept(FrameMotion::hermite)));
}

TEST(LiveFrames, EndBeforeAFrameThatCannotBeUsed) {
  struct Case {
    std::vector<FrameRead> frames = some_frames(6, true);
    std::string line;
  };
  std::vector<Case> cases(4);
  cases[0].frames[3].positions(1, 2) = std::numeric_limits<double>::quiet_NaN();
  cases[0].line = "not finite";
  cases[1].frames[3].stamp.picoseconds = 4;
  cases[1].line = "sim: frame 3: has the time 4 ps, expected one later than the 4 ps";
  cases[2].frames[3].cell.reset();
  cases[2].line = "sim: frame 3: has no cell";
  cases[3].frames[3].stamp.picoseconds.reset();
  cases[3].line = "sim: frame 3: has no time";
  for (const Case& one : cases) {
    const auto frames = live(one.frames);
    EXPECT_EQ(all_frames(*frames).size(), 3U) << one.line;
    EXPECT_TRUE(frames->is_truncated());
    EXPECT_FALSE(frames->is_open());
    EXPECT_THAT(frames->warnings(), ::testing::ElementsAre(HasSubstr(one.line)));
  }
  auto without_cells = cases[2].frames;
  const auto frames = live(without_cells);
  frames->leave_cells();
  EXPECT_EQ(all_frames(*frames).size(), 6U);
  EXPECT_FALSE(frames->is_truncated());
}

TEST(LiveFrames, SayThatAPathIsAGuess) {
  std::vector<FrameRead> frames = some_frames(3, true);
  frames[2].positions(0, 1) += 15;
  const auto source = live(frames);
  EXPECT_EQ(all_frames(*source).size(), 3U);
  EXPECT_THAT(source->warnings(), ::testing::ElementsAre(HasSubstr("its path is a guess")));
  EXPECT_FALSE(source->is_truncated());
}

TEST(LiveFrames, AreReadOnce) {
  EXPECT_THROW(static_cast<void>(live({})), InputError);
  EXPECT_THROW(scene_of(live(some_frames(1)), FrameMotion::linear), InputError);
  const auto frames = live(some_frames(4));
  EXPECT_THROW(static_cast<void>(survey_frames(*frames, false)), InputError);
  FrameRead frame;
  frames->seek(0);
  EXPECT_TRUE(frames->next(frame));
  frames->seek(1);
  EXPECT_THROW(frames->seek(0), InputError);
  const Scene broken = scene_of(live(some_frames(3), true), FrameMotion::linear);
  EXPECT_FALSE(broken.is_truncated());
  EXPECT_FALSE(broken.has_step(2));
  EXPECT_TRUE(broken.is_truncated());
}

}  // namespace
}  // namespace kds::live_frames_test
