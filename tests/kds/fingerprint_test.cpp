#include "kds/event.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

namespace kds::fingerprint_test {
namespace {

struct Event {
  std::uint32_t step = 0;
  std::uint32_t structure = 0;
  Change change;
};

std::uint64_t fingerprint(std::initializer_list<Event> events) {
  Fingerprint print;
  for (const Event& e : events) print.add(e.step, e.structure, e.change);
  return print.value();
}

TEST(Fingerprint, DependsOnEveryPartOfAnEvent) {
  const Event plain{0, 0, {1, 2, {3, 4}}};
  std::set<std::uint64_t> prints{Fingerprint().value(), fingerprint({plain})};
  Event other = plain;
  other.step = 1;
  prints.insert(fingerprint({other}));
  other = plain;
  other.structure = 1;
  prints.insert(fingerprint({other}));
  other = plain;
  other.change.kind = 0;
  prints.insert(fingerprint({other}));
  for (const std::size_t place : {0U, 1U}) {
    for (const BeadId bead : {0U, 5U, 0x80000000U, 0xffffffffU}) {
      other = plain;
      other.change.ids[place] = bead;
      prints.insert(fingerprint({other}));
    }
  }
  other = plain;
  other.change.size = 1;
  prints.insert(fingerprint({other}));
  other.change.size = 3;
  prints.insert(fingerprint({other}));
  EXPECT_EQ(prints.size(), 2U + 3U + 8U + 2U);
}

TEST(Fingerprint, DependsOnTheOrderOfEvents) {
  const Event a{0, 0, {0, 2, {1, 2}}};
  const Event b{0, 0, {0, 2, {2, 3}}};
  EXPECT_NE(fingerprint({a, b}), fingerprint({b, a}));
  EXPECT_NE(fingerprint({a, a}), fingerprint({a}));
}

TEST(Fingerprint, LeavesOutUnusedIds) {
  Event a{0, 0, {0, 2, {1, 2}}};
  Event b = a;
  b.change.ids[2] = 9;
  EXPECT_EQ(fingerprint({a}), fingerprint({b}));
}

// Splits a history into parts at random steps, hashes the parts apart, and joins them in a random order.
TEST(Fingerprint, JoinsPartsInAnyOrder) {
  std::mt19937 random(1);
  std::vector<Event> history;
  for (std::uint32_t step = 0; step < 40; ++step)
    for (unsigned events = random() % 4; events > 0; --events)
      history.push_back({step, static_cast<std::uint32_t>(random() % 3), {0, 2, {BeadId(random() % 9), 5}}});
  Fingerprint whole;
  for (const Event& e : history) whole.add(e.step, e.structure, e.change);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Fingerprint> parts(1);
    for (std::size_t i = 0; i < history.size(); ++i) {
      if (i > 0 && history[i].step != history[i - 1].step && random() % 3 == 0) parts.emplace_back();
      parts.back().add(history[i].step, history[i].structure, history[i].change);
    }
    std::shuffle(parts.begin(), parts.end(), random);
    Fingerprint joined;
    for (const Fingerprint& part : parts) joined.join(part);
    EXPECT_EQ(joined.value(), whole.value());
  }
}

TEST(Fingerprint, DependsOnTheStepsOfTheParts) {
  const Change change{0, 2, {1, 2}};
  Fingerprint first, second, twice;
  first.add(0, 0, change);
  second.add(1, 0, change);
  twice.add(0, 0, change);
  twice.join(first);
  first.join(second);
  EXPECT_NE(first.value(), twice.value());
}

// The hash is equal on all machines. These values change only if the definition of the hash changes.
TEST(Fingerprint, Golden) {
  EXPECT_EQ(Fingerprint().value(), 0U);
  EXPECT_EQ(WordHash().value(), 0xc3817c016ba4ff30ULL);
  EXPECT_EQ(fingerprint({{3, 1, {2, 5, {10, 20, 30, 40, 0xffffffffU}}}}), 0x96e1e86f59a4a322ULL);
}

}  // namespace
}  // namespace kds::fingerprint_test
