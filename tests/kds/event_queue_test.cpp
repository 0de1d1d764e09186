#include "kds/event_queue.h"

#include <gmock/gmock.h>

#include <map>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>

#include "tests/support/judges/linear_queue.h"

namespace kds::event_queue_test {
namespace {

using test::LinearQueue;

struct Key {
  int value = 0;
  // Keys are move-only, and reading a lost key fails visibly.
  std::unique_ptr<int> ballast = std::make_unique<int>(0);
};

struct Order {
  std::size_t comparisons = 0;
  bool before(Key& a, Key& b) {
    ++comparisons;
    return a.value + *a.ballast < b.value + *b.ballast;
  }
  // Bins are 10 keys wide, the bounds of keys overlap, and some keys lie beyond both ends of the range that
  // the queue expects.
  static double earliest(const Key& key) { return (key.value - 7) / 10240.0; }
  static double latest(const Key& key) { return (key.value + 7) / 10240.0; }
};

// Both queues must behave alike.
template <class Queue>
class EventQueueTest : public testing::Test {
 protected:
  QueueHandle push(int value) {
    return queue.push([&](QueueHandle) { return Key{value}; });
  }
  std::vector<int> pop_all() {
    std::vector<int> values;
    for (; !queue.empty(); queue.pop()) values.push_back(queue.top().value);
    return values;
  }

  Order order;
  Queue queue{order};
};

using Queues = testing::Types<EventQueue<Key, Order>, LinearQueue<Key, Order>>;
TYPED_TEST_SUITE(EventQueueTest, Queues);

TYPED_TEST(EventQueueTest, TellsTheHandleToTheKeyThatIsMade) {
  QueueHandle told = 77;
  const QueueHandle handle = this->queue.push([&](QueueHandle h) {
    told = h;
    return Key{3};
  });
  EXPECT_EQ(told, handle);
  EXPECT_EQ(this->queue.top_handle(), handle);
}

TYPED_TEST(EventQueueTest, UsesHandlesAgain) {
  std::set<QueueHandle> handles;
  for (int round = 0; round < 100; ++round) {
    const QueueHandle a = this->push(round);
    const QueueHandle b = this->push(-round);
    handles.insert({a, b});
    this->queue.erase(a);
    this->queue.pop();
  }
  EXPECT_EQ(handles.size(), 2U);
}

TYPED_TEST(EventQueueTest, ClearForgetsAllAndFreesHandles) {
  std::set<QueueHandle> handles;
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 20; ++i) handles.insert(this->push(20 - i));
    this->queue.clear();
    EXPECT_TRUE(this->queue.empty());
    EXPECT_EQ(this->queue.size(), 0U);
  }
  EXPECT_EQ(handles.size(), 20U);
  this->push(3);
  this->push(2);
  EXPECT_THAT(this->pop_all(), testing::ElementsAre(2, 3));
}

// FailureOrder narrows brackets inside the queue in the same way: keys change in place, but their order
// stays.
TYPED_TEST(EventQueueTest, LetsKeysBeWrittenTo) {
  std::vector<QueueHandle> handles;
  for (int i = 0; i < 40; ++i) handles.push_back(this->push(10 * (11 * i % 40)));
  for (int i = 0; i < 40; ++i) *this->queue.at(handles[static_cast<std::size_t>(i)]).ballast = i % 5;
  std::vector<int> expected;
  for (int i = 0; i < 40; ++i) expected.push_back(10 * i);
  EXPECT_EQ(this->pop_all(), expected);
}

