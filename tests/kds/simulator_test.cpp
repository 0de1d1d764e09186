#include "kds/simulator.h"

#include <gmock/gmock.h>

#include <array>
#include <functional>
#include <map>
#include <stdexcept>

#include "tests/support/polynomial_source.h"

namespace kds {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Log = std::vector<std::string>;

// A structure without any geometry: it plays a script, and writes down what it is asked.
class Script final : public KineticStructure, public FailureSource {
 public:
  Script(Simulator& simulator, Log& log, std::string name)
      : simulator_(simulator), log_(log), name_(std::move(name)), index_(simulator.add(*this)) {
    simulator.add_table(*this);
  }

  /// From now on: `note` fails where `function` does first, with what it then does.
  QueueHandle schedule(const std::string& note, Coefficients function, BeadId bead,
                       std::function<void()> action = {}) {
    const auto slot = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({note, std::move(function), bead, std::move(action), false});
    StageCounts stages;
    // The first root at or after now: the script knows what it does.
    const Failure failure = exact_first_failure(exact_function(slot), Instant(0), stages);
    return entries_[slot].handle = simulator_.schedule(failure.time, *this, slot);
  }
  void change(std::uint8_t kind, BeadId bead) { simulator_.record(index_, {kind, 1, {bead}}); }
  void note(const std::string& text) { log_.push_back(name_ + " " + text); }

  std::function<void()> on_build, on_start, on_settle;
  std::function<std::optional<std::string>(const Dyadic&)> on_audit;
  std::vector<Rational> audits;

  // KineticStructure
  [[nodiscard]] std::string_view name() const override { return name_; }
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 3> kinds{{{"turn"}, {"tick", false}, {"rebuild", false, true}}};
    return kinds;
  }
  void build() override {
    note("build");
    if (on_build) on_build();
  }
  void start_step() override {
    note("start");
    if (on_start) on_start();
  }
  void fail(unsigned, std::uint32_t) override { FAIL() << "the source was not asked"; }
  void settle() override {
    note("settle");
    if (on_settle) on_settle();
  }
  void finish_step(bool last) override { note(last ? "finish last" : "finish"); }
  void apply(const Change& c) override {
    note("apply " + std::to_string(c.ids[0]));
    if (c.ids[0] == 13) throw std::invalid_argument("unlucky");
  }
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override {
    audits.push_back(time.rational());
    return on_audit ? on_audit(time) : std::nullopt;
  }

  // FailureSource
  [[nodiscard]] ExactPolynomial exact_function(std::uint32_t slot) const override {
    EXPECT_FALSE(entries_.at(slot).retired) << entries_.at(slot).note << " is asked for after it was retired";
    return ExactPolynomial(entries_.at(slot).function);
  }
  [[nodiscard]] Identity identity(std::uint32_t slot) const override { return named(entries_.at(slot).bead); }
  [[nodiscard]] std::uint64_t place(std::uint32_t slot) const override { return slot; }
  [[nodiscard]] std::size_t structure() const override { return index_; }
  void fail(std::uint32_t slot) override {
    const Entry entry = entries_.at(slot);  // the action may schedule more
    note(entry.note);
    EXPECT_FALSE(entry.retired);
    if (entry.action) {
      entry.action();
    } else {
      change(0, entry.bead);
    }
  }
  void retire(std::uint32_t slot) override {
    EXPECT_FALSE(entries_.at(slot).retired);
    entries_.at(slot).retired = true;
    ++retired;
  }
  void clear() override {
    entries_.clear();
    ++cleared;
  }
  int retired = 0;
  int cleared = 0;

 private:
  struct Entry {
    std::string note;
    Coefficients function;
    BeadId bead;
    std::function<void()> action;
    bool retired;
    QueueHandle handle = 0;
  };

  Simulator& simulator_;
  Log& log_;
  std::string name_;
  std::size_t index_;
  std::vector<Entry> entries_;
};

struct Listener final : EventListener {
  struct Heard {
    std::string structure;
    LoggedEvent event;
  };
  std::vector<Heard> heard;
  void on_event(const KineticStructure& structure, const LoggedEvent& event) override {
    heard.push_back({std::string(structure.name()), event});
  }
};

