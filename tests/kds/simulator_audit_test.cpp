#include "kds/simulator.h"

#include <gmock/gmock.h>

#include "tests/support/inputs/script.h"

namespace kds::simulator_audit_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

class AuditedTest : public testing::Test {
 protected:
  Simulator simulator{AuditMode::events};
  Log log;
  Script a{simulator, log, "a"};
};

TEST_F(AuditedTest, LooksAtWhatWasDoneWhileTimeStoodStill) {
  a.on_start = [&] { a.schedule("1/2", falling(1, 2), 1); };
  simulator.build();
  simulator.enter_step();
  simulator.run_until(Dyadic(0.25));
  log.clear();
  a.audits.clear();
  a.needs_after_batch = true;
  simulator.leave_step();
  simulator.finish();
  EXPECT_THAT(log, ElementsAre("a settle", "a 1/2", "a finish", "a end"));
  ASSERT_EQ(a.audits.size(), 3U);  // before the event, after the event, at the end
  EXPECT_GT(a.audits[0], fraction(1, 4));
  EXPECT_LT(a.audits[0], fraction(1, 2));
}

class AuditedNowTest : public testing::Test {
 protected:
  Simulator simulator;  // audits are off by default
  Log log;
  Script a{simulator, log, "a"};
};

TEST_F(AuditedNowTest, BetweenNowAndTheNextFailureOrAtFrames) {
  a.on_start = [&] { a.schedule("1/2", falling(1, 2), 1); };
  EXPECT_THROW(simulator.audit_now(), std::logic_error);
  simulator.build();
  simulator.audit_now();
  simulator.enter_step();
  a.needs_after_batch = true;
  simulator.audit_now();
  EXPECT_FALSE(a.needs_after_batch);
  EXPECT_TRUE(simulator.run_next());
  simulator.audit_now();
  simulator.leave_step();
  simulator.audit_now();
  ASSERT_EQ(a.audits.size(), 4U);
  EXPECT_EQ(a.audits[0], 0);
  EXPECT_GT(a.audits[1], 0);
  EXPECT_LT(a.audits[1], fraction(1, 2));
  EXPECT_GT(a.audits[2], fraction(1, 2));
  EXPECT_LT(a.audits[2], 1);
  EXPECT_EQ(a.audits[3], 1);
  EXPECT_EQ(a.statistics.audits_run, 4U);
}

TEST_F(AuditedNowTest, ThrowsWhereAStructureIsWrongOrIsBusy) {
  a.on_start = [&] {
    a.schedule("1/2", falling(1, 2), 1, [&] { EXPECT_THROW(simulator.audit_now(), std::logic_error); });
  };
  simulator.build();
  simulator.run_step();
  a.on_audit = [](const Dyadic&) { return "it is wrong"; };
  EXPECT_THROW(simulator.audit_now(), AuditError);
  EXPECT_EQ(a.statistics.audits_failed, 1U);
}

TEST_F(AuditedTest, AuditsStrictlyBetweenAllEvents) {
  a.on_start = [&] {
    a.schedule("1/3", falling(1, 3), 1);
    a.schedule("1/3 too", product(falling(1, 3), falling(8, 7)), 2);
    a.schedule("1/2", falling(1, 2), 3);
    a.schedule("soon after", {(Integer(1) << 40) + 1, (Integer(1) << 40) + 1 - (Integer(1) << 41)}, 4);
  };
  simulator.build();
  simulator.run_step();
  simulator.finish();
  const Rational soon = fraction(1, 2) + fraction(1, Integer(1) << 41);
  ASSERT_EQ(a.audits.size(), 6U);  // at the start, between 0, 1/3, 1/2, just after 1/2 and 1, and at the end
  const std::array<Rational, 5> ends{0, fraction(1, 3), fraction(1, 2), soon, 1};
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
    a.schedule("1/3", falling(1, 3), 1, [&] { a.needs_after_batch = true; });
    a.schedule("3/4", falling(3, 4), 2);
  };
  a.on_batch_end = [&] { a.schedule("soon", falling(1001, 3000), 3); };
  a.on_audit = [&](const Dyadic&) {
    a.note("audit");
    EXPECT_FALSE(a.needs_after_batch);
    return std::nullopt;
  };
  simulator.build();
  simulator.run_step();
  simulator.finish();
  EXPECT_THAT(log, ElementsAre("a build", "a audit", "a start", "a audit", "a 1/3", "a settle", "a audit",
                               "a soon", "a audit", "a 3/4", "a audit", "a finish", "a audit", "a end"));
  EXPECT_GT(a.audits[2], fraction(1, 3));
  EXPECT_LT(a.audits[2], fraction(1001, 3000));
}

TEST_F(AuditedTest, AuditsComeBeforeWhatSettlingSchedulesIntoAnEmptyQueue) {
  a.on_start = [&] { a.schedule("1/3", falling(1, 3), 1, [&] { a.needs_after_batch = true; }); };
  a.on_batch_end = [&] {
    for (BeadId b = 0; b < 100; ++b) a.schedule("soon", falling(1001 + b, 3000), b);
  };
  simulator.build();
  simulator.run_step();
  simulator.finish();
  ASSERT_EQ(a.audits.size(), 104U);
  EXPECT_GT(a.audits[2], fraction(1, 3));
  EXPECT_LT(a.audits[2], fraction(1001, 3000));
  EXPECT_GT(a.audits[3], fraction(1001, 3000));
}

TEST_F(AuditedTest, AStepWithoutEventsIsAuditedInside) {
  simulator.build();
  simulator.run_step();
  simulator.run_step();
  simulator.finish();
  ASSERT_EQ(a.audits.size(), 5U);
  EXPECT_EQ(a.audits[0], 0);
  EXPECT_GT(a.audits[1], 0);
  EXPECT_LT(a.audits[1], 1);
  EXPECT_EQ(a.audits[2], 1);  // u = 1 is also the start of the next step
  EXPECT_GT(a.audits[3], 0);
  EXPECT_LT(a.audits[3], 1);
  EXPECT_EQ(a.audits[4], 1);
}

TEST_F(AuditedTest, EventsAtTheStartLeaveNoTimeBefore) {
  a.on_start = [&] { a.schedule("tiny", {1, Integer(1) - (Integer(1) << 100)}, 1); };
  simulator.build();
  simulator.run_step();
  simulator.finish();
  ASSERT_EQ(a.audits.size(), 4U);
  EXPECT_GT(a.audits[1], 0);
  EXPECT_LT(a.audits[1], fraction(1, Integer(1) << 100));
}

TEST(SimulatorAudits, AtFramesOnly) {
  Simulator simulator(AuditMode::frames);
  Log log;
  Script a{simulator, log, "a"};
  a.on_start = [&] { a.schedule("1/3", falling(1, 3), 1); };
  simulator.build();
  simulator.run_step();
  simulator.run_step();
  simulator.finish();
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
  simulator.run_step();
  std::string message;
  try {
    simulator.run_step();
    FAIL() << "no exception";
  } catch (const AuditError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, HasSubstr("audit of a failed"));
  EXPECT_THAT(message, HasSubstr("step 1"));
  EXPECT_THAT(message, HasSubstr("u = " + a.audits.back().get_str()));
  EXPECT_THAT(message, HasSubstr("a screw is loose"));
  EXPECT_EQ(a.statistics.audits_failed, 1U);
  EXPECT_EQ(a.statistics.audits_run, a.audits.size());
}

}  // namespace
}  // namespace kds::simulator_audit_test
