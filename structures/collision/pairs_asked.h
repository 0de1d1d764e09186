#pragma once
// Selects the pairs of beads a query is about: pairs within one necklace that are far enough apart along it,
// pairs of two necklaces, or both. Pairs near along the chain meet by construction.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "motions/base/bead_range.h"

namespace kds {

/// Two beads of the scene, first < second.
struct BeadPair {
  BeadId first = 0, second = 0;
  friend auto operator<=>(const BeadPair&, const BeadPair&) = default;
};

struct PairsAsked {
  std::vector<BeadRange> necklaces;  ///< one after the other, from bead 0 to the scene's last bead
  bool within = true;                ///< pairs within one necklace
  BeadId apart = 2;                  ///< least distance in sequence for these pairs, at least 1
  bool between = true;               ///< pairs of two necklaces

  /// Returns the index of the bead's necklace.
  [[nodiscard]] std::size_t necklace_of(BeadId bead) const {
    const auto after = std::upper_bound(necklaces.begin(), necklaces.end(), bead,
                                        [](BeadId b, const BeadRange& range) { return b < range.first; });
    return static_cast<std::size_t>(after - necklaces.begin()) - 1;
  }

  /// Takes log(necklaces) time, which suits single pairs. Loops over many pairs should look up the necklaces
  /// themselves.
  [[nodiscard]] bool asks(const BeadPair& pair) const {
    if (necklace_of(pair.first) != necklace_of(pair.second)) return between;
    return within && pair.second - pair.first >= apart;
  }
};

}  // namespace kds
