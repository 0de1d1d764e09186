#include "kds/simulator.h"
#include "kds/known_events.h"

#include <gmock/gmock.h>

#include <chrono>

#include "certificates/exact/exact_time.h"
#include "tests/support/inputs/script.h"

namespace kds::simulator_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

class SimulatorTest : public testing::Test {
 protected:
  void run(bool last = true) {
    if (simulator.step() == 0) simulator.build();
    simulator.run_step();
    if (last) simulator.finish();
  }

  Simulator simulator;
  Log log;
  Script a{simulator, log, "a"};
};

TEST_F(SimulatorTest, DispatchesInTheOrderOfTime) {
  a.on_start = [&] {
    a.schedule("3/4", falling(3, 4), 1);
    a.schedule("1/3", falling(1, 3), 2);
    a.schedule("1/2", falling(1, 2), 3);
    a.schedule("2/5", falling(2, 5), 4);
  };
  run();
  EXPECT_THAT(log,
              ElementsAre("a build", "a start", "a 1/3", "a 2/5", "a 1/2", "a 3/4", "a finish", "a end"));
  EXPECT_EQ(a.retired, 4);
  EXPECT_EQ(a.cleared, 1);
}

TEST_F(SimulatorTest, RunsTimeByTime) {
  a.on_start = [&] {
    a.schedule("1/2", falling(1, 2), 1);
    a.schedule("1/3", falling(1, 3), 2);
    a.schedule("1/2 again", falling(2, 4), 3, [&] { a.needs_after_batch = true; });
  };
  simulator.build();
  EXPECT_THROW(static_cast<void>(simulator.run_next()), std::logic_error);
  EXPECT_THROW(simulator.require_standing_still(), std::invalid_argument);
  simulator.enter_step();
  simulator.require_standing_still();
  log.clear();
  EXPECT_TRUE(simulator.run_next());
  EXPECT_THAT(log, ElementsAre("a 1/3"));
  // The time 1/3 is not a double. The time stays known exactly, even after the certificate is dropped.
  EXPECT_EQ(a.retired, 1);
  ExactTime before(Dyadic(0.333)), after(Dyadic(0.334));
  EXPECT_LT(ExactTime::compare(before, simulator.now().exact()), 0);
  EXPECT_GT(ExactTime::compare(after, simulator.now().exact()), 0);
  simulator.require_standing_still();
  EXPECT_TRUE(simulator.run_next());
  EXPECT_THAT(log, ElementsAre("a 1/3", "a 1/2", "a 1/2 again", "a settle"));
  ExactTime half(Dyadic(0.5));
  EXPECT_EQ(ExactTime::compare(half, simulator.now().exact()), 0);
  EXPECT_FALSE(simulator.run_next());
  EXPECT_EQ(ExactTime::compare(half, simulator.now().exact()), 0);  // the time does not change
  simulator.run_until(Dyadic(0.5));
  simulator.leave_step();
  EXPECT_THROW(simulator.require_standing_still(), std::invalid_argument);
  EXPECT_THROW(simulator.change_motion({}, [] { FAIL(); }), std::invalid_argument);
}

TEST_F(SimulatorTest, EventsTellOfFramesAsTheyAreSet) {
  Listener listener;
  simulator.listen(listener);
  a.on_start = [&] { a.schedule("1/2", falling(1, 2), 1); };
  simulator.build();
  simulator.set_frames({7, 1.5}, {9, 2.5});
  simulator.run_step();
  simulator.run_step();
  ASSERT_EQ(listener.heard.size(), 2U);
  EXPECT_EQ(listener.heard[0].event.frame(), 8.0);
  EXPECT_EQ(listener.heard[0].event.picoseconds(), 2.0);
  EXPECT_EQ(listener.heard[1].event.frame(), 1.5);  // the default unit of frames is steps
  EXPECT_EQ(listener.heard[1].event.picoseconds(), std::nullopt);
  EXPECT_EQ(listener.heard[1].event.kind.name, "turn");
}