class SimulatorTest : public testing::Test {
 protected:
  void run(bool last = true) {
    if (simulator.step() == 0) simulator.build();
    simulator.run_step(last);
  }

  Simulator simulator;
  Log log;
  Script a{simulator, log, "a"};
};

class AuditedTest : public testing::Test {
 protected:
  Simulator simulator{AuditMode::events};
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
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a 1/3", "a 2/5", "a 1/2", "a 3/4", "a finish last"));
  EXPECT_EQ(a.retired, 4);
  EXPECT_EQ(a.cleared, 1);
}

TEST_F(SimulatorTest, NowIsTheBracketOfTheEvent) {
  a.on_start = [&] {
    EXPECT_EQ(simulator.now().lower(), 0);
    EXPECT_EQ(simulator.now().upper(), 0);
    a.schedule("1/3", falling(1, 3), 1, [&] {
      EXPECT_LT(simulator.now().lower(), 1.0 / 3);
      EXPECT_GT(simulator.now().upper(), std::nextafter(1.0 / 3, 0));
      EXPECT_LT(simulator.now().upper() - simulator.now().lower(), 1e-9);
      ExactTime third(ExactPolynomial(Coefficients{1, -2}), {Dyadic(0.0), Dyadic(1.0)});
      EXPECT_EQ(ExactTime::compare(simulator.now().exact(), third), 0);
    });
  };
  run();
  EXPECT_EQ(simulator.now().lower(), 1);
}

TEST_F(SimulatorTest, EqualTimesComeInTheOrderOfIdentities) {
  a.on_start = [&] {
    a.schedule("c", times(falling(1, 3), falling(8, 7)), 30);
    a.schedule("b", falling(2, 6), 20);
    a.schedule("d", times(falling(1, 3), falling(9, 7)), 40);
    a.schedule("a", falling(1, 3), 10);
  };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a a", "a b", "a c", "a d", "a finish last"));
}

TEST_F(SimulatorTest, SettlesOnceAfterAllEventsOfOneTime) {
  const auto unsettle = [&] { a.unsettled = true; };
  a.on_start = [&] {
    a.schedule("first", falling(1, 3), 1, unsettle);
    a.schedule("second", times(falling(1, 3), falling(8, 7)), 2);
    a.schedule("third", times(falling(1, 3), falling(9, 7)), 3, unsettle);
    a.schedule("later", falling(1, 2), 4);
  };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a first", "a second", "a third", "a settle", "a later",
                               "a finish last"));
  EXPECT_FALSE(a.unsettled);
}

TEST_F(SimulatorTest, SettlesAfterTheStartAndAfterTheLastEvent) {
  a.on_start = [&] {
    a.unsettled = true;
    a.schedule("1/2", falling(1, 2), 1, [&] { a.unsettled = true; });
  };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a settle", "a 1/2", "a settle", "a finish last"));
}

// The exact time of the present event is there for as long as structures settle.
TEST_F(SimulatorTest, TheTimeDoesNotMoveBeforeAllIsSettled) {
  a.on_start = [&] { a.schedule("1/3", falling(1, 3), 1, [&] { a.unsettled = true; }); };
  a.on_settle = [&] {
    EXPECT_LT(simulator.now().lower(), 1.0 / 3);
    const Dyadic soon = next_on_grid(simulator.now().exact(), 8);
    EXPECT_EQ(soon.rational(), Rational(86, 256));
    EXPECT_EQ(a.retired, 0);
  };
  run();
  EXPECT_EQ(a.retired, 1);
}

TEST_F(SimulatorTest, OnlyTheUnsettledAreSettled) {
  Script b{simulator, log, "b"};
  a.on_start = [&] { a.schedule("1/2", falling(1, 2), 1, [&] { b.unsettled = true; }); };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "b build", "a start", "b start", "a 1/2", "b settle",
                               "a finish last", "b finish last"));
}