TYPED_TEST(EventQueueTest, AgreesWithAMultimap) {
  // The linear list is slow, so it gets fewer entries at a time.
  constexpr bool linear = std::same_as<TypeParam, LinearQueue<Key, Order>>;
  std::mt19937 random(20240705);
  std::multimap<int, QueueHandle> reference;
  std::map<QueueHandle, std::multimap<int, QueueHandle>::iterator> held;
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const auto forget = [&](QueueHandle handle) {
    reference.erase(held.at(handle));
    held.erase(handle);
  };
  std::size_t target = 0;
  for (int operation = 0; operation < 100000; ++operation) {
    if (operation % 500 == 0) target = below(linear ? 20 : 400);
    const std::size_t choice = below(100);
    if (reference.empty() || choice < (reference.size() < target ? 70U : 30U)) {
      const int value = static_cast<int>(below(operation % 2000 < 1000 ? 10 : 12000));
      const QueueHandle handle = this->push(value);
      ASSERT_EQ(held.count(handle), 0U) << "handle of a live entry given again";
      held[handle] = reference.emplace(value, handle);
    } else if (choice < 85) {
      const QueueHandle handle = this->queue.top_handle();
      ASSERT_EQ(this->queue.top().value, reference.begin()->first);
      ASSERT_EQ(held.at(handle)->first, reference.begin()->first);
      forget(handle);
      this->queue.pop();
    } else if (choice < 99 || operation % 50 != 0) {
      const QueueHandle handle =
          std::next(reference.begin(), static_cast<long>(below(reference.size())))->second;
      ASSERT_EQ(this->queue.at(handle).value, held.at(handle)->first);
      forget(handle);
      this->queue.erase(handle);
    } else {
      this->queue.clear();
      reference.clear();
      held.clear();
    }
    ASSERT_EQ(this->queue.size(), reference.size());
    ASSERT_EQ(this->queue.empty(), reference.empty());
  }
}

// All entries are in one bin, which becomes a heap once it is near.
struct OneBin : Order {
  static double earliest(const Key&) { return 0.5; }
  static double latest(const Key&) { return 0.5; }
};

// Checks the cost table of the header.
TEST(EventQueueCost, GrowsWithTheLogarithm) {
  OneBin order;
  EventQueue<Key, OneBin> queue(order);
  std::mt19937 random(1);
  std::vector<QueueHandle> handles;
  const auto push = [&] {
    const int value = static_cast<int>(random() % 1000000);
    handles.push_back(queue.push([&](QueueHandle) { return Key{value}; }));
  };
  push();
  ASSERT_GE(queue.top().value, 0);  // the bin is a heap from now on
  for (int i = 0; i < 4096; ++i) {
    const std::size_t before = order.comparisons;
    push();
    ASSERT_LE(order.comparisons - before, 7U);  // log4(4096) = 6
  }
  for (std::size_t i = 0; i < 4000; ++i) {
    const std::size_t before = order.comparisons;
    queue.erase(handles[i]);
    ASSERT_LE(order.comparisons - before, 29U);  // each step of an entry that sinks makes four comparisons
    const std::size_t unchanged = order.comparisons;
    ASSERT_GE(queue.top().value, 0);
    ASSERT_EQ(order.comparisons, unchanged);
  }
}

TEST(EventQueueCost, WhatIsFarIsNotCompared) {
  Order order;
  EventQueue<Key, Order> queue(order);
  std::vector<QueueHandle> handles;
  for (int value = 10000; value-- > 0;) {
    handles.push_back(queue.push([&](QueueHandle) { return Key{value}; }));
  }
  EXPECT_EQ(order.comparisons, 0U);
  EXPECT_EQ(queue.top().value, 0);
  EXPECT_LT(order.comparisons, 100U);
  const std::size_t before = order.comparisons;
  for (std::size_t i = 0; i < 9000; ++i) queue.erase(handles[i]);
  EXPECT_EQ(order.comparisons, before);
  for (int value = 0; value < 1000; ++value, queue.pop()) ASSERT_EQ(queue.top().value, value);
  EXPECT_TRUE(queue.empty());
}

struct Throwing : Order {
  bool throws = false;
  bool before(Key& a, Key& b) {
    if (throws) throw std::runtime_error("no order");
    return Order::before(a, b);
  }
};

// An exact comparison may throw if memory runs out.
TEST(EventQueueErrors, ClearMendsWhatAnOrderThatThrewLeft) {
  Throwing order;
  EventQueue<Key, Throwing> queue(order);
  for (int round = 0; round < 3; ++round) {
    for (int value = 1000; value-- > 0;) queue.push([&](QueueHandle) { return Key{value}; });
    for (int value = 0; value < 300 * round; ++value, queue.pop()) ASSERT_EQ(queue.top().value, value);
    order.throws = true;
    EXPECT_THROW(while (true) queue.pop(), std::runtime_error);
    order.throws = false;
    queue.clear();
    EXPECT_TRUE(queue.empty());
  }
  for (int value = 1000; value-- > 0;) queue.push([&](QueueHandle) { return Key{value}; });
  for (int value = 0; value < 1000; ++value, queue.pop()) ASSERT_EQ(queue.top().value, value);
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace kds::event_queue_test
