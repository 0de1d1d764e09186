#include "kds/known_events.h"
#include "kds/simulator.h"

#include <gmock/gmock.h>

#include "tests/support/inputs/script.h"

namespace kds::simulator_replay_test {
namespace {

using namespace test;
using testing::ElementsAre;

std::uint64_t fingerprint_of(const std::vector<std::pair<double, BeadId>>& events) {
  Simulator simulator;
  Log log;
  Script a{simulator, log, "a"};
  a.on_start = [&] {
    for (const auto& [time, bead] : events)
      a.schedule("", falling(static_cast<long long>(time * 1024), 1024), bead);
  };
  simulator.build();
  simulator.run_step();
  return simulator.fingerprint();
}

TEST(SimulatorFingerprint, DependsOnTheOrderNotOnTheTime) {
  EXPECT_EQ(fingerprint_of({{0.25, 1}, {0.5, 2}}), fingerprint_of({{0.625, 2}, {0.125, 1}}));
  EXPECT_NE(fingerprint_of({{0.25, 1}, {0.5, 2}}), fingerprint_of({{0.25, 2}, {0.5, 1}}));
  EXPECT_NE(fingerprint_of({{0.25, 1}}), fingerprint_of({{0.25, 1}, {0.5, 1}}));
  EXPECT_EQ(fingerprint_of({}), Fingerprint().value());
}

TEST(SimulatorFingerprint, DependsOnTheStep) {
  std::vector<std::uint64_t> prints;
  for (const std::size_t step : {0U, 1U}) {
    Simulator simulator;
    Log log;
    Script a{simulator, log, "a"};
    a.on_start = [&] {
      if (simulator.step() == step) a.schedule("", falling(1, 2), 1);
    };
    simulator.build();
    simulator.run_step();
    simulator.run_step();
    prints.push_back(simulator.fingerprint());
  }
  EXPECT_NE(prints[0], prints[1]);
}

TEST(SimulatorReplay, EqualsTheRun) {
  const auto script = [](Simulator& simulator, Script& a, Script& b) {
    a.on_start = [&simulator, &a] {
      a.schedule("1/3", falling(1, 3), 3, [&simulator, &a] {
        a.change(0, 30 + static_cast<BeadId>(simulator.step()));
        a.change(2, 31);
      });
    };
    b.on_start = [&b] { b.schedule("1/4", falling(1, 4), 4); };
  };

  Simulator run;
  Log log;
  Script a{run, log, "a"};
  Script b{run, log, "b"};
  script(run, a, b);
  Listener listener;
  run.listen(listener);
  run.build();
  run.run_step();
  run.run_step();
  run.finish();

  Simulator replay;
  Log replay_log;
  Script replayed_a{replay, replay_log, "a"};
  Script replayed_b{replay, replay_log, "b"};
  // The log also contains the changes that structures make while they are built.
  replayed_a.on_build = [&] { replayed_a.change(2, 99); };
  Listener replay_listener;
  replay.listen(replay_listener);
  KnownEvents(replay).build_for_replay();
  for (std::size_t step = 0; step < 2; ++step) {
    std::vector<ReplayedEvent> events;
    for (const auto& heard : listener.heard) {
      if (heard.event.step == step)
        events.push_back(
            {heard.event.structure_index, heard.event.lower, heard.event.upper, heard.event.change, ""});
    }
    KnownEvents(replay).replay_step(events);
  }
  replay.finish();
  EXPECT_EQ(replay.fingerprint(), run.fingerprint());
  EXPECT_EQ(replayed_a.statistics.events_by_kind, a.statistics.events_by_kind);
  EXPECT_EQ(replayed_b.statistics.events_by_kind, b.statistics.events_by_kind);
  EXPECT_EQ(replayed_a.statistics.events_per_step, a.statistics.events_per_step);
  EXPECT_THAT(replay_log, ElementsAre("a build", "b build", "b apply 4", "a apply 30", "a apply 31",
                                      "a finish", "b finish", "b apply 4", "a apply 31", "a apply 31",
                                      "a finish", "b finish", "a end", "b end"));
  ASSERT_EQ(replay_listener.heard.size(), listener.heard.size());
  for (std::size_t i = 0; i < listener.heard.size(); ++i) {
    EXPECT_EQ(replay_listener.heard[i].event.change, listener.heard[i].event.change);
    EXPECT_EQ(replay_listener.heard[i].event.lower, listener.heard[i].event.lower);
    EXPECT_EQ(replay_listener.heard[i].event.upper, listener.heard[i].event.upper);
  }
}

TEST(SimulatorReplay, SaysWhereAChangeCannotBeMade) {
  Simulator simulator;
  Log log;
  Script a{simulator, log, "a"};
  KnownEvents(simulator).build_for_replay();
  const std::vector<ReplayedEvent> events{{0, 0.25, 0.25, {0, 1, {1}}, "log:7"},
                                          {0, 0.5, 0.5, {0, 1, {13}}, "log:8"}};
  std::string message;
  try {
    KnownEvents(simulator).replay_step(events);
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "log:8: unlucky");
}

}  // namespace
}  // namespace kds::simulator_replay_test