TEST_F(SimulatorTest, TimesAreRoundedForListenersThatPrintThem) {
  struct Printer final : EventListener {
    void on_event(const Event& event) override { heard.push_back(event); }
    [[nodiscard]] bool prints_time_of(const Event& event) const override { return event.kind.name == "turn"; }
    std::vector<Event> heard;
  } printer;
  Listener before;
  simulator.listen(before);
  simulator.listen(printer);
  a.on_start = [&] {
    a.schedule("root", falling_at_root_of_one_over(3), 1);
    a.schedule("1/2", falling(1, 2), 2);
    a.schedule("later", falling(3, 4), 3, [&] { a.change(1, 3); });
  };
  simulator.build();
  simulator.set_frames({7, {}}, {9, 2.5});
  simulator.run_step();
  ASSERT_EQ(printer.heard.size(), 3U);
  EXPECT_EQ(printer.heard[0].frame(), 8.0);
  EXPECT_EQ(printer.heard[1].frame(), 8.15470053838);  // 7 + 2 / sqrt(3)
  EXPECT_EQ(printer.heard[1].picoseconds(), std::nullopt);
  EXPECT_FALSE(printer.heard[2].rounded);  // a tick, whose time is not printed
  EXPECT_FALSE(before.heard[1].event.rounded);
  EXPECT_EQ(printer.heard[1].lower, before.heard[1].event.lower);
  EXPECT_EQ(printer.heard[1].upper, before.heard[1].event.upper);
}

TEST_F(SimulatorTest, AStepOfTooManyFailuresIsGivenUp) {
  a.on_start = [&] {
    a.schedule("3/4", falling(3, 4), 1);
    a.schedule("1/3", falling(1, 3), 2);
    a.schedule("1/2", falling(1, 2), 3);
  };
  simulator.build();
  EXPECT_FALSE(simulator.try_step(2));
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a 1/3", "a 1/2"));
  EXPECT_EQ(a.cleared, 1);
  EXPECT_EQ(simulator.step(), 1U);
  // The next step runs as usual.
  log.clear();
  EXPECT_TRUE(simulator.try_step(3));
  simulator.finish();
  EXPECT_THAT(log, ElementsAre("a start", "a 1/3", "a 1/2", "a 3/4", "a finish", "a end"));
  EXPECT_EQ(simulator.step(), 2U);
}

TEST_F(SimulatorTest, NowIsTheBracketOfTheEvent) {
  a.on_start = [&] {
    EXPECT_EQ(simulator.now().lower(), 0);
    EXPECT_EQ(simulator.now().upper(), 0);
    a.schedule("1/3", falling(1, 3), 1, [&] {
      EXPECT_LT(simulator.now().lower(), 1.0 / 3);
      EXPECT_GT(simulator.now().upper(), std::nextafter(1.0 / 3, 0));
      EXPECT_LT(simulator.now().upper() - simulator.now().lower(), 1e-9);
      ExactTime third(ExactPolynomial(Scaled{1, -2}), {Dyadic(0.0), Dyadic(1.0)});
      EXPECT_EQ(ExactTime::compare(simulator.now().exact(), third), 0);
    });
  };
  run();
  EXPECT_EQ(simulator.now().lower(), 1);
}

TEST_F(SimulatorTest, EqualTimesComeInTheOrderOfIdentities) {
  a.on_start = [&] {
    a.schedule("c", product(falling(1, 3), falling(8, 7)), 30);
    a.schedule("b", falling(2, 6), 20);
    a.schedule("d", product(falling(1, 3), falling(9, 7)), 40);
    a.schedule("a", falling(1, 3), 10);
  };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a a", "a b", "a c", "a d", "a finish", "a end"));
}

TEST_F(SimulatorTest, SettlesOnceAfterAllEventsOfOneTime) {
  const auto unsettle = [&] { a.needs_after_batch = true; };
  a.on_start = [&] {
    a.schedule("first", falling(1, 3), 1, unsettle);
    a.schedule("second", product(falling(1, 3), falling(8, 7)), 2);
    a.schedule("third", product(falling(1, 3), falling(9, 7)), 3, unsettle);
    a.schedule("later", falling(1, 2), 4);
  };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a first", "a second", "a third", "a settle", "a later",
                               "a finish", "a end"));
  EXPECT_FALSE(a.needs_after_batch);
}

