// Tests the facade:
// - input: pushed frames, a scene, or a motion
// - structures by name and by type, some of them on a part of the beads
// - control: event by event, to a time, and back
// - the events that listeners receive, and the files that writers make of the events

#include "structures/session/kinetic_run.h"
#include "kds/event_log.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "structures/contacts/contacts.h"
#include "structures/hierarchy/wrapped_hierarchy.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/session/event_writers.h"
#include "structures/sorted/sorted_list.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::kinetic_run_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;

using Frame = std::vector<double>;

/// Makes frames of two necklaces whose beads wander, with `dimension` coordinates each.
std::vector<Frame> frames_of(int dimension, std::size_t count, unsigned seed = 1) {
  Random random(seed);
  std::vector<Frame> frames(count, Frame(static_cast<std::size_t>(dimension) * 14));
  for (std::size_t i = 0; i < frames[0].size(); ++i) {
    frames[0][i] = uniform(random, 0, 4);
    for (std::size_t f = 1; f < count; ++f) frames[f][i] = frames[f - 1][i] + uniform(random, -0.7, 0.7);
  }
  return frames;
}

PushedFrames beads_in(int dimension, FrameMotion motion = FrameMotion::linear) {
  return {dimension, {9, 5}, {0.4}, motion};
}

/// Makes a scene of the same frames, as if they were read from files.
Scene scene_of(int dimension, const std::vector<Frame>& frames, FrameMotion motion = FrameMotion::linear) {
  std::vector<Trajectory> necklaces(2);
  for (const Frame& frame : frames) {
    Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Zero(3, 14);
    for (int b = 0; b < 14; ++b)
      for (int axis = 0; axis < dimension; ++axis)
        all(axis, b) = frame[static_cast<std::size_t>(b * dimension + axis)];
    necklaces[0].frames.emplace_back(all.leftCols(9));
    necklaces[1].frames.emplace_back(all.rightCols(5));
  }
  return {necklaces, std::vector<double>(14, 0.4), motion};
}

const KineticRunOptions four{{"sorted", "wrapped", "power", "contacts"}};

std::vector<std::string> lines_of(const EventLog& log) {
  std::vector<std::string> lines;
  for (const Event& e : log.events) {
    std::ostringstream line;
    line << e.step << ' ' << e.from.number << ' ' << e.structure << ' ' << e.kind.name << ' ' << e.lower
         << ' ' << e.upper;
    for (const BeadId id : e.ids()) line << ' ' << id;
    lines.push_back(line.str());
  }
  return lines;
}

class RunOver : public testing::TestWithParam<std::pair<int, FrameMotion>> {
 protected:
  const int dimension = GetParam().first;
  const FrameMotion motion = GetParam().second;
  const std::vector<Frame> frames = frames_of(dimension, 6);
};

TEST_P(RunOver, PushedFramesIsARunOverTheScene) {
  const Scene scene = scene_of(dimension, frames, motion);
  KineticRun over_scene(scene, four);
  EventLog expected;
  over_scene.listen(expected);
  over_scene.finish();
  EXPECT_EQ(over_scene.simulator().step(), 5U);
  ASSERT_GT(expected.events.size(), 100U);

  KineticRun pushed(beads_in(dimension, motion), four);
  EventLog log;
  pushed.listen(log);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    pushed.push(frames[f]);
    const std::size_t lag = motion == FrameMotion::hermite ? 2 : 1;
    EXPECT_EQ(pushed.simulator().step(), f < lag ? 0 : f + 1 - lag);
  }
  pushed.finish();
  EXPECT_EQ(pushed.simulator().fingerprint(), over_scene.simulator().fingerprint());
  EXPECT_EQ(lines_of(log), lines_of(expected));
  EXPECT_THROW(pushed.push(frames[0]), std::logic_error);
  EXPECT_FALSE(pushed.run_step());
}

