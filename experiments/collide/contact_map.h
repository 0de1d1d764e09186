#pragma once
// Counts how often each pair of beads collides, as a contact map shows it. If there are many beads, counts
// pairs of groups of consecutive beads. Memory does not grow with frames or pairs.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "structures/necklace/bead_pairs.h"

namespace kds {

class ContactMap {
 public:
  explicit ContactMap(std::size_t beads);

  void add_frame(std::span<const BeadPair> pairs);
  [[nodiscard]] bool empty() const { return pairs_ == 0; }
  /// Returns the map as an SVG element.
  [[nodiscard]] std::string plot() const;

 private:
  static constexpr std::size_t most_groups = 240;
  std::size_t beads_, in_group_, groups_;
  std::size_t frames_ = 0;
  std::uint64_t pairs_ = 0;
  std::vector<std::uint64_t> counts_;  // of the groups i <= j, at index i * groups_ + j
};

}  // namespace kds