TEST_F(SimulatorTest, SettlesAfterTheStartAndAfterTheLastEvent) {
  a.on_start = [&] {
    a.needs_after_batch = true;
    a.schedule("1/2", falling(1, 2), 1, [&] { a.needs_after_batch = true; });
  };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a settle", "a 1/2", "a settle", "a finish", "a end"));
}

// The exact time of the present event stays available while structures settle.

TEST_F(SimulatorTest, TheTimeDoesNotMoveBeforeAllIsSettled) {
  a.on_start = [&] { a.schedule("1/3", falling(1, 3), 1, [&] { a.needs_after_batch = true; }); };
  a.on_batch_end = [&] {
    EXPECT_LT(simulator.now().lower(), 1.0 / 3);
    const Dyadic soon = next_on_grid(simulator.now().exact(), 8);
    EXPECT_EQ(soon.rational(), fraction(86, 256));
    EXPECT_EQ(a.retired, 0);
  };
  run();
  EXPECT_EQ(a.retired, 1);
}

TEST_F(SimulatorTest, OnlyTheUnsettledAreSettled) {
  Script b{simulator, log, "b"};
  a.on_start = [&] { a.schedule("1/2", falling(1, 2), 1, [&] { b.needs_after_batch = true; }); };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "b build", "a start", "b start", "a 1/2", "b settle", "a finish",
                               "b finish", "a end", "b end"));
}

TEST_F(SimulatorTest, WhatIsScheduledForNowComesBeforeLaterEventsAndSettling) {
  a.on_start = [&] {
    a.schedule("first", falling(1, 3), 5, [&] {
      a.needs_after_batch = true;
      a.schedule("at once", product(falling(1, 3), falling(8, 7)), 3,
                 [&] { a.schedule("and again", product(falling(1, 3), falling(9, 7)), 1); });
    });
    a.schedule("later", falling(1, 2), 4);
  };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a first", "a at once", "a and again", "a settle",
                               "a later", "a finish", "a end"));
}

TEST_F(SimulatorTest, SettlingMayCancelAndSchedule) {
  QueueHandle doomed = 0;
  a.on_start = [&] {
    a.schedule("1/3", falling(1, 3), 1, [&] { a.needs_after_batch = true; });
    doomed = a.schedule("2/5", falling(2, 5), 2);
    a.schedule("2/3", falling(2, 3), 3);
  };
  a.on_batch_end = [&] {
    simulator.cancel(doomed);
    a.schedule("1/2", falling(1, 2), 4);
  };
  run();
  EXPECT_THAT(log,
              ElementsAre("a build", "a start", "a 1/3", "a settle", "a 1/2", "a 2/3", "a finish", "a end"));
}

TEST_F(SimulatorTest, OneClockForAllStructures) {
  Script b{simulator, log, "b"};
  a.on_start = [&] {
    a.schedule("1/4", falling(1, 4), 1);
    a.schedule("3/4", falling(3, 4), 1);
  };
  b.on_start = [&] {
    b.schedule("1/3", falling(1, 3), 1);
    b.schedule("4/5", falling(4, 5), 1);
  };
  run(false);
  EXPECT_THAT(log, ElementsAre("a build", "b build", "a start", "b start", "a 1/4", "b 1/3", "a 3/4", "b 4/5",
                               "a finish", "b finish"));
}