TEST_P(RunOver, EventByEventOrToTimesIsTheSameRun) {
  const Scene scene = scene_of(dimension, frames, motion);
  KineticRun at_once(scene, four), by_events(scene, four), by_times(scene, four);
  EventLog expected, by_event, by_time;
  at_once.listen(expected);
  by_events.listen(by_event);
  by_times.listen(by_time);
  at_once.finish();
  std::size_t times = 0, told = 0;
  for (; by_events.next_event(); ++times) {
    EXPECT_GT(by_event.events.size(), told);
    told = by_event.events.size();
  }
  EXPECT_GT(times, 50U);
  by_events.finish();
  for (const double time : {0.25, 0.25, 0.5, 1.0, 1.5, 3.125, 5.0}) {
    by_times.go_to(time);
    EXPECT_EQ(by_times.simulator().step(), static_cast<std::size_t>(time));
    EXPECT_EQ(by_times.within_step(), time != std::floor(time));
  }
  by_times.finish();
  EXPECT_EQ(lines_of(by_event), lines_of(expected));
  EXPECT_EQ(lines_of(by_time), lines_of(expected));
}

INSTANTIATE_TEST_SUITE_P(, RunOver,
                         testing::Values(std::pair(2, FrameMotion::linear), std::pair(3, FrameMotion::linear),
                                         std::pair(2, FrameMotion::hermite),
                                         std::pair(3, FrameMotion::hermite)));

TEST_P(RunOver, BuildingAndLoadingBeforeAStepIsTheSameRun) {
  const Scene scene = scene_of(dimension, frames, motion);
  KineticRun at_once(scene, four), in_parts(scene, four);
  EventLog expected, log;
  at_once.listen(expected);
  in_parts.listen(log);
  at_once.finish();
  in_parts.build();
  in_parts.build();  // a second build has no effect
  EXPECT_TRUE(log.events.empty());
  std::size_t steps = 0;
  for (; in_parts.load_step(); ++steps) {
    EXPECT_TRUE(in_parts.load_step());
    if (steps == 2) in_parts.go_to(2.5);
    EXPECT_TRUE(in_parts.load_step());
    EXPECT_TRUE(in_parts.run_step());
    EXPECT_FALSE(in_parts.within_step());
  }
  EXPECT_EQ(steps, 5U);
  in_parts.finish();
  EXPECT_EQ(in_parts.simulator().fingerprint(), at_once.simulator().fingerprint());
  EXPECT_EQ(lines_of(log), lines_of(expected));
  in_parts.go_to(0);
  EXPECT_TRUE(in_parts.load_step());
  in_parts.finish();
  EXPECT_EQ(in_parts.simulator().fingerprint(), at_once.simulator().fingerprint());
}

TEST(KineticRun, IsBuiltOnceItsFirstStepIsKnown) {
  KineticRun run(beads_in(3), four);
  const std::vector<Frame> frames = frames_of(3, 2);
  EXPECT_FALSE(run.load_step());
  run.take(frames[0]);
  EXPECT_THROW(run.build(), std::logic_error);
  run.take(frames[1]);
  EXPECT_NO_THROW(run.build());
  EXPECT_TRUE(run.run_step());
}

