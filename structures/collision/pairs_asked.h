#pragma once
// Which pairs of beads a query is about: those of one necklace that are not too near along it, those of two
// necklaces, or both. Pairs that are near along the chain meet by construction.

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
  std::vector<BeadRange> necklaces;  ///< one after the other, from bead 0 to the scene's last
  bool within = true;                ///< pairs of one necklace
  BeadId apart = 2;                  ///< only those at least so many beads apart along it, at least 1
  bool between = true;               ///< pairs of two necklaces

  /// Which necklace a bead is of.
  [[nodiscard]] std::size_t necklace_of(BeadId bead) const {
    const auto after = std::upper_bound(necklaces.begin(), necklaces.end(), bead,
                                        [](BeadId b, const BeadRange& range) { return b < range.first; });
    return static_cast<std::size_t>(after - necklaces.begin()) - 1;
  }

  /// For single pairs: log(necklaces). Loops over many pairs know their necklaces.
  [[nodiscard]] bool asks(const BeadPair& pair) const {
    if (necklace_of(pair.first) != necklace_of(pair.second)) return between;
    return within && pair.second - pair.first >= apart;
  }
};

}  // namespace kds
