#pragma once
// A symmetric set of pairs of beads as flat adjacency lists: the neighbours of each bead in ascending order.
// The set holds the edges of a diagram or the family of beads that may meet. No bead is its own neighbour.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "motions/base/bead.h"
#include "motions/base/bead_range.h"

namespace kds {

class BeadPairs {
 public:
  using Pair = std::pair<BeadId, BeadId>;

  BeadPairs() = default;
  /// Constructs the set from pairs of beads 0 ... beads-1. A pair may occur twice and in either order. Throws
  /// std::invalid_argument if a pair names one bead twice or a bead that does not exist.
  BeadPairs(std::size_t beads, std::span<const Pair> pairs);
  /// Returns the pairs of consecutive beads of each necklace.
  [[nodiscard]] static BeadPairs along(std::size_t beads, std::span<const BeadRange> necklaces);

  [[nodiscard]] std::size_t bead_count() const { return start_.empty() ? 0 : start_.size() - 1; }
  [[nodiscard]] std::size_t size() const { return neighbors_.size() / 2; }
  [[nodiscard]] std::span<const BeadId> of(BeadId bead) const {
    return std::span(neighbors_).subspan(start_[bead], start_[bead + 1] - start_[bead]);
  }
  [[nodiscard]] bool contains(BeadId a, BeadId b) const {
    return std::binary_search(of(a).begin(), of(a).end(), b);
  }

 private:
  std::vector<std::size_t> start_;  // start of each bead's list, then the end of the last
  std::vector<BeadId> neighbors_;
};

}  // namespace kds