TEST(KineticRun, GoesBackByReplayWithItsEdits) {
  const Scene scene = scene_of(3, frames_of(3, 5));
  const KineticRunOptions options{{"sorted", "power", "contacts"}, Kernel::filtered, AuditMode::frames};
  const auto edit = [](KineticRun& run) {
    run.erase(0, 3);
    run.erase(2, 3);
  };
  const auto meddle = [&](KineticRun& run) {
    run.go_to(1.5);
    edit(run);
    ASSERT_TRUE(run.next_event());  // at an irrational time
    run.erase(1, 7);
    run.insert(0, 3);
    // The new course starts elsewhere and ends where the old course ends.
    run.change_motion({4}, [](SceneMotion& motion) {
      for (int axis = 0; axis < 3; ++axis) motion.set_coordinate(4, 0, axis, 2.0);
    });
  };
  KineticRun straight(scene, options);
  meddle(straight);
  straight.go_to(3.25);
  const auto fingerprint = straight.simulator().fingerprint();
  straight.finish();

  KineticRun run(scene, options);
  EventLog log;
  run.listen(log);
  meddle(run);
  run.go_to(3.25);
  const std::vector<std::string> told = lines_of(log);
  run.go_to(3.25);  // the run is already at this time
  for (const double back : {2.5, 1.75, 3.0}) {
    run.go_to(back);
    EXPECT_EQ(lines_of(log).size(), told.size());  // listeners are not notified
    run.go_to(3.25);
    EXPECT_EQ(run.simulator().fingerprint(), fingerprint) << back;
    const std::vector<std::string> again = lines_of(log);
    EXPECT_EQ(std::vector<std::string>(again.begin() + static_cast<std::ptrdiff_t>(told.size()), again.end()),
              std::vector<std::string>(told.end() - static_cast<std::ptrdiff_t>(again.size() - told.size()),
                                       told.end()));
    log.events.resize(told.size());
  }
  // Goes to a time before the edits, which forgets the edits.
  run.go_to(1.25);
  run.finish();
  KineticRun plain(scene, options);
  plain.finish();
  EXPECT_EQ(run.simulator().fingerprint(), plain.simulator().fingerprint());
  // Going back works after the end, too.
  run.go_to(0);
  run.finish();
  EXPECT_EQ(run.simulator().fingerprint(), plain.simulator().fingerprint());
}

// Certificate types of all structures have different numbers.
TEST(KineticRun, HoldsAllStructuresAtOnce) {
  for (const int dimension : {2, 3}) {
    const Scene scene = scene_of(dimension, frames_of(dimension, 3));
    KineticRunOptions all{.structures = {}, .audits = AuditMode::events};
    for (const StructureSpec& spec : structure_registry().all())
      if (!spec.refusal(scene)) all.structures.push_back(spec.name);
    EXPECT_GT(all.structures.size(), 9U);
    KineticRun run(scene, all);
    EXPECT_NO_THROW(run.finish());
  }
}

