// The data of a replay page, decoded by a reader that shares no code with the writer, are the frames, curves,
// events and states of the run. Tests also the size of a page and the text around the data.

#include "experiments/view/replay_page.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/output/page_templates.h"
#include "experiments/view/replay_columns.h"
#include "kds/event_log.h"
#include "motions/base/input_error.h"
#include "motions/curves/bezier_motion.h"
#include "motions/readers/instance.h"
#include "motions/readers/read_trajectory.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/parallel_run.h"
#include "tests/experiments/count_of.h"
#include "tests/experiments/replay_data.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/support/inputs/random.h"

namespace kds::test::replay_page_test {
namespace {

using testing::HasSubstr;

Scene random_scene(int dimension, FrameMotion motion, std::size_t frames, std::uint64_t seed) {
  Random random(seed);
  std::vector<Trajectory> necklaces(2);
  std::vector<double> radii;
  for (const Eigen::Index beads : {9, 7}) {
    Trajectory& necklace = necklaces[beads == 9 ? 0 : 1];
    for (std::size_t f = 0; f < frames; ++f) {
      Eigen::Matrix3Xd positions = Eigen::Matrix3Xd::Zero(3, beads);
      for (Eigen::Index b = 0; b < beads; ++b)
        for (int axis = 0; axis < dimension; ++axis) positions(axis, b) = uniform(random, -20, 20);
      necklace.frames.push_back(positions);
    }
    for (Eigen::Index b = 0; b < beads; ++b) radii.push_back(uniform(random, 1, 3));
  }
  return {necklaces, radii, motion};
}

struct Recorded {
  std::string page;
  EventLog log;
};

Recorded record(const Scene& scene, const KineticRunOptions& options, const ReplayPageOptions& page) {
  Recorded recorded;
  KineticRun run(scene, options);
  ReplayRecorder recorder(run);
  run.listen(recorder);
  run.listen(recorded.log);
  run.build();
  recorder.begin();
  while (run.run_step()) recorder.reach_frame();
  run.finish();
  std::ostringstream stream;
  write_replay_page(stream, scene, recorder, page);
  recorded.page = stream.str();
  return recorded;
}

void expect_frames(const ReplayData& data, const Scene& scene) {
  const double half = data.meta["quantum"].get<double>() * 0.5000001;
  const auto positions = data.positions();
  ASSERT_EQ(positions.size(), scene.frame_count());
  for (std::size_t f = 0; f < positions.size(); ++f) {
    const Eigen::Matrix3Xd centers = scene.centers(f);
    for (std::size_t b = 0; b < positions[f].size(); ++b)
      for (std::size_t axis = 0; axis < positions[f][b].size(); ++axis)
        ASSERT_NEAR(positions[f][b][axis],
                    centers(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(b)), half);
  }
  if (scene.degree() == 1) return;
  const auto controls = data.controls();
  const auto motion = make_scene_motion(scene);
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    motion->load(step);
    std::visit(
        [&](const auto& ref) {
          const auto curves = ref.curves();
          for (int j = 1; j < scene.degree(); ++j)
            for (BeadId b = 0; b < scene.bead_count(); ++b)
              for (int axis = 0; axis < scene.dimension(); ++axis)
                ASSERT_NEAR(
                    controls[step][static_cast<std::size_t>(j) - 1][b][static_cast<std::size_t>(axis)],
                    curves.coordinate(b, j, axis), half);
        },
        motion->ref());
  }
}

/// The shown bracket encloses that of the event and is hardly wider.
void expect_bracket(double lower, double upper, const Event& event) {
  EXPECT_LE(lower, event.lower);
  EXPECT_GE(upper, event.upper);
  EXPECT_LE(upper - lower, 4 * (event.upper - event.lower) + 0x1p-30);
  EXPECT_TRUE(lower < upper || event.lower == event.upper);
  EXPECT_TRUE(upper > 0 || event.upper == 0);
}

void expect_events(const ReplayData& data, const EventLog& log) {
  std::size_t all = 0;
  std::set<std::uint32_t> orders;
  for (std::size_t s = 0; s < data.meta["structures"].size(); ++s) {
    const ReplayData::Events events = data.events(s);
    std::size_t k = 0;
    for (const Event& event : log.events) {
      if (event.structure_index != s) continue;
      if (events.kind.at(k) == "rebuild-at-frame") ++k;
      ASSERT_LT(k, events.step.size());
      EXPECT_EQ(events.step[k], event.step);
      expect_bracket(events.lower[k], events.upper[k], event);
      EXPECT_EQ(events.kind[k], event.kind.name);
      EXPECT_EQ(events.ids[k], ReplayData::Ids(event.ids().begin(), event.ids().end()));
      ++k;
    }
    orders.insert(events.order.begin(), events.order.end());
    all += events.step.size();
  }
  EXPECT_EQ(orders.size(), all);
}

TEST(ShownTime, EnclosesBracketsAndKeepsTimesOfTheGrid) {
  for (const double u : {0.0, 0.5, 1.0, 0x1p-32, 1 - 0x1p-32}) {
    EXPECT_EQ(shown_time(u, u).reach, 0);
    EXPECT_EQ(std::ldexp(static_cast<double>(shown_time(u, u).middle), -32), u);
  }
  Random random(5);
  for (int round = 0; round < 2000; ++round) {
    const double width = std::ldexp(uniform(random, 0, 1), round % 60 == 0 ? -2000 : -(round % 60));
    const double lower = uniform(random, 0, 1 - width), upper = round % 60 == 0 ? lower : lower + width;
    const ShownTime time = shown_time(lower, upper);
    const double middle = static_cast<double>(time.middle), away = std::ldexp(1, time.reach - 1);
    ASSERT_GE(time.reach, 1);
    EXPECT_LE(std::ldexp(middle - away, -32), lower);
    EXPECT_GE(std::ldexp(middle + away, -32), upper);
    EXPECT_GE(time.middle, 1);
    if (time.reach > 1) {  // half of it is too little
      EXPECT_TRUE(std::ldexp(middle - away / 2, -32) > lower || std::ldexp(middle + away / 2, -32) < upper);
    }
  }
  EXPECT_EQ(shown_time(0x1p-80, 0x1p-79).middle, 1) << "an event just after a frame is not at the frame";
}

std::set<std::string> stages_of(const Scene& scene, Kernel kernel) {
  const Recorded recorded =
      record(scene, {.structures = {"wrapped", "power", "contacts"}, .kernel = kernel}, {});
  const ReplayData data(recorded.page);
  std::set<std::string> stages;
  for (std::size_t s = 0; s < 3; ++s)
    for (const std::string& stage : data.events(s).stage) stages.insert(stage);
  return stages;
}

TEST(ReplayPage, NamesTheStageThatDecidedAnEvent) {
  const Scene scene = random_scene(3, FrameMotion::linear, 5, 7);
  EXPECT_THAT(stages_of(scene, Kernel::exact), testing::ElementsAre("integers"));
  EXPECT_THAT(stages_of(scene, Kernel::filtered),
              testing::AllOf(testing::Contains("floating point, with proved error bounds"),
                             testing::Not(testing::Contains(""))));
}

TEST(ReplayPage, StagesSurviveTheJoiningOfParts) {
  const Scene scene = random_scene(3, FrameMotion::linear, 5, 7);
  EventLog log;
  ParallelRun run(scene, {.structures = {"power", "contacts"}, .kernel = Kernel::exact},
                  {.threads = 2, .steps_per_part = 1});
  run.listen(log);
  run.run([](std::size_t) {});
  EXPECT_GT(log.events.size(), 20U);
  for (const Event& event : log.events) EXPECT_EQ(event.decided_by, DecidedBy::exact);
}

class PageOf : public testing::TestWithParam<std::pair<int, FrameMotion>> {};

TEST_P(PageOf, RandomScenesHasTheirFramesCurvesAndEvents) {
  const auto [dimension, motion] = GetParam();
  const Scene scene = random_scene(dimension, motion, 5, 7);
  const Recorded recorded = record(scene, {{"wrapped", "power", "contacts"}}, {{}, 0.125, {}});
  const ReplayData data(recorded.page);
  EXPECT_EQ(data.meta["quantum"], 0.125);
  EXPECT_EQ(data.meta["dimension"], dimension);
  EXPECT_EQ(data.meta["degree"], scene.degree());
  EXPECT_EQ(data.meta["motion"], std::string(name_of(motion)));
  EXPECT_EQ(data.meta["necklaces"], nlohmann::json({9, 7}));
  EXPECT_TRUE(data.meta["radius"].is_null());
  EXPECT_EQ(data.block("radii").size(), 8U * 16);
  expect_frames(data, scene);
  expect_events(data, recorded.log);
  const ReplayData::Ids nodes = data.words("nodes-0");
  ASSERT_EQ(nodes.size(), 4U * 14);  // 8 + 6 internal nodes
  EXPECT_EQ(std::vector(nodes.begin(), nodes.begin() + 4), (std::vector<std::uint32_t>{0, 9, 0, 0xffffffff}));
  EXPECT_EQ(std::vector(nodes.begin() + 4, nodes.begin() + 8), (std::vector<std::uint32_t>{0, 5, 1, 0}));
  EXPECT_EQ(std::vector(nodes.begin() + 32, nodes.begin() + 36),
            (std::vector<std::uint32_t>{9, 16, 0, 0xffffffff}));
}
INSTANTIATE_TEST_SUITE_P(ReplayPage, PageOf,
                         testing::Values(std::pair(2, FrameMotion::linear), std::pair(3, FrameMotion::linear),
                                         std::pair(2, FrameMotion::hermite),
                                         std::pair(3, FrameMotion::hermite)));

TEST(ReplayPage, HasSeveralBlocksOfFrames) {
  const Scene scene = random_scene(3, FrameMotion::hermite, 150, 3);
  const Recorded recorded = record(scene, {{"contacts"}}, {});
  const ReplayData data(recorded.page);
  EXPECT_EQ(data.meta["block_frames"], 64);
  EXPECT_GT(data.block("positions-2").size(), 0U);
  expect_frames(data, scene);
  EXPECT_EQ(data.words("frames").back(), 149U);
  EXPECT_FALSE(data.meta["has_times"]);
}

TEST(ReplayPage, ShowsInstancesOfHighDegree) {
  for (const char* name : {"d2_n20_degree3", "w3_n20_degree3_visible", "d3_n20_degree2"}) {
    const Scene scene(read_instance(data_file(std::string("kinetic/") + name + ".txt")));
    ReplayLabels labels;
    labels.in_angstrom = false;
    const Recorded recorded = record(scene, {{"power"}}, {labels, {}, {}});
    const ReplayData data(recorded.page);
    EXPECT_EQ(data.meta["length_unit"], "");
    EXPECT_THAT(data.meta["quantum_note"].get<std::string>(), HasSubstr("names no unit"));
    expect_frames(data, scene);
    expect_events(data, recorded.log);
  }
}

TEST(ReplayPage, RefusesCoordinatesTooLargeForTheQuantum) {
  const Scene scene = random_scene(3, FrameMotion::linear, 2, 1);
  EXPECT_THROW(static_cast<void>(record(scene, {{"contacts"}}, {{}, 1e-9, {}})), InputError);
  try {
    static_cast<void>(record(scene, {{"contacts"}}, {{}, 1e-9, {}}));
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--quantum 1e-09: frame 0, bead "));
    EXPECT_THAT(error.what(), HasSubstr("at least --quantum "));
  }
}

TEST(ReplayPage, ShowsPointsOnALine) {
  const Scene scene(read_instance(data_file("kinetic/d1_n20_linear.txt")));
  const Recorded recorded = record(scene, {{"sorted"}}, {});
  const ReplayData data(recorded.page);
  expect_frames(data, scene);
  expect_events(data, recorded.log);
}

TEST(ReplayPage, StopsOnceItIsTooLarge) {
  const Scene scene = random_scene(3, FrameMotion::linear, 200, 1);
  std::ostringstream stream;
  ReplayPage page(stream, scene, {{}, 1e-4, 2000});
  EXPECT_THROW(page.write_frames(), ReplayTooLarge);
}

TEST(ReplayPage, MayHaveExactlyTheMostBytes) {
  const Scene scene = random_scene(3, FrameMotion::linear, 300, 1);  // five blocks of frames
  const std::string page = record(scene, {{"contacts"}}, {}).page;
  EXPECT_EQ(record(scene, {{"contacts"}}, {{}, {}, page.size()}).page, page);
  EXPECT_THROW(static_cast<void>(record(scene, {{"contacts"}}, {{}, {}, page.size() - 1})), ReplayTooLarge);
}

TEST(ReplayPage, RefusesScenesThatWouldBeBlank) {
  const auto expect_refused = [](const Scene& scene, std::optional<double> quantum, const char* message) {
    std::ostringstream stream;
    ReplayPage page(stream, scene, {{}, quantum, {}});
    try {
      page.write_frames();
      ADD_FAILURE() << message;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
  };
  const auto scaled = [](double factor) {
    Trajectory necklace;
    for (const double moved : {0.0, 1.0})
      necklace.frames.emplace_back(factor * Eigen::Matrix3Xd{{0, 1, 2 + moved}, {0, 2, 0}, {0, 0, 1}});
    return Scene(std::vector{necklace}, std::vector<double>(3, factor), FrameMotion::linear);
  };
  expect_refused(scaled(1), 100,
                 "--quantum 100: the scene is smaller than one step; all beads of frame 0 lie within 4;");
  expect_refused(scaled(1), 100, "at most --quantum 0.04");
  expect_refused(scaled(1e18), {},
                 "frame 0: all beads lie within 4e+18, and a page shows lengths from 1e-15 to 1e+18");
  expect_refused(scaled(1e-16), {}, "frame 0: all beads lie within 4e-16");
  std::ostringstream stream;
  ReplayPage(stream, scaled(1e17), {{}, 1e15, {}}).write_frames();
  ReplayPage(stream, scaled(1e-14), {{}, 1e-16, {}}).write_frames();
}

TEST(ReplayPage, NamesAQuantumThatHoldsForAllFrames) {
  Trajectory necklace;
  for (const double moved : {0.0, 1e9, 1e11})
    necklace.frames.emplace_back(Eigen::Matrix3Xd{{moved, moved + 4}, {0, 0}, {0, 0}});
  const Scene scene(std::vector{necklace}, {1, 1}, FrameMotion::linear);
  std::ostringstream stream;
  try {
    ReplayPage(stream, scene, {}).write_frames();
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("frame 1, bead 0 lies 1e+09"));
    EXPECT_THAT(error.what(), HasSubstr("at least --quantum 745"));
  }
  ReplayPage(stream, scene, {{}, 745.1, {}}).write_frames();
}

std::string text_of_template() {
  std::string text;
  for (const std::string_view piece : replay_template()) text += piece;
  return text;
}

TEST(ReplayPage, IsTheTemplateAroundTheData) {
  const std::string text = text_of_template();
  EXPECT_EQ(count_of(text, std::string(page_data_mark)), 1U);
  std::ifstream file(KDS_REPLAY_PAGE, std::ios::binary);
  EXPECT_TRUE(text == std::string(std::istreambuf_iterator<char>(file), {}));
  const Scene scene = random_scene(3, FrameMotion::linear, 3, 1);
  const std::string page = record(scene, {{"power"}}, {}).page;
  const std::size_t mark = text.find(page_data_mark);
  EXPECT_TRUE(page.starts_with(text.substr(0, mark)));
  EXPECT_TRUE(page.ends_with(text.substr(mark + page_data_mark.size())));
}

TEST(ReplayPage, IsHarmlessForAnyNames) {
  const Scene scene = random_scene(3, FrameMotion::linear, 3, 1);
  ReplayLabels labels;
  labels.title = "</script><script>alert(1)</script><!--";
  labels.inputs = {"\xff\"\\</SCRIPT\n>"};
  labels.command = "kds view '</script>'";
  const std::string page = record(scene, {{"power"}}, {labels, {}, {}}).page;
  const std::string text = text_of_template();
  const std::string data = page.substr(text.find(page_data_mark));
  const ReplayData replay(page);
  EXPECT_EQ(count_of(data, "<script"),
            count_of(text.substr(text.find(page_data_mark)), "<script") + replay.block_count() + 1);
  EXPECT_EQ(replay.meta["title"], labels.title);
  EXPECT_EQ(replay.meta["command"], labels.command);
}

TEST(ReplayBlocks, EncodeNumbers) {
  BlockBytes bytes;
  for (const std::int64_t number : {0, -1, 1, 63, -64, 64, 8191}) bytes.add_varint(number);
  EXPECT_EQ(bytes.bytes(), std::string("\x00\x01\x02\x7e\x7f\x80\x01\xfe\x7f", 9));
  bytes.clear();
  bytes.add_word(0x01020304);
  bytes.add_double(1);
  EXPECT_EQ(bytes.bytes(), std::string("\x04\x03\x02\x01\0\0\0\0\0\0\xf0\x3f", 12));
}

}  // namespace
}  // namespace kds::test::replay_page_test