TEST_F(SimulatorTest, StandsStillWithinAStep) {
  a.on_start = [&] {
    a.schedule("1/4", falling(1, 4), 1, [&] { a.needs_after_batch = true; });
    a.schedule("1/3", falling(1, 3), 2);
    a.schedule("3/4", falling(3, 4), 3);
  };
  simulator.build();
  simulator.enter_step();
  EXPECT_THAT(log, ElementsAre("a build", "a start"));
  simulator.run_until(Dyadic(0.0));
  EXPECT_THAT(log, ElementsAre("a build", "a start"));
  log.clear();
  simulator.run_until(Dyadic(0.25));  // events at exactly this time are handled and settled
  EXPECT_THAT(log, ElementsAre("a 1/4", "a settle"));
  EXPECT_EQ(simulator.now().exact().lower(), Dyadic(0.25));
  EXPECT_TRUE(simulator.now().exact().is_dyadic());
  const std::uint64_t moment = simulator.moment();
  const Dyadic before_a_third(Integer((1U << 30U) / 3), 30);
  simulator.run_until(before_a_third);
  simulator.run_until(before_a_third);
  EXPECT_GT(simulator.moment(), moment);
  EXPECT_THROW(simulator.run_until(Dyadic(0.25)), std::invalid_argument);
  EXPECT_THROW(simulator.run_until(Dyadic(1.0)), std::invalid_argument);
  a.schedule("1/2", falling(1, 2), 4);  // scheduled by the caller, not by a structure
  log.clear();
  simulator.run_until(Dyadic(0.625));
  EXPECT_THAT(log, ElementsAre("a 1/3", "a 1/2"));
  simulator.leave_step();
  simulator.finish();
  EXPECT_THAT(log, ElementsAre("a 1/3", "a 1/2", "a 3/4", "a finish", "a end"));
  EXPECT_EQ(a.retired, 4);
  EXPECT_EQ(simulator.step(), 1U);
}

TEST_F(SimulatorTest, StepsFollowEachOther) {
  a.on_start = [&] {
    EXPECT_EQ(simulator.now().upper(), 0);
    const std::string step = std::to_string(simulator.step());
    a.schedule(step, falling(1, 2 + static_cast<long long>(simulator.step())), 1);
  };
  run(false);
  EXPECT_EQ(simulator.step(), 1U);
  run(true);
  EXPECT_EQ(simulator.step(), 2U);
  EXPECT_THAT(log,
              ElementsAre("a build", "a start", "a 0", "a finish", "a start", "a 1", "a finish", "a end"));
  EXPECT_EQ(a.cleared, 2);
}

TEST_F(SimulatorTest, CountsEventsByKindAndStep) {
  a.on_start = [&] {
    a.schedule("1/3", falling(1, 3), 1, [&] {
      a.change(0, 1);
      a.change(1, 2);
    });
    a.schedule("1/2", falling(1, 2), 2, [&] {
      if (simulator.step() == 1) a.change(2, 3);
      a.change(0, 4);
    });
  };
  run(false);
  run(true);
  EXPECT_THAT(a.statistics.events_by_kind, ElementsAre(4, 2, 1));
  EXPECT_THAT(a.statistics.events_per_step, ElementsAre(2, 2));  // external events only
  EXPECT_EQ(a.statistics.audits_run, 0U);
  EXPECT_THAT(a.audits, IsEmpty());
}

TEST_F(SimulatorTest, ListenersHearEveryChange) {
  Listener listener, other;
  simulator.listen(listener);
  simulator.listen(other);
  Script b{simulator, log, "b"};
  a.on_start = [&] { a.schedule("1/3", falling(1, 3), 7); };
  b.on_start = [&] {
    b.schedule("1/2", falling(1, 2), 8, [&] {
      b.change(1, 9);
      b.change(0, 10);
    });
  };
  run(false);
  run(true);
  ASSERT_EQ(listener.heard.size(), 6U);
  ASSERT_EQ(other.heard.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& [structure, event] = listener.heard[i];
    EXPECT_EQ(event.step, i / 3);
    const std::array<std::string, 3> names{"a", "b", "b"};
    EXPECT_EQ(structure, names[i % 3]);
    EXPECT_EQ(event.structure_index, i % 3 == 0 ? 0U : 1U);
    const std::array<Change, 3> changes{{{0, 1, {7}}, {1, 1, {9}}, {0, 1, {10}}}};
    EXPECT_EQ(event.change, changes[i % 3]);
    const double time = i % 3 == 0 ? 1.0 / 3 : 0.5;
    EXPECT_LE(event.lower, time);
    EXPECT_GE(event.upper, time);
    EXPECT_EQ(event.upper - event.lower, i % 3 == 0 ? 0x1p-24 : 0);
  }
}

// A call at the wrong time is refused with one message that says what to do.
template <class Exception, class Use>
std::string refusal_of(Use use) {
  try {
    use();
  } catch (const Exception& refusal) {
    return refusal.what();
  }
  return "no exception";
}

