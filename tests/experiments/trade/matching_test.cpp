// Compares two histories: missed events, invented events, and times.

#include <gtest/gtest.h>

#include "experiments/trade/match_events.h"

namespace kds::matching_test {
namespace {

TimedEvent event(double time, std::uint8_t kind, BeadId a, BeadId b) { return {time, {kind, 2, {a, b}}}; }

TEST(MatchEvents, OfOneHistoryWithItselfAllMatch) {
  const std::vector<TimedEvent> events{event(0.5, 0, 1, 2), event(0.75, 1, 1, 2), event(0.75, 0, 1, 2)};
  const EventMatch match = match_events(events, events, 0);
  EXPECT_EQ(match.expected, 3U);
  EXPECT_EQ(match.matched, 3U);
  EXPECT_EQ(match.missed + match.invented, 0U);
  EXPECT_EQ(match.time_error_max, 0.0);
}

TEST(MatchEvents, OnlyTheSameChangeNearInTimeMatches) {
  const std::vector<TimedEvent> expected{event(1, 0, 1, 2), event(3, 0, 1, 2), event(3, 0, 1, 3),
                                         event(9, 0, 4, 5)};
  const std::vector<TimedEvent> found{event(1.5, 0, 1, 2), event(2, 1, 1, 2), event(3, 0, 3, 1),
                                      event(9.5, 0, 4, 5), event(20, 0, 4, 5)};
  const EventMatch match = match_events(expected, found, 1);
  EXPECT_EQ(match.matched, 2U);   // the pairs (1, 1.5) and (9, 9.5)
  EXPECT_EQ(match.missed, 2U);    // the event at 3 of (1, 2), and (1, 3), whose ids are in another order
  EXPECT_EQ(match.invented, 3U);  // another kind, other ids, and the event at 20
  EXPECT_EQ(match.time_error_sum, 1.0);
  EXPECT_EQ(match.time_error_max, 0.5);
}

TEST(ContactTimes, GoFromBeginningToEnd) {
  constexpr std::uint8_t begin = 0, end = 1, touch = 2;
  const std::vector<BeadPair> built{{0, 5}};
  const std::vector<TimedEvent> events{event(1, begin, 2, 9), event(2, end, 0, 5), event(3, touch, 1, 4),
                                       event(4, end, 2, 9), event(6, begin, 2, 9)};
  const std::vector<ContactTime> times = contact_times(built, events, 0, 8);
  ASSERT_EQ(times.size(), 4U);
  const auto expect = [](const ContactTime& contact, BeadPair pair, double from, double to) {
    EXPECT_EQ(contact.pair, pair);
    EXPECT_EQ(contact.from, from);
    EXPECT_EQ(contact.to, to);
  };
  expect(times[0], {0, 5}, 0, 2);
  expect(times[1], {1, 4}, 3, 3);
  expect(times[2], {2, 9}, 1, 4);
  expect(times[3], {2, 9}, 6, 8);
}

TEST(MatchContacts, AreFoundWhereTheyShareTime) {
  const std::vector<ContactTime> expected{{{0, 5}, 0, 2}, {{1, 4}, 3, 3}, {{2, 9}, 1, 4}, {{2, 9}, 6, 8}};
  const std::vector<ContactTime> found{
      {{0, 5}, 1, 2.5}, {{0, 5}, 9, 10}, {{1, 4}, 3.5, 3.75}, {{2, 9}, 7, 8}};
  const ContactMatch strict = match_contacts(expected, found, 0);
  EXPECT_EQ(strict.expected, 4U);
  EXPECT_EQ(strict.missed, 2U);    // (1, 4), and (2, 9) at 1
  EXPECT_EQ(strict.spurious, 2U);  // (0, 5) at 9, and (1, 4)
  EXPECT_EQ(strict.timed, 2U);
  EXPECT_EQ(strict.time_error_max, 1.0);
  EXPECT_EQ(strict.time_error_sum, 0.5 * (1 + 0.5) + 0.5 * (1 + 0));
  const ContactMatch loose = match_contacts(expected, found, 0.5);
  EXPECT_EQ(loose.missed, 1U);
  EXPECT_EQ(loose.spurious, 1U);
}

}  // namespace
}  // namespace kds::matching_test
