// Tests runs over frames that come one by one: results while the run goes on are those of a shorter run.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "experiments/contacts/contacts_command.h"
#include "experiments/contacts/contacts_report.h"
#include "experiments/program/live_output.h"
#include "experiments/run/run_scene.h"
#include "motions/base/input_error.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/live_frames.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/support/inputs/frames_one_by_one.h"

namespace kds::test::live_run_test {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

const Trajectory& villin() {
  static const Trajectory trajectory = [] {
    ReadOptions options;
    options.topology = data_file("trajectories/villin_hp36_300K.pdb");
    options.selection = *Selection::parse("ca", "--select");
    options.frames = {0, 40, 1};
    options.time_step = 2;
    return read_trajectory(data_file("trajectories/villin_hp36_300K.dcd"), options);
  }();
  return trajectory;
}

/// Returns a scene of the first frames, which come one by one.
Scene live_scene(std::size_t frames) {
  MemoryFrames all(std::span(&villin(), 1));
  std::vector<FrameRead> first = all_frames(all);
  first.resize(frames);
  auto source =
      std::make_unique<LiveFrames>(std::make_unique<FramesOneByOne>(all.necklaces(), std::move(first)));
  const FrameSurvey survey = source->survey();
  return {std::move(source), survey, std::vector<double>(villin().bead_count(), 1.5)};
}

const auto silent = [](auto&&...) {};

/// Returns all files of `kds contacts` as one text.
std::string text_of(const ContactsReport& report) {
  const ContactsFigures figures = figures_of(report);
  Json json;
  add_contacts(report, figures, json);
  std::ostringstream intervals;
  write_intervals_csv(report, figures, intervals);
  return kds::text_of(json) + contacts_csv(report, figures) + frames_csv(report) + intervals.str();
}

/// Returns the results at each frame from 1 on, and, last, those at the end.
std::vector<std::string> contacts_at_frames(const ContactsTask& task, std::size_t frames) {
  const Scene scene = live_scene(frames);
  std::vector<std::string> texts;
  const auto report = follow_contacts(task, scene, silent, {{}, [&](const auto& make) {
                                                              const ContactsReport so_far = make();
                                                              EXPECT_FALSE(so_far.live->is_complete);
                                                              texts.push_back(text_of(so_far));
                                                            }});
  EXPECT_TRUE(report->live->is_complete);
  texts.push_back(text_of(*report));
  return texts;
}

TEST(LiveContacts, SoFarAreThoseOfAShorterRun) {
  for (const Arguments& rule : {Arguments{"8"}, {"7:9"}, {"7:9", "--gap", "3"}, {"8", "--by", "bead"}}) {
    Arguments arguments{"imd://localhost:8888", "--cutoff"};
    arguments.insert(arguments.end(), rule.begin(), rule.end());
    const ContactsTask task = parse_contacts_options(arguments).task;
    const std::vector<std::string> all = contacts_at_frames(task, 40);
    ASSERT_EQ(all.size(), 40U);
    EXPECT_EQ(all[38], all[39]);
    for (const std::size_t frame : {1U, 2U, 9U, 30U})
      EXPECT_EQ(all[frame - 1], contacts_at_frames(task, frame + 1).back()) << frame;
    const Scene kept(std::span(&villin(), 1), std::vector<double>(villin().bead_count(), 1.5));
    EXPECT_EQ(all.back(), text_of(*follow_contacts(task, kept, silent)));
  }
}

/// Returns a summary without times.
ordered_json counts_of(const ScratchDirectory& directory, const std::string& out) {
  ordered_json json = ordered_json::parse(content_of(directory / out / "summary.json"));
  for (auto& structure : json["structures"])
    for (const char* const name : {"seconds", "build_seconds"}) structure.erase(name);
  for (const char* const name : {"live", "complete", "engine", "command", "machine"}) json.erase(name);
  return json;
}

RunReport run_to(
    const std::filesystem::path& out, std::size_t frames,
    const std::function<void(std::size_t, RunResults&, const std::function<RunReport()>&)>& at_frame) {
  const RunOptions options = parse_run_options(
      {"imd://localhost:8888", "--structures", "contacts,wrapped,closest", "--out", out.string(), "--quiet"});
  const Scene scene = live_scene(frames);
  HeldWarnings warnings;
  RunResults results(options);
  std::size_t frame = 0;
  RunReport report = run_over(scene, warnings, options, silent, silent, results,
                              {{}, [&](const auto& make) { at_frame(++frame, results, make); }});
  results.add_distributions(report);
  results.deliver(report, report_json(report), "");
  return report;
}

TEST(LiveRun, ResultsSoFarAreThoseOfAShorterRun) {
  const ScratchDirectory directory;
  const RunReport report =
      run_to(directory / "all", 30, [&](std::size_t frame, RunResults& results, const auto& make) {
        if (frame != 4 && frame != 20) return;
        RunReport so_far = make();
        results.add_distributions(so_far);
        EXPECT_EQ(results.deliver_so_far(report_json(so_far)), std::nullopt);
        std::filesystem::copy(directory / "all", directory / std::to_string(frame));
      });
  EXPECT_EQ(report.frames, 30U);
  EXPECT_EQ(report.structures[0].static_seconds, 0);
  for (const std::size_t frame : {4U, 20U}) {
    const std::string at_frame = std::to_string(frame), shorter = "shorter" + at_frame;
    static_cast<void>(run_to(directory / shorter, frame + 1, silent));
    EXPECT_EQ(counts_of(directory, at_frame), counts_of(directory, shorter));
    for (const char* const file : {"events.csv", "contacts.csv"})
      EXPECT_EQ(content_of(directory / at_frame / file), content_of(directory / shorter / file)) << file;
    const auto json = ordered_json::parse(content_of(directory / at_frame / "summary.json"));
    EXPECT_EQ(json["complete"], false);
    EXPECT_FALSE(json["structures"]["contacts"].contains("static_seconds"));
  }
  const auto json = ordered_json::parse(content_of(directory / "all" / "summary.json"));
  EXPECT_EQ(json["complete"], true);
  EXPECT_EQ(json["live"]["received"], 30);
  EXPECT_THAT(comparison_table(report), testing::Not(HasSubstr("static")));
}

TEST(LiveRun, SaysWhereItIs) {
  const Scene scene = live_scene(2);
  EXPECT_EQ(LiveProgress(scene).state(1, 700, "events", 1041),
            "2 ps, 350.0 events/ps, 1,041 contacts now, kds waits");
}

TEST(LiveRun, SaysWhoWaitedForWhom) {
  ProgressBar bar(false, "step");
  testing::internal::CaptureStderr();
  EXPECT_EQ(end_of_live_run(bar, {true, 20.34, {10, 10, 12.06, 0}}, false), 0);
  EXPECT_EQ(end_of_live_run(bar, {}, true), 1);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::StartsWith("kds: waited 12.1 s for the simulation in 20.3 s; the simulation may have "
                                  "waited 0.0 s for kds\n"));
}