TEST_F(SimulatorTest, NoStepWithoutBuilding) {
  const auto expect_build_first = [](const std::string& message) {
    EXPECT_THAT(message, testing::HasSubstr("call build() first"));
    EXPECT_EQ(message.find('\n'), std::string::npos);
  };
  expect_build_first(refusal_of<std::logic_error>([&] { simulator.run_step(); }));
  expect_build_first(refusal_of<std::logic_error>([&] { simulator.enter_step(); }));
  expect_build_first(refusal_of<std::logic_error>([&] { static_cast<void>(simulator.try_step(1)); }));
  expect_build_first(refusal_of<std::logic_error>([&] { simulator.leave_step(); }));
  expect_build_first(refusal_of<std::logic_error>([&] { KnownEvents(simulator).replay_step({}); }));
  expect_build_first(refusal_of<std::logic_error>([&] { simulator.finish(); }));
  EXPECT_THAT(log, IsEmpty());
  run();  // the refused calls had no effect
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a finish", "a end"));
}

TEST_F(SimulatorTest, NoStructureIsAddedAfterBuilding) {
  simulator.build();
  EXPECT_THAT(refusal_of<std::logic_error>([&] { Script late(simulator, log, "late"); }),
              testing::AllOf(testing::HasSubstr("late"), testing::HasSubstr("before build()")));
  simulator.run_step();
  EXPECT_THAT(refusal_of<std::logic_error>([&] { Script late(simulator, log, "later"); }),
              testing::HasSubstr("later"));
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a finish"));
}

TEST_F(SimulatorTest, NoTimeOutsideAStep) {
  EXPECT_THAT(refusal_of<std::logic_error>([&] { simulator.run_until(Dyadic(0.5)); }),
              testing::HasSubstr("call build() first"));
  simulator.build();
  EXPECT_THAT(refusal_of<std::logic_error>([&] { simulator.run_until(Dyadic(0.5)); }),
              testing::HasSubstr("call enter_step() first"));
  simulator.enter_step();
  simulator.run_until(Dyadic(0.5));
  EXPECT_THAT(refusal_of<std::logic_error>([&] { simulator.enter_step(); }),
              testing::HasSubstr("call leave_step() first"));
  EXPECT_THAT(refusal_of<std::logic_error>([&] { simulator.build(); }),
              testing::HasSubstr("call leave_step() first"));
  EXPECT_THAT(refusal_of<std::logic_error>([&] { simulator.finish(); }),
              testing::HasSubstr("call leave_step() first"));
  EXPECT_THAT(refusal_of<std::invalid_argument>([&] { simulator.run_until(Dyadic(0.25)); }),
              testing::HasSubstr("expected a time from 0.5 on, before 1"));
  EXPECT_THAT(refusal_of<std::invalid_argument>([&] { simulator.run_until(Dyadic(1.0)); }),
              testing::HasSubstr("u = 1"));
  simulator.leave_step();
  EXPECT_THAT(refusal_of<std::logic_error>([&] { simulator.leave_step(); }),
              testing::HasSubstr("call enter_step() first"));
  simulator.finish();
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a finish", "a end"));
}

/// Returns when the clock has moved.
void tick() {
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() == start) {
  }
}

// How long something takes is not tested. No moment is charged twice, because Stopwatch charges one lane at a
// time.
TEST_F(SimulatorTest, TimeIsChargedToTheStructureThatBuildsOrHandlesEvents) {
  Script b{simulator, log, "b"};
  a.on_build = tick;
  b.on_start = [&] { b.schedule("1/2", falling(1, 2), 1, tick); };
  run();
  EXPECT_GT(a.statistics.build_seconds, 0);
  EXPECT_GT(simulator.seconds_of(1), 0);
  EXPECT_EQ(simulator.seconds_of_listeners(), 0);
}

TEST_F(SimulatorTest, ListenersHaveTheirOwnSeconds) {
  struct Ticking final : EventListener {
    void on_event(const Event&) override { tick(); }
  } ticking;
  simulator.listen(ticking);
  a.on_start = [&] { a.change(1, 9); };
  run();
  EXPECT_GT(simulator.seconds_of_listeners(), 0);
}

}  // namespace
}  // namespace kds::simulator_test
