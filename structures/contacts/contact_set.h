#pragma once
// The pairs of beads in contact, in a hash table with open addressing. The table is queried for each pair
// that may change.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "structures/collision/pairs_asked.h"

namespace kds {

class ContactSet {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool contains(const BeadPair& pair) const {
    return size_ > 0 && places_[place_of(key_of(pair))] != nobody;
  }
  /// Returns false if the pair was in the set already.
  bool insert(const BeadPair& pair) {
    if (2 * (size_ + 1) > places_.size()) grow();
    std::uint64_t& place = places_[place_of(key_of(pair))];
    if (place != nobody) return false;
    place = key_of(pair);
    ++size_;
    return true;
  }
  /// Returns false if the pair was not in the set.
  bool erase(const BeadPair& pair) {
    if (!contains(pair)) return false;
    std::size_t gap = place_of(key_of(pair));
    // Moves later entries into the gap if the gap lies between their home place and their present place.
    for (std::size_t at = next(gap); places_[at] != nobody; at = next(at)) {
      const std::size_t home = home_of(places_[at]);
      if (((at - home) & mask()) < ((at - gap) & mask())) continue;
      places_[gap] = places_[at];
      gap = at;
    }
    places_[gap] = nobody;
    --size_;
    return true;
  }
  void clear() {
    std::fill(places_.begin(), places_.end(), nobody);
    size_ = 0;
  }
  /// Returns all pairs, ascending.
  [[nodiscard]] std::vector<BeadPair> pairs() const {
    std::vector<BeadPair> all;
    all.reserve(size_);
    for (const std::uint64_t key : places_)
      if (key != nobody) all.push_back({static_cast<BeadId>(key >> 32U), static_cast<BeadId>(key)});
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  static constexpr std::uint64_t nobody = ~std::uint64_t{0};  // no pair has this key, because first < second

  static std::uint64_t key_of(const BeadPair& pair) {
    return (static_cast<std::uint64_t>(pair.first) << 32U) | pair.second;
  }
  [[nodiscard]] std::size_t mask() const { return places_.size() - 1; }
  [[nodiscard]] std::size_t next(std::size_t place) const { return (place + 1) & mask(); }
  [[nodiscard]] std::size_t home_of(std::uint64_t key) const {
    return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 32U) & mask();
  }
  /// Returns the place that holds the key, or the place to insert it.
  [[nodiscard]] std::size_t place_of(std::uint64_t key) const {
    std::size_t place = home_of(key);
    while (places_[place] != key && places_[place] != nobody) place = next(place);
    return place;
  }
  void grow() {
    std::vector<std::uint64_t> old(std::max<std::size_t>(64, 2 * places_.size()), nobody);
    old.swap(places_);
    for (const std::uint64_t key : old)
      if (key != nobody) places_[place_of(key)] = key;
  }

  std::vector<std::uint64_t> places_;  // size is a power of two
  std::size_t size_ = 0;
};

}  // namespace kds
