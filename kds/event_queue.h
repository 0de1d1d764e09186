#pragma once
// Addressable priority queue of failures: a 4-ary heap over dense handles.
//
//   push        O(log4 n)      erase   O(4 log4 n)
//   top         O(1)           pop     O(4 log4 n)
//
// No allocation once it has grown. The order may narrow the entries it compares (their bracket shrinks around
// the same time), which never changes how they compare. Slow obvious twin: tests/support/linear_queue.h.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace kds {

/// Names an entry from push to pop or erase; then it may be used again.
using QueueHandle = std::uint32_t;

template <class O, class Key>
concept QueueOrder = requires(O& order, Key& a, Key& b) {
  { order.before(a, b) } -> std::same_as<bool>;  // strict total order
};

template <class Key, QueueOrder<Key> Order>
class EventQueue {
 public:
  explicit EventQueue(Order& order) : order_(order) {}

  [[nodiscard]] bool empty() const { return heap_.empty(); }
  [[nodiscard]] std::size_t size() const { return heap_.size(); }

  /// `make_key` is given the handle, so that keys can know theirs.
  template <std::invocable<QueueHandle> MakeKey>
  QueueHandle push(MakeKey&& make_key) {
    QueueHandle handle;
    if (free_.empty()) {
      handle = static_cast<QueueHandle>(place_.size());
      place_.push_back(0);
    } else {
      handle = free_.back();
      free_.pop_back();
    }
    heap_.push_back({make_key(handle), handle});
    sift_up(heap_.size() - 1);
    return handle;
  }

  [[nodiscard]] Key& top() { return heap_.front().key; }
  [[nodiscard]] QueueHandle top_handle() const { return heap_.front().handle; }
  [[nodiscard]] Key& at(QueueHandle handle) { return heap_[place_[handle]].key; }

  void pop() { erase(heap_.front().handle); }

  void erase(QueueHandle handle) {
    const std::size_t hole = place_[handle];
    free_.push_back(handle);
    const std::size_t last = heap_.size() - 1;
    if (hole != last) {
      heap_[hole] = std::move(heap_[last]);
      heap_.pop_back();
      place_[heap_[hole].handle] = hole;
      if (!sift_up(hole)) sift_down(hole);
    } else {
      heap_.pop_back();
    }
  }

  void clear() {
    for (const Node& node : heap_) free_.push_back(node.handle);
    heap_.clear();
  }

 private:
  struct Node {
    Key key;
    QueueHandle handle;
  };

  bool sift_up(std::size_t i) {
    const std::size_t start = i;
    Node node = std::move(heap_[i]);
    while (i > 0) {
      const std::size_t parent = (i - 1) / 4;
      if (!order_.before(node.key, heap_[parent].key)) break;
      put(i, std::move(heap_[parent]));
      i = parent;
    }
    put(i, std::move(node));
    return i != start;
  }

  void sift_down(std::size_t i) {
    Node node = std::move(heap_[i]);
    while (true) {
      const std::size_t first = 4 * i + 1;
      if (first >= heap_.size()) break;
      std::size_t least = first;
      for (std::size_t child = first + 1; child < first + 4 && child < heap_.size(); ++child) {
        if (order_.before(heap_[child].key, heap_[least].key)) least = child;
      }
      if (!order_.before(heap_[least].key, node.key)) break;
      put(i, std::move(heap_[least]));
      i = least;
    }
    put(i, std::move(node));
  }

  void put(std::size_t i, Node&& node) {
    place_[node.handle] = i;
    heap_[i] = std::move(node);
  }

  Order& order_;
  std::vector<Node> heap_;
  std::vector<std::size_t> place_;  // of each handle in the heap
  std::vector<QueueHandle> free_;
};

}  // namespace kds
