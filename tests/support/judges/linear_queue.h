#pragma once
// A slow and obvious reference for EventQueue: an unordered list with linear search.

#include <algorithm>
#include <utility>
#include <vector>

#include "kds/event_queue.h"

namespace kds::test {

template <class Key, QueueOrder<Key> Order>
class LinearQueue {
 public:
  explicit LinearQueue(Order& order) : order_(order) {}

  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

  template <std::invocable<QueueHandle> MakeKey>
  QueueHandle push(MakeKey&& make_key) {
    QueueHandle handle = 0;
    while (std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.handle == handle; }))
      ++handle;
    entries_.push_back({make_key(handle), handle});
    return handle;
  }

  [[nodiscard]] Key& top() { return first().key; }
  [[nodiscard]] QueueHandle top_handle() { return first().handle; }
  [[nodiscard]] Key& at(QueueHandle handle) { return find(handle)->key; }

  void pop() { erase(first().handle); }
  void erase(QueueHandle handle) { entries_.erase(find(handle)); }
  void clear() { entries_.clear(); }

 private:
  struct Entry {
    Key key;
    QueueHandle handle;
  };

  Entry& first() {
    return *std::min_element(entries_.begin(), entries_.end(),
                             [this](Entry& a, Entry& b) { return order_.before(a.key, b.key); });
  }
  auto find(QueueHandle handle) {
    return std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.handle == handle; });
  }

  Order& order_;
  std::vector<Entry> entries_;
};

}  // namespace kds::test