TEST_F(SimulatorTest, WhatIsScheduledForNowComesBeforeLaterEventsAndSettling) {
  a.on_start = [&] {
    a.schedule("first", falling(1, 3), 5, [&] {
      a.unsettled = true;
      a.schedule("at once", times(falling(1, 3), falling(8, 7)), 3,
                 [&] { a.schedule("and again", times(falling(1, 3), falling(9, 7)), 1); });
    });
    a.schedule("later", falling(1, 2), 4);
  };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a first", "a at once", "a and again", "a settle",
                               "a later", "a finish last"));
}

TEST_F(SimulatorTest, SettlingMayCancelAndSchedule) {
  QueueHandle doomed = 0;
  a.on_start = [&] {
    a.schedule("1/3", falling(1, 3), 1, [&] { a.unsettled = true; });
    doomed = a.schedule("2/5", falling(2, 5), 2);
    a.schedule("2/3", falling(2, 3), 3);
  };
  a.on_settle = [&] {
    simulator.cancel(doomed);
    a.schedule("1/2", falling(1, 2), 4);
  };
  run();
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a 1/3", "a settle", "a 1/2", "a 2/3", "a finish last"));
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
    a.schedule("1/4", falling(1, 4), 1, [&] { a.unsettled = true; });
    a.schedule("1/3", falling(1, 3), 2);
    a.schedule("3/4", falling(3, 4), 3);
  };
  simulator.build();
  simulator.enter_step();
  EXPECT_THAT(log, ElementsAre("a build", "a start"));
  simulator.run_until(Dyadic(0.0));
  EXPECT_THAT(log, ElementsAre("a build", "a start"));
  log.clear();
  simulator.run_until(Dyadic(0.25));  // what happens right then has happened, and is settled
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
  a.schedule("1/2", falling(1, 2), 4);  // from outside
  log.clear();
  simulator.run_until(Dyadic(0.625));
  EXPECT_THAT(log, ElementsAre("a 1/3", "a 1/2"));
  simulator.leave_step(true);
  EXPECT_THAT(log, ElementsAre("a 1/3", "a 1/2", "a 3/4", "a finish last"));
  EXPECT_EQ(a.retired, 4);
  EXPECT_EQ(simulator.step(), 1U);
}

// What is unsettled while time stands still is settled, and looked at, before it goes on.
TEST_F(AuditedTest, LooksAtWhatWasDoneWhileTimeStoodStill) {
  a.on_start = [&] { a.schedule("1/2", falling(1, 2), 1); };
  simulator.build();
  simulator.enter_step();
  simulator.run_until(Dyadic(0.25));
  log.clear();
  a.audits.clear();
  a.unsettled = true;
  simulator.leave_step(true);
  EXPECT_THAT(log, ElementsAre("a settle", "a 1/2", "a finish last"));
  ASSERT_EQ(a.audits.size(), 3U);  // before the event, after it, at the end
  EXPECT_GT(a.audits[0], Rational(1, 4));
  EXPECT_LT(a.audits[0], Rational(1, 2));
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
  EXPECT_THAT(log, ElementsAre("a build", "a start", "a 0", "a finish", "a start", "a 1", "a finish last"));
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
  EXPECT_THAT(a.statistics.events_per_step, ElementsAre(2, 2));  // external ones
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
    EXPECT_EQ(event.structure, i % 3 == 0 ? 0U : 1U);
    const std::array<Change, 3> changes{{{0, 1, {7}}, {1, 1, {9}}, {0, 1, {10}}}};
    EXPECT_EQ(event.change, changes[i % 3]);
    const double time = i % 3 == 0 ? 1.0 / 3 : 0.5;
    EXPECT_LE(event.lower, time);
    EXPECT_GE(event.upper, time);
    EXPECT_LT(event.upper - event.lower, 1e-9);
  }
}

