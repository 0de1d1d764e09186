#pragma once
// Addressable priority queue of failures. Most failures are cancelled long before their time, so only
// failures of the near future are kept in order, in a 4-ary heap. All others lie in bins: [0,1] is divided
// into equal spans, and each failure is put into the bin of its earliest time. A bin is moved into the heap
// when its time has come. Costs for n entries, m of them near, where m is about n / bins:
//
//   push        O(log4 m) near, O(1) far      erase   O(4 log4 m) near, O(1) far
//   top         O(1), a bin of k joining O(k log4 m)       pop     O(4 log4 m)
//
// The queue is a plain heap if all times fall into one bin. The queue does not allocate once it has grown to
// its size. The order may narrow the entries it compares: their brackets shrink around the same time, which
// never changes how they compare.
//
// The data that an event needs are scattered in memory, and each piece holds the address of the next one. If
// the order has a function `fetch(key, bins_ahead)`, the queue calls it for failures that come near, with
// bins_ahead = 2, 1, 0, so that each piece is prefetched while earlier events run. The queue skips this if it
// has few entries, because these are in the cache anyway. Slow obvious twin:
// tests/support/judges/linear_queue.h.

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace kds {

/// Names an entry from push until pop or erase, and may be reused afterwards.
using QueueHandle = std::uint32_t;

/// An order must put `a` before `b` whenever latest(a) < earliest(b).
template <class O, class Key>
concept QueueOrder = requires(O& order, Key& a, Key& b) {
  { order.before(a, b) } -> std::same_as<bool>;  // strict total order
  { order.earliest(a) } -> std::same_as<double>;
  { order.latest(a) } -> std::same_as<double>;
};

template <class Key, QueueOrder<Key> Order>
class EventQueue {
 public:
  explicit EventQueue(Order& order) : order_(order) {}

  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] std::size_t size() const { return near_.size() + far_count_; }

  /// Calls `make_key` with the new entry's handle, so that a key can store its handle.
  template <std::invocable<QueueHandle> MakeKey>
  QueueHandle push(MakeKey&& make_key) {
    QueueHandle handle;
    if (free_.empty()) {
      handle = static_cast<QueueHandle>(entries_.size());
      entries_.emplace_back();
    } else {
      handle = free_.back();
      free_.pop_back();
    }
    Entry& entry = entries_[handle];
    entry.key = make_key(handle);
    const std::uint32_t bin = bin_of(order_.earliest(entry.key));
    if (bin < first_far_) {
      push_near(handle);
    } else {
      push_far(handle, bin);
    }
    return handle;
  }

  [[nodiscard]] Key& top() { return at(top_handle()); }
  [[nodiscard]] QueueHandle top_handle() {
    while (far_count_ != 0 && (near_.empty() || !(order_.latest(at(near_.front())) < far_from())))
      bring_next_bin();
    return near_.front();
  }
  [[nodiscard]] Key& at(QueueHandle handle) { return entries_[handle].key; }
  /// Prefetches an entry that will be needed soon.
  void fetch(QueueHandle handle) const { __builtin_prefetch(&entries_[handle], 1); }

  void pop() { erase(top_handle()); }

  void erase(QueueHandle handle) {
    if (entries_[handle].bin == in_heap) {
      erase_near(entries_[handle].index);
    } else {
      erase_far(entries_[handle]);
    }
    free_.push_back(handle);
  }

  void clear() {
    entries_.clear();
    free_.clear();
    near_.clear();
    coming_.clear();
    for (; far_count_ != 0; ++first_far_) {
      first_far_ = next_filled(first_far_);
      far_count_ -= bins_[first_far_].size();
      empty(first_far_);
    }
    first_far_ = 0;
  }

 private:
  static constexpr std::uint32_t bin_count = 1024;
  static constexpr std::uint32_t none = 0xffffffffU;
  static constexpr std::uint32_t in_heap = none;
  static constexpr std::size_t many = 4096;  // with fewer entries, prefetching costs more than it saves

  struct Entry {
    Key key;
    std::uint32_t bin;    // bin number, or in_heap
    std::uint32_t index;  // position in the bin or in the heap
  };

  // Far entries.

  [[nodiscard]] static std::uint32_t bin_of(double earliest) {
    const double bin = earliest * bin_count;  // exact, because bin_count is a power of two
    if (!(bin > 0)) return 0;
    return bin < bin_count ? static_cast<std::uint32_t>(bin) : bin_count - 1;
  }
  /// Returns a time that no far entry precedes.
  [[nodiscard]] double far_from() const { return static_cast<double>(first_far_) / bin_count; }

  void push_far(QueueHandle handle, std::uint32_t bin) {
    Entry& entry = entries_[handle];
    entry.bin = bin;
    entry.index = static_cast<std::uint32_t>(bins_[bin].size());
    bins_[bin].push_back(handle);
    filled_[bin / 64] |= 1ULL << (bin % 64);
    ++far_count_;
  }

  void erase_far(const Entry& entry) {
    std::vector<QueueHandle>& bin = bins_[entry.bin];
    const QueueHandle last = bin.back();
    bin[entry.index] = last;
    entries_[last].index = entry.index;
    bin.pop_back();
    if (bin.empty()) filled_[entry.bin / 64] &= ~(1ULL << (entry.bin % 64));
    --far_count_;
  }

  void bring_next_bin() {
    first_far_ = next_filled(first_far_);
    if constexpr (requires(Key & key) { order_.fetch(key, 0U); }) {
      if (entries_.size() >= many) fetch_ahead(first_far_);
    }
    // Take the bin's entries out first, so that clear() finds consistent bins if the order throws.
    coming_.swap(bins_[first_far_]);
    far_count_ -= coming_.size();
    empty(first_far_++);
    for (const QueueHandle handle : coming_) push_near(handle);
    coming_.clear();
  }

  void empty(std::uint32_t bin) {
    bins_[bin].clear();
    filled_[bin / 64] &= ~(1ULL << (bin % 64));
  }
  /// Returns the first bin that is not empty, from `bin` on. There must be one.
  [[nodiscard]] std::uint32_t next_filled(std::uint32_t bin) const {
    std::uint32_t word = bin / 64;
    std::uint64_t some = filled_[word] & (~0ULL << (bin % 64));
    while (some == 0) some = filled_[++word];
    return 64 * word + static_cast<std::uint32_t>(std::countr_zero(some));
  }

  void fetch_ahead(std::uint32_t next) {
    for (unsigned ahead = 0; ahead < 3 && next + ahead < bin_count; ++ahead) {
      for (const QueueHandle handle : bins_[next + ahead]) order_.fetch(at(handle), ahead);
    }
    if (next + 3 >= bin_count) return;
    for (const QueueHandle handle : bins_[next + 3]) __builtin_prefetch(&entries_[handle]);
  }

  // Near entries.

  [[nodiscard]] bool before(QueueHandle a, QueueHandle b) { return order_.before(at(a), at(b)); }

  void push_near(QueueHandle handle) {
    entries_[handle].bin = in_heap;
    near_.push_back(handle);
    sift_up(near_.size() - 1);
  }

  void erase_near(std::size_t hole) {
    const QueueHandle last = near_.back();
    near_.pop_back();
    if (hole == near_.size()) return;
    put(hole, last);
    if (!sift_up(hole)) sift_down(hole);
  }

  bool sift_up(std::size_t i) {
    const std::size_t start = i;
    const QueueHandle handle = near_[i];
    while (i > 0) {
      const std::size_t parent = (i - 1) / 4;
      if (!before(handle, near_[parent])) break;
      put(i, near_[parent]);
      i = parent;
    }
    put(i, handle);
    return i != start;
  }

  void sift_down(std::size_t i) {
    const QueueHandle handle = near_[i];
    while (true) {
      const std::size_t first = 4 * i + 1;
      if (first >= near_.size()) break;
      std::size_t least = first;
      for (std::size_t child = first + 1; child < first + 4 && child < near_.size(); ++child) {
        if (before(near_[child], near_[least])) least = child;
      }
      if (!before(near_[least], handle)) break;
      put(i, near_[least]);
      i = least;
    }
    put(i, handle);
  }

  void put(std::size_t i, QueueHandle handle) {
    entries_[handle].index = static_cast<std::uint32_t>(i);
    near_[i] = handle;
  }

  Order& order_;
  std::vector<Entry> entries_;
  std::vector<QueueHandle> free_;
  std::vector<QueueHandle> near_;                         // the heap
  std::array<std::vector<QueueHandle>, bin_count> bins_;  // bins before first_far_ are empty
  std::array<std::uint64_t, bin_count / 64> filled_{};    // a bit for each bin, set if it is not empty
  std::vector<QueueHandle> coming_;                       // a bin while it is moved into the heap
  std::size_t far_count_ = 0;
  std::uint32_t first_far_ = 0;
};

}  // namespace kds