TEST(LiveRun, WritesSeldomIfWritingIsSlow) {
  ProgressBar bar(false, "step");
  ResultsSoFar regularly(bar, 0.0), never(bar, 1000.0);
  int written = 0;
  const auto hooks = regularly.hooks<int>(true, [&](int) {
    ++written;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return std::optional<std::string>();
  });
  for (int frame = 0; frame < 10; ++frame) hooks.at_frame([] { return 1; });
  EXPECT_EQ(written, 1);
  const auto late = never.hooks<int>(true, [&](int) {
    ++written;
    return std::optional<std::string>();
  });
  for (int frame = 0; frame < 10; ++frame) late.at_frame([] { return 1; });
  EXPECT_EQ(written, 1);
  EXPECT_FALSE(regularly.hooks<int>(false, {}).at_frame);
}

TEST(LiveOptions, RefuseWhatNeedsAllFrames) {
  const auto message = [](auto parse, Arguments arguments) {
    try {
      static_cast<void>(parse(arguments));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string live = "imd://localhost:8888";
  for (const Arguments& given : {Arguments{"--rounds", "2"},
                                 {"--log", "a"},
                                 {"--view", "a.html"},
                                 {"--certify", "--tolerance", "1"},
                                 {"--every", "5"},
                                 {"--continue"}}) {
    Arguments arguments{live};
    arguments.insert(arguments.end(), given.begin(), given.end());
    EXPECT_THAT(message(parse_run_options, arguments), testing::StartsWith(given.front() + ": "));
  }
  EXPECT_THAT(message(parse_contacts_options, {live, "--cutoff", "8", "--view", "a.html"}),
              HasSubstr("expected a trajectory"));
  EXPECT_THAT(message(parse_run_options, {"a.xyz", "--every", "5", "--out", "b"}),
              HasSubstr("expected its address, imd://HOST:PORT"));
  EXPECT_EQ(message(parse_run_options, {live, "--every", "5", "--continue", "--out", "b"}), "");
  const ScratchDirectory directory;
  static_cast<void>(directory.file("a", "b"));
  const std::string out = directory / "";
  EXPECT_THAT(message(parse_run_options, {live, "--out", out}), HasSubstr("--continue keeps them"));
  EXPECT_EQ(message(parse_run_options, {live, "--out", out, "--replace"}), "");
  std::filesystem::create_directory(directory / "part2");
  EXPECT_THAT(message(parse_run_options, {live, "--out", out, "--replace"}),
              HasSubstr("has parts of several"));
}

TEST(LiveParts, StandBesideEachOther) {
  const ScratchDirectory directory;
  const Json settings{{"cutoff", "8"}, {"gap", 2.0}};
  Destinations to;
  to.out = directory / "out";
  EXPECT_EQ(start_part("contacts.json", settings, to), std::nullopt);
  EXPECT_EQ(to.out, directory / "out");
  std::filesystem::create_directory(*to.out);
  static_cast<void>(
      directory.file("out/contacts.json", R"({"settings": {"cutoff": "8", "gap": 2.0, "by": "bead"}})"));
  EXPECT_THAT(start_part("contacts.json", settings, to), testing::Optional(HasSubstr("this is part 2")));
  EXPECT_EQ(to.out, directory / "out" / "part2");
  std::filesystem::create_directory(*to.out);
  to.out = directory / "out";
  EXPECT_THAT(start_part("contacts.json", settings, to), testing::Optional(HasSubstr("this is part 3")));
  to.out = directory / "out";
  EXPECT_THROW(static_cast<void>(start_part("contacts.json", {{"cutoff", "9"}}, to)), InputError);
  EXPECT_THROW(static_cast<void>(start_part("contacts.json", {{"apart", 3}}, to)), InputError);
}

TEST(LiveCourses, DoubleTheWidthOfTheirBins) {
  EventCourse course;
  for (std::size_t step = 0; step < 2 * EventCourse::most_bins + 1; ++step) course.add(step, {step, {}});
  EXPECT_EQ(course.width(), 4U);
  EXPECT_EQ(course.bins().size(), EventCourse::most_bins / 2 + 1);
  EXPECT_EQ(course.bins()[2].events, 8U + 9 + 10 + 11);
  EXPECT_EQ(course.bins()[2].first_frame.number, 8U);
}

TEST(LiveCourses, HaveTheMeansOfContacts) {
  constexpr std::size_t steps = 1501, width = 8;  // 300 bins of 1, 2 and 4 steps are too few
  Trajectory two_beads;
  two_beads.frames.assign(steps + 1, Eigen::Matrix3Xd::Random(3, 2));
  const Scene scene(std::span(&two_beads, 1), {1, 1});
  ContactCourse course(std::nullopt);
  std::vector<double> times((steps + width - 1) / width);
  std::mt19937 random(1);
  for (std::size_t frame = 0; frame <= steps; ++frame) {
    course.add_frame(frame, scene);
    if (frame == 0) continue;
    if (frame == steps) course.end(steps);
    const double end = static_cast<double>(frame) - 0.25 * static_cast<double>(random() % 4);
    const double begin = std::max(0.0, end - 0.5 * static_cast<double>(random() % 100));
    course.add(begin, end);
    for (std::size_t bin = 0; bin < times.size(); ++bin) {
      const auto first = static_cast<double>(bin * width);
      times[bin] += std::max(0.0, std::min(end, first + width) - std::max(begin, first));
    }
  }
  const std::vector<double> means = course.means();
  ASSERT_EQ(means.size(), times.size());
  for (std::size_t bin = 0; bin < times.size(); ++bin) {
    const std::size_t in_bin = std::min(width, steps - bin * width);
    EXPECT_NEAR(means[bin], times[bin] / static_cast<double>(in_bin), 1e-12);
    EXPECT_EQ(course.first_frames()[bin].number, bin * width);
  }
}

}  // namespace
}  // namespace kds::test::live_run_test