TEST_F(AuditedTest, AuditsStrictlyBetweenAllEvents) {
  a.on_start = [&] {
    a.schedule("1/3", falling(1, 3), 1);
    a.schedule("1/3 too", times(falling(1, 3), falling(8, 7)), 2);
    a.schedule("1/2", falling(1, 2), 3);
    a.schedule("soon after", {Integer((1LL << 40) + 1), Integer((1LL << 40) + 1 - (1LL << 41))}, 4);
  };
  simulator.build();
  simulator.run_step(true);
  const Rational soon = Rational(1, 2) + Rational(1, 1LL << 41);
  ASSERT_EQ(a.audits.size(), 6U);  // the start, between 0, 1/3, 1/2, soon after and 1, the end
  const std::array<Rational, 5> ends{0, Rational(1, 3), Rational(1, 2), soon, 1};
  EXPECT_EQ(a.audits.front(), 0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(ends[i], a.audits[i + 1]);
    EXPECT_LT(a.audits[i + 1], ends[i + 1]);
  }
  EXPECT_EQ(a.audits.back(), 1);
  EXPECT_EQ(a.statistics.audits_run, 6U);
  EXPECT_EQ(a.statistics.audits_failed, 0U);
}

TEST_F(AuditedTest, AuditsComeAfterSettlingAndBeforeWhatItSchedules) {
  a.on_start = [&] {
    a.schedule("1/3", falling(1, 3), 1, [&] { a.unsettled = true; });
    a.schedule("3/4", falling(3, 4), 2);
  };
  a.on_settle = [&] { a.schedule("soon", falling(1001, 3000), 3); };
  a.on_audit = [&](const Dyadic&) {
    a.note("audit");
    EXPECT_FALSE(a.unsettled);
    return std::nullopt;
  };
  simulator.build();
  simulator.run_step(true);
  EXPECT_THAT(log, ElementsAre("a build", "a audit", "a start", "a audit", "a 1/3", "a settle", "a audit",
                               "a soon", "a audit", "a 3/4", "a audit", "a finish last", "a audit"));
  EXPECT_GT(a.audits[2], Rational(1, 3));
  EXPECT_LT(a.audits[2], Rational(1001, 3000));
}

TEST_F(AuditedTest, AuditsComeBeforeWhatSettlingSchedulesIntoAnEmptyQueue) {
  a.on_start = [&] { a.schedule("1/3", falling(1, 3), 1, [&] { a.unsettled = true; }); };
  a.on_settle = [&] {
    for (BeadId b = 0; b < 100; ++b) a.schedule("soon", falling(1001 + b, 3000), b);
  };
  simulator.build();
  simulator.run_step(true);
  ASSERT_EQ(a.audits.size(), 104U);
  EXPECT_GT(a.audits[2], Rational(1, 3));
  EXPECT_LT(a.audits[2], Rational(1001, 3000));
  EXPECT_GT(a.audits[3], Rational(1001, 3000));
}

TEST_F(AuditedTest, AStepWithoutEventsIsAuditedInside) {
  simulator.build();
  simulator.run_step(false);
  simulator.run_step(true);
  ASSERT_EQ(a.audits.size(), 5U);
  EXPECT_EQ(a.audits[0], 0);
  EXPECT_GT(a.audits[1], 0);
  EXPECT_LT(a.audits[1], 1);
  EXPECT_EQ(a.audits[2], 1);  // which is the next step's start
  EXPECT_GT(a.audits[3], 0);
  EXPECT_LT(a.audits[3], 1);
  EXPECT_EQ(a.audits[4], 1);
}

TEST_F(AuditedTest, EventsAtTheStartLeaveNoTimeBefore) {
  a.on_start = [&] { a.schedule("tiny", {1, Integer(1) - (Integer(1) << 100)}, 1); };
  simulator.build();
  simulator.run_step(true);
  ASSERT_EQ(a.audits.size(), 4U);
  EXPECT_GT(a.audits[1], 0);
  EXPECT_LT(a.audits[1], Rational(1, Integer(1) << 100));
}

TEST(SimulatorAudits, AtFramesOnly) {
  Simulator simulator(AuditMode::frames);
  Log log;
  Script a{simulator, log, "a"};
  a.on_start = [&] { a.schedule("1/3", falling(1, 3), 1); };
  simulator.build();
  simulator.run_step(false);
  simulator.run_step(true);
  EXPECT_THAT(a.audits, ElementsAre(0, 1, 1));
}