TEST(KineticRun, RefusesTimesThatItCannotGoTo) {
  const Scene scene = scene_of(2, frames_of(2, 3));
  KineticRun run(scene, four);
  for (const double time : {-0.5, 2.5, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(run.go_to(time), std::invalid_argument) << time;
  KineticRun pushed(beads_in(2), four);
  pushed.push(frames_of(2, 1)[0]);
  EXPECT_THROW(pushed.go_to(0.5), std::invalid_argument);
  pushed.take(frames_of(2, 2)[1]);
  pushed.go_to(0.5);
  EXPECT_THROW(pushed.go_to(0.25), std::invalid_argument);  // a run with pushed frames keeps no frames
  pushed.go_to(0.75);
  EXPECT_TRUE(pushed.within_step());
  pushed.take(frames_of(2, 3)[2]);  // ends the current step
  EXPECT_EQ(pushed.simulator().step(), 1U);
  pushed.finish();
  EXPECT_EQ(pushed.simulator().step(), 2U);
}

template <class Call>
std::string refusal_of(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(KineticRun, RefusesFramesThatAreNone) {
  KineticRun run(beads_in(2), four), other(beads_in(2), four);
  std::vector<Frame> frames = frames_of(2, 4);
  run.push(frames[0]);
  run.push(frames[1]);
  Frame broken = frames[2];
  broken[5] = std::nan("");
  EXPECT_EQ(refusal_of([&] { run.push(broken); }), "frame 2, bead 2: expected finite coordinates, found nan");
  broken.resize(26);
  EXPECT_EQ(refusal_of([&] { run.push(broken); }),
            "frame 2: expected 2 coordinates each of 14 beads, 28 numbers, found 26");
  EXPECT_THAT(refusal_of([&] { run.push({}); }), HasSubstr("found 0"));
  run.push(frames[2]);  // no event has happened
  run.push(frames[3]);
  for (const Frame& frame : frames) other.push(frame);
  EXPECT_EQ(run.simulator().fingerprint(), other.simulator().fingerprint());
  EXPECT_EQ(run.simulator().step(), 3U);
  EXPECT_THAT(refusal_of([] {
                KineticRun(PushedFrames{2, {}, {1}}, {});
              }),
              HasSubstr("expected beads, found none"));
  EXPECT_THAT(refusal_of([] { KineticRun(PushedFrames{2, {3, 0}, {1}}, {}); }), HasSubstr("necklace 1"));
  EXPECT_THAT(refusal_of([] { KineticRun(PushedFrames{4, {3}, {1}}, {}); }), HasSubstr("4 dimensions"));
  EXPECT_THAT(refusal_of([] { KineticRun(PushedFrames{2, {3}, {1, 2}}, {}); }), HasSubstr("as many radii"));
  EXPECT_THAT(refusal_of([] { KineticRun(PushedFrames{2, {3}, {-1}}, {}); }), HasSubstr("not negative"));
  EXPECT_THAT(refusal_of([] { KineticRun(PushedFrames{2, {3}, {}}, {{"contacts"}}); }), HasSubstr("radii"));
  EXPECT_THAT(refusal_of([] {
                KineticRun(PushedFrames{1, {3}, {}, FrameMotion::lifted}, {});
              }),
              HasSubstr("lifted"));
}

TEST(KineticRun, WithoutFramesOrEvents) {
  KineticRun none(beads_in(3), four);
  EXPECT_FALSE(none.next_event());
  EXPECT_FALSE(none.run_step());
  none.finish();
  KineticRun still({1, {3}}, {});  // points on a line use the sorted list
  ASSERT_EQ(still.structures().size(), 1U);
  still.push(std::vector<double>{1, 3, 2});
  still.push(std::vector<double>{1, 3, 2});
  EXPECT_FALSE(still.next_event());
  EXPECT_THAT(still.structure<SortedList<1>>(0).order(), ElementsAre(0, 2, 1));
  EXPECT_THROW(static_cast<void>(still.structure<SortedList<2>>(0)), std::invalid_argument);
  KineticRun nothing({1, {3}}, {.by_default = false});
  EXPECT_TRUE(nothing.structures().empty());
}

TEST(KineticRun, StructuresOfSomeBeadsOnly) {
  const std::vector<Frame> frames = frames_of(3, 4);
  const std::vector<BeadId> some{0, 2, 3, 5, 8, 9, 13};
  KineticRun run(beads_in(3), {.structures = {"sorted", "power", "contacts"},
                               .audits = AuditMode::events,
                               .only = {{"power", some}, {"contacts", some}}});
  run.add<SortedList<3>>();
  run.keep_only(3, some);
  EventLog log;
  run.listen(log);
  // Runs the same beads alone.
  std::vector<Frame> alone(frames.size());
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (const BeadId b : some)
      for (std::size_t axis = 0; axis < 3; ++axis) alone[f].push_back(frames[f][3 * b + axis]);
  KineticRun of_some({3, {some.size()}, {0.4}}, {.structures = {"sorted", "power"}});
  EventLog log_of_some;
  of_some.listen(log_of_some);
  for (const Frame& frame : frames) run.push(frame);
  for (const Frame& frame : alone) of_some.push(frame);
  run.finish();
  const auto events = [](const EventLog& of, std::size_t structure) {
    std::vector<std::string> lines;
    for (const Event& e : of.events)
      if (e.structure_index == structure && e.kind.external) lines.emplace_back(e.kind.name);
    return lines;
  };
  EXPECT_EQ(events(log, 3), events(log_of_some, 0));
  EXPECT_EQ(events(log, 1), events(log_of_some, 1));
  EXPECT_FALSE(events(log, 1).empty());
  EXPECT_FALSE(events(log, 2).empty());
  EXPECT_GT(events(log, 0).size(), events(log, 3).size());
  for (const Event& e : log.events) {
    if (e.structure_index == 0) continue;
    for (const BeadId id : e.ids())
      EXPECT_TRUE(id == no_bead || std::find(some.begin(), some.end(), id) != some.end()) << id;
  }
  EXPECT_THROW(run.keep_only(0, some), std::logic_error);  // the run has begun
}

TEST(KineticRun, RefusesSubsetsThatCannotBe) {
  const auto refusal = [](const KineticRunOptions& options) {
    return refusal_of([&] { KineticRun(beads_in(3), options); });
  };
  EXPECT_EQ(refusal({.structures = {"wrapped"}, .only = {{"wrapped", {1, 2}}}}),
            "wrapped: is of all beads; it cannot be of some only");
  EXPECT_THAT(refusal({.structures = {"sorted"}, .only = {{"sorted", {14}}}}), HasSubstr("no bead 14"));
  EXPECT_THAT(refusal({.structures = {"sorted"}, .only = {{"power", {1}}}}),
              HasSubstr("power: is to be of some beads only, and is not in the run"));
  EXPECT_THAT(refusal({.structures = {"nonsense"}}), HasSubstr("no such structure"));
  KineticRun run(beads_in(3), {.structures = {"wrapped"}});
  EXPECT_EQ(refusal_of([&] { run.insert(0, 1); }), "wrapped: its beads cannot come and go");
  EXPECT_THAT(refusal_of([&] { run.add<SortedList<2>>(); }), HasSubstr("in 3 dimensions"));
}

TEST(KineticRun, OverAMotionThatItsUserSets) {
  const std::vector<Frame> frames = frames_of(2, 4);
  BezierMotion<2, 1> motion(14);
  const auto set = [&](std::size_t step, double radius) {
    for (BeadId b = 0; b < 14; ++b) {
      for (int end = 0; end < 2; ++end) {
        for (int axis = 0; axis < 2; ++axis)
          motion.set_coordinate(
              b, end, axis,
              frames[step + static_cast<std::size_t>(end)][2 * b + static_cast<std::size_t>(axis)]);
        motion.set_radius(b, end, radius);
        motion.set_weight(b, end, radius * radius);
      }
    }
  };
  KineticRun run(motion, {{9, 5}, {0.4}}, four);
  EXPECT_EQ(run.structures().size(), 4U);
  EventLog log;
  run.listen(log);
  for (std::size_t step = 0; step < 3; ++step) {
    set(step, 0.4);
    if (step == 1) {
      while (run.next_event()) {
      }
    } else {
      EXPECT_TRUE(run.run_step());
    }
  }
  EXPECT_THROW(run.run(), std::logic_error);
  EXPECT_THROW(run.push(frames[0]), std::logic_error);
  EXPECT_THROW(run.change_motion({1}, [](SceneMotion&) {}), std::logic_error);
  set(2, 0.5);
  EXPECT_EQ(refusal_of([&] { run.run_step(); }),
            "bead 0: its radius is 0.5 in the motion, expected 0.4, as was said");
  run.finish();
  run.go_to(3.0);
  for (const double time : {3.5, 4.0, 5.0})  // no step follows
    EXPECT_THROW(run.go_to(time), std::invalid_argument) << time;
  const Scene scene = scene_of(2, frames);
  KineticRun expected(scene, four);
  EventLog expected_log;
  expected.listen(expected_log);
  expected.finish();
  EXPECT_EQ(lines_of(log), lines_of(expected_log));
  EXPECT_THAT(refusal_of([&] {
                KineticRun(motion, {{9, 6}, {0.4}}, four);
              }),
              HasSubstr("as many as the motion has"));
}

TEST(KineticRun, ACourseThatEndsElsewhereIsRefused) {
  const Scene scene = scene_of(3, frames_of(3, 4));
  KineticRun run(scene, {.structures = {"sorted"}});
  run.go_to(0.5);
  run.change_motion({4}, [](SceneMotion& motion) { motion.set_coordinate(4, 1, 0, 2.0); });
  for (int times = 0; times < 2; ++times) {
    EXPECT_EQ(refusal_of([&] { run.run(); }),
              "bead 4: its course was changed in step 0, and does not end where frame 1 has it");
    EXPECT_EQ(run.simulator().step(), 1U);
  }
  KineticRun plain(scene, {.structures = {"sorted"}});
  plain.finish();
  run.go_to(0.25);  // without that edit the run goes on
  run.finish();
  EXPECT_EQ(run.simulator().fingerprint(), plain.simulator().fingerprint());
}

TEST(KineticRun, ACourseThatCannotBeSetChangesNothing) {
  const Scene scene = scene_of(3, frames_of(3, 4));
  const KineticRunOptions options{.structures = {"sorted", "power", "contacts"}, .audits = AuditMode::frames};
  KineticRun plain(scene, options), run(scene, options);
  plain.finish();
  run.go_to(0.5);
  const auto set_and_throw = [&](auto more) {
    run.change_motion({4, 5, 4}, [&](SceneMotion& motion) {
      motion.set_coordinate(4, 1, 0, 2.0);
      more(motion);
    });
  };
  EXPECT_THROW(set_and_throw([](SceneMotion&) { throw std::runtime_error("enough"); }), std::runtime_error);
  EXPECT_THROW(set_and_throw([](SceneMotion& motion) { motion.load(1); }), std::logic_error);
  struct Number {
    BeadId bead;
    int k, axis;
    double value;
  };
  const std::vector<Number> wrong{{6, 0, 0, 1}, {14, 0, 0, 1}, {no_bead, 0, 0, 1}, {4, -1, 0, 1},
                                  {4, 2, 0, 1}, {4, 0, -1, 1}, {4, 0, 3, 1},       {4, 0, 0, std::nan("")}};
  for (const Number& n : wrong) {
    EXPECT_THROW(
        set_and_throw([&](SceneMotion& motion) { motion.set_coordinate(n.bead, n.k, n.axis, n.value); }),
        std::invalid_argument)
        << n.bead << ' ' << n.k << ' ' << n.axis;
    EXPECT_THROW(run.motion()->set_coordinate(n.bead, n.k, n.axis, n.bead == 6 ? std::nan("") : n.value),
                 std::invalid_argument);
  }
  EXPECT_THROW(run.change_motion({14}, [](SceneMotion&) {}), std::invalid_argument);
  run.finish();
  EXPECT_EQ(run.simulator().fingerprint(), plain.simulator().fingerprint());
}

TEST(KineticRun, NextEventStandsAtAFrameWhereSomethingHappensThere) {
  KineticRun run({1, {3}}, {.audits = AuditMode::events});
  const std::vector<Frame> frames{{0, 1, 5}, {1, 1, 5}, {3, 1, 5}, {3, 1, 5}};
  run.take(frames[0]);
  run.take(frames[1]);
  EXPECT_FALSE(run.next_event());  // the beads meet at the end, which is not an event
  run.take(frames[2]);
  ASSERT_TRUE(run.next_event());
  EXPECT_TRUE(run.within_step());
  EXPECT_EQ(run.simulator().step(), 1U);
  EXPECT_EQ(run.simulator().now().upper(), 0.0);
  EXPECT_THAT(run.structure<SortedList<1>>(0).order(), ElementsAre(1, 0, 2));
  run.erase(0, 2);  // time does not advance
  EXPECT_FALSE(run.next_event());
  run.take(frames[3]);
  EXPECT_FALSE(run.next_event());
  EXPECT_EQ(run.simulator().step(), 3U);
}

TEST(KineticRun, KeepsWhatWasSaidOfExactWorkWhenItGoesBack) {
  const Scene scene = scene_of(2, frames_of(2, 4));
  KineticRun run(scene, {.structures = {"sorted", "power"}, .kernel = Kernel::exact});
  int calls = 0;
  run.watch_work([&] { ++calls; }, 100);
  run.go_to(2);
  const int before = calls;
  EXPECT_GT(before, 1);
  run.go_to(1);
  EXPECT_GT(calls, before);
  run.go_to(2);
  EXPECT_EQ(calls, 2 * before);
  run.limit_work(run.simulator().exact_work().done() / 2);
  EXPECT_THROW(
      {
        run.go_to(1);
        run.go_to(2);
      },
      WorkLimitReached);
}

TEST(KineticRun, ASubsetThatCannotBeLeavesAllAsItWas) {
  KineticRun run(beads_in(2), {.structures = {"sorted"}});
  run.keep_only(0, {1, 2, 3, 4});
  EXPECT_EQ(refusal_of([&] { run.keep_only(0, {1, 2, 9}); }), "sorted: bead 9 is left out already");
  for (const BeadId bead : {3U, 4U}) EXPECT_FALSE(edits_of(*run.structures()[0])->is_absent(bead));
  run.keep_only(0, {4, 1});
  for (const Frame& frame : frames_of(2, 2)) run.push(frame);
  EXPECT_THAT(run.structure<SortedList<2>>(0).order(), testing::UnorderedElementsAre(1, 4));
}

TEST(KineticRun, IsAuditedWhereItStands) {
  KineticRun run(beads_in(3), {.structures = {"wrapped", "power"}});
  EXPECT_THROW(run.audit_now(), std::logic_error);
  for (const Frame& frame : frames_of(3, 2)) run.take(frame);
  for (int k = 0; k < 5 && run.next_event(); ++k) run.audit_now();
  run.finish();
  run.audit_now();
  EXPECT_EQ(run.structures()[1]->statistics.audits_run, 6U);
}

/// Returns the message of the exception, or nothing.
template <class Call>
std::string wrong_index(Call call) {
  try {
    static_cast<void>(call());
  } catch (const std::invalid_argument& refusal) {
    return refusal.what();
  }
  return "";
}

TEST(KineticRun, IndicesSayWhatThereIs) {
  const Scene scene = scene_of(2, frames_of(2, 3));
  KineticRun run(scene, {.structures = {"sorted", "wrapped"}});
  const std::string no_structure = "there is no structure 2: there are 2, numbered 0 to 1";
  EXPECT_EQ(wrong_index([&] { return &run.structure<SortedList<2>>(2); }), no_structure);
  EXPECT_EQ(wrong_index([&] { return run.keep_only(2, {}), 0; }), no_structure);
  EXPECT_EQ(wrong_index([&] { return run.built(2); }), no_structure);
  EXPECT_EQ(wrong_index([&] { return run.spheres_at(2, Dyadic(0.5)); }), no_structure);
  EXPECT_EQ(wrong_index([&] { return run.elements(2, 0); }), no_structure);
  EXPECT_EQ(wrong_index([&] { return run.simulator().seconds_of(2); }), no_structure);
  const std::string no_frame = "there is no frame 3: there are 3, numbered 0 to 2";
  EXPECT_EQ(wrong_index([&] { return run.elements(1, 3); }), no_frame);
  EXPECT_EQ(wrong_index([&] { return run.dump(3); }), no_frame);
  EXPECT_EQ(wrong_index([&] { return scene.stamp(3); }), no_frame);
  EXPECT_EQ(wrong_index([&] { return scene.centers(3); }), no_frame);
  EXPECT_EQ(wrong_index([&] { return scene.weights(3); }), no_frame);
  EXPECT_EQ(wrong_index([&] { return run.motion()->load(2), 0; }),
            "there is no step 2: there are 2, numbered 0 to 1");
  const std::string no_bead = "there is no bead 14: there are 14, numbered 0 to 13";
  EXPECT_EQ(wrong_index([&] { return scene.bead_name(14); }), no_bead);
  EXPECT_EQ(refusal_of([&] { run.keep_only(0, {14}); }), "sorted: " + no_bead);
  const auto& wrapped = run.structure<WrappedHierarchy<2>>(1);
  const std::string no_node = "there is no node 12: there are 12, numbered 0 to 11";
  EXPECT_EQ(wrong_index([&] { return wrapped.basis(12); }), no_node);
  EXPECT_EQ(wrong_index([&] { return wrapped.keeps(12); }), no_node);
  EXPECT_TRUE(run.run_step());
  EXPECT_TRUE(run.next_event());
  EXPECT_EQ(wrong_index([&] { return run.insert(2, 0), 0; }), no_structure);
  EXPECT_EQ(wrong_index([&] { return run.erase(0, 14), 0; }), no_bead);
  EXPECT_EQ(wrong_index([&] { return run.change_motion({14}, [](SceneMotion&) {}), 0; }), no_bead);
}

TEST(EventWriters, CsvAndJsonLines) {
  std::ostringstream csv, json, timed;  // times are known from the first frame on
  KineticRun run({2, {3}, {0.5}},
                 {.structures = {"sorted", "wrapped", "contacts"}, .settings = {.apart = 1}});
  EventCsv csv_writer(csv, run.scene());
  EventJsonLines json_writer(json, run.scene());
  run.listen(csv_writer);
  run.listen(json_writer);
  run.push(std::vector<double>{0, 0, 2, 0, 4, 1}, 10.0);
  EventCsv timed_writer(timed, run.scene());
  run.listen(timed_writer);
  run.push(std::vector<double>{0, 0, -2, 0, 4, 1}, 12.0);
  run.finish();
  const std::string quarter = "0[.]2[0-9]*,0[.]2[0-9]*", half = "0[.][45][0-9]*,0[.]5[0-9]*",
                    three_quarters = "0[.]7[0-9]*,0[.]7[0-9]*";
  EXPECT_THAT(csv.str(),
              MatchesRegex("frame,lower,upper,picoseconds,structure,kind,external,node,beads,residues\n"
                           "0," +
                           quarter +
                           ",10[.]5,contacts,begin,1,,0 1,- -\n"
                           "0," +
                           half +
                           ",11,sorted,interchange,1,,0 1,- -\n"
                           "0," +
                           half +
                           ",11,wrapped,pivot,1,0-2,1 2,- -\n"
                           "0," +
                           three_quarters + ",11[.]5,contacts,end,1,,0 1,- -\n"));
  EXPECT_EQ(timed.str(), csv.str());
  EXPECT_THAT(
      json.str(),
      MatchesRegex("[{]\"step\":0,\"frame\":0,\"time\":0.25,\"picoseconds\":10.5,\"lower\":0[.]2[0-9]*,"
                   "\"upper\":0[.]2[0-9]*,\"structure\":\"contacts\",\"kind\":\"begin\","
                   "\"external\":true,\"ids\":[{]\"first\":[[]0],\"second\":[[]1][}][}]\n(.|\n)*"));
  EXPECT_THAT(json.str(), HasSubstr("\"ids\":{\"node\":[0,2],\"basis\":[1,2]}}\n"));
}

TEST(EventWriters, CsvHasItsHeaderWithoutEventsTimesOrFrames) {
  std::ostringstream csv;
  KineticRun run({1, {2}}, {});
  EventCsv writer(csv, run.scene());
  run.listen(writer);
  run.finish();
  EXPECT_EQ(csv.str(), "");
  for (int times = 0; times < 2; ++times) {
    writer.finish();
    EXPECT_EQ(csv.str(), "frame,lower,upper,structure,kind,external,node,beads,residues\n");
  }
  std::ostringstream known;  // a run whose frames exist from the start
  const Scene scene = scene_of(2, frames_of(2, 2));
  EventCsv at_once(known, scene);
  EXPECT_EQ(known.str(), csv.str());
}

}  // namespace
}  // namespace kds::kinetic_run_test
