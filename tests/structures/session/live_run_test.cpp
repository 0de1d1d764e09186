// A run over frames that come one by one has the events of a run over the same frames in memory.

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "motions/scene/live_frames.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/parallel_run.h"
#include "tests/support/inputs/frames_one_by_one.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::live_run_test {
namespace {

using namespace test;

TEST(LiveRun, HasTheEventsOfTheSameFrames) {
  ReadOptions reading;
  reading.frames = {0, 12, 1};
  const Trajectory trajectory = read_trajectory(data("trajectories/villin_hp36_300K.dcd"), reading);
  const std::vector<double> radii(trajectory.bead_count(), 2);
  for (const FrameMotion motion : {FrameMotion::linear, FrameMotion::hermite}) {
    const KineticRunOptions options{{"power", "wrapped", "contacts"}};
    const Scene kept(std::span(&trajectory, 1), radii, motion);
    KineticRun expected(kept, options);
    while (expected.run_step()) continue;
    expected.finish();

    MemoryFrames memory{std::span(&trajectory, 1)};
    const auto live_scene = [&] {
      memory.seek(0);
      auto frames = std::make_unique<LiveFrames>(
          std::make_unique<FramesOneByOne>(memory.necklaces(), all_frames(memory)));
      const FrameSurvey survey = frames->survey();
      return Scene(std::move(frames), survey, radii, motion);
    };
    const Scene scene = live_scene();
    KineticRun run(scene, options);
    std::size_t steps = 0;
    for (; run.run_step(); ++steps) EXPECT_LE(scene.frame_count(), steps + 4);  // no frame is read early
    run.finish();
    EXPECT_EQ(steps, 11U);
    EXPECT_EQ(run.simulator().fingerprint(), expected.simulator().fingerprint());
    EXPECT_GT(run.simulator().fingerprint(), 0U);
    EXPECT_THROW(run.go_to(3.5), std::invalid_argument);  // the frames have passed
    EXPECT_FALSE(run.run_step());

    const Scene driven = live_scene();
    KineticRun to_times(driven, options);
    for (const double time : {0.5, 3.0, 7.25, 11.0}) {
      to_times.go_to(time);
      EXPECT_LE(driven.frame_count(), static_cast<std::size_t>(time) + 4);
    }
    EXPECT_THROW(to_times.go_to(11.5), std::invalid_argument);
    to_times.finish();
    EXPECT_EQ(to_times.simulator().fingerprint(), expected.simulator().fingerprint());

    const Scene again = live_scene();
    ParallelRun parallel(again, options, {.threads = 4});
    EXPECT_EQ(parallel.uncut(), "its frames come one by one");
    std::size_t frames = 0;
    parallel.run([&](std::size_t frame) { EXPECT_EQ(frame, frames++); });
    EXPECT_EQ(frames, 12U);
    EXPECT_EQ(parallel.simulator().fingerprint(), expected.simulator().fingerprint());
  }
}

}  // namespace
}  // namespace kds::live_run_test