TEST_F(AuditedTest, AFailedAuditThrowsWithStepAndTime) {
  a.on_start = [&] {
    if (simulator.step() == 1) a.schedule("1/2", falling(1, 2), 1);
  };
  a.on_audit = [&](const Dyadic& time) -> std::optional<std::string> {
    if (simulator.step() == 1 && Dyadic(0.5) < time) return "a screw is loose";
    return std::nullopt;
  };
  simulator.build();
  simulator.run_step(false);
  std::string message;
  try {
    simulator.run_step(true);
    FAIL() << "no exception";
  } catch (const AuditError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, HasSubstr("audit of a failed"));
  EXPECT_THAT(message, HasSubstr("step 1"));
  EXPECT_THAT(message, HasSubstr("u = " + a.audits.back().str()));
  EXPECT_THAT(message, HasSubstr("a screw is loose"));
  EXPECT_EQ(a.statistics.audits_failed, 1U);
  EXPECT_EQ(a.statistics.audits_run, a.audits.size());
}

// Replay and fingerprint.

std::uint64_t fingerprint_of(const std::vector<std::pair<double, BeadId>>& events) {
  Simulator simulator;
  Log log;
  Script a{simulator, log, "a"};
  a.on_start = [&] {
    for (const auto& [time, bead] : events)
      a.schedule("", falling(static_cast<long long>(time * 1024), 1024), bead);
  };
  simulator.build();
  simulator.run_step(true);
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
    simulator.run_step(false);
    simulator.run_step(true);
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
  run.run_step(false);
  run.run_step(true);

  Simulator replay;
  Log replay_log;
  Script replayed_a{replay, replay_log, "a"};
  Script replayed_b{replay, replay_log, "b"};
  replayed_a.on_build = [&] { replayed_a.change(2, 99); };  // what building records is in the log as well
  Listener replay_listener;
  replay.listen(replay_listener);
  replay.build_for_replay();
  for (std::size_t step = 0; step < 2; ++step) {
    std::vector<Simulator::Replayed> events;
    for (const auto& heard : listener.heard) {
      if (heard.event.step == step)
        events.push_back(
            {heard.event.structure, heard.event.lower, heard.event.upper, heard.event.change, ""});
    }
    replay.replay_step(events, step == 1);
  }
  EXPECT_EQ(replay.fingerprint(), run.fingerprint());
  EXPECT_EQ(replayed_a.statistics.events_by_kind, a.statistics.events_by_kind);
  EXPECT_EQ(replayed_b.statistics.events_by_kind, b.statistics.events_by_kind);
  EXPECT_EQ(replayed_a.statistics.events_per_step, a.statistics.events_per_step);
  EXPECT_THAT(replay_log, ElementsAre("a build", "b build", "b apply 4", "a apply 30", "a apply 31",
                                      "a finish", "b finish", "b apply 4", "a apply 31", "a apply 31",
                                      "a finish last", "b finish last"));
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
  simulator.build_for_replay();
  const std::vector<Simulator::Replayed> events{{0, 0.25, 0.25, {0, 1, {1}}, "log:7"},
                                                {0, 0.5, 0.5, {0, 1, {13}}, "log:8"}};
  std::string message;
  try {
    simulator.replay_step(events, true);
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "log:8: unlucky");
}

TEST_F(SimulatorTest, TimeIsChargedToStructures) {
  Script b{simulator, log, "b"};
  const auto linger = [] {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(3);
    while (std::chrono::steady_clock::now() < until) {
    }
  };
  a.on_build = linger;
  b.on_start = [&] {
    linger();
    b.schedule("1/2", falling(1, 2), 1, linger);
  };
  run();
  EXPECT_GE(a.statistics.build_seconds, 0.003);
  EXPECT_LT(b.statistics.build_seconds, 0.003);
  EXPECT_LT(simulator.seconds_of(0), 0.003);
  EXPECT_GE(simulator.seconds_of(1), 0.006);
  EXPECT_LT(simulator.seconds(), 0.003);
}

}  // namespace
}  // namespace kds
