#pragma once
// Cuts necklaces into runs of sixteen consecutive beads, fewer at a necklace's end. These runs are the cages
// at the bottom of a family, because consecutive beads of a necklace stay near each other.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/base/bead_range.h"

namespace kds {

struct BeadBlock {
  static constexpr std::size_t most_beads = 16;

  BeadId first = 0;
  std::uint32_t count = 0;
  std::uint32_t necklace = 0;

  /// Returns a mask with one bit per bead.
  [[nodiscard]] std::uint32_t bits() const { return (1U << count) - 1U; }
};

/// Returns the runs in the order of the beads.
[[nodiscard]] inline std::vector<BeadBlock> blocks_of(std::span<const BeadRange> necklaces) {
  std::vector<BeadBlock> blocks;
  for (std::uint32_t necklace = 0; necklace < necklaces.size(); ++necklace) {
    const BeadRange& range = necklaces[necklace];
    for (std::size_t first = range.first; first <= range.last; first += BeadBlock::most_beads) {
      const std::size_t count = std::min(BeadBlock::most_beads, range.last + 1 - first);
      blocks.push_back({static_cast<BeadId>(first), static_cast<std::uint32_t>(count), necklace});
    }
  }
  return blocks;
}

}  // namespace kds
