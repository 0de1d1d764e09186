#pragma once
// Pairs of beads: those that a query asks about, and symmetric sets of pairs.

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motions/base/bead.h"
#include "motions/base/bead_groups.h"

namespace kds {

/// Formats beads for messages, for example "3, 7, infinity".
[[nodiscard]] inline std::string bead_names(std::span<const BeadId> beads) {
  std::string names;
  for (const BeadId b : beads) {
    if (!names.empty()) names += ", ";
    names += b == no_bead ? "infinity" : std::to_string(b);
  }
  return names;
}

/// Two beads of the scene, first < second.
struct BeadPair {
  BeadId first = 0, second = 0;
  friend auto operator<=>(const BeadPair&, const BeadPair&) = default;
};

/// Selects the pairs of beads a query is about: pairs within one necklace that are far enough apart along it,
/// pairs of two necklaces, or both. Pairs near along the chain meet by construction. With two groups of
/// beads, only pairs with one bead in each group are asked about; a bead may be in both groups. Two beads at
/// rest are never asked about, because their distance never changes: those of one obstacle, and those of two.
struct PairsAsked {
  std::vector<BeadRange> necklaces;  ///< one after the other, from bead 0 to the scene's last bead
  bool within = true;                ///< pairs within one necklace
  BeadId apart = 2;                  ///< least distance in sequence for these pairs, at least 1
  bool between = true;               ///< pairs of two necklaces
  BeadGroups groups = {};            ///< groups 0 and 1 of each bead; empty: pairs of any beads
  /// Whether each necklace is at rest, as Scene::at_rest has it; empty: none is. The caller declares it:
  /// edits that move a bead of such a necklace do not change which pairs are asked about.
  std::vector<bool> at_rest = {};

  [[nodiscard]] bool rests(std::size_t necklace) const { return !at_rest.empty() && at_rest[necklace]; }
  /// Returns whether any pair of a bead of one necklace and a bead of the other may be asked about. Takes one
  /// necklace twice.
  [[nodiscard]] bool asks_of(std::size_t necklace, std::size_t other) const {
    return (necklace == other ? within : between) && !(rests(necklace) && rests(other));
  }

  /// Returns the index of the bead's necklace.
  [[nodiscard]] std::size_t necklace_of(BeadId bead) const {
    const auto after = std::upper_bound(necklaces.begin(), necklaces.end(), bead,
                                        [](BeadId b, const BeadRange& range) { return b < range.first; });
    return static_cast<std::size_t>(after - necklaces.begin()) - 1;
  }

  /// Takes log(necklaces) time, which suits single pairs. Loops over many pairs should look up the necklaces
  /// themselves.
  [[nodiscard]] bool asks(const BeadPair& pair) const {
    if (!joins_groups(pair)) return false;
    const std::size_t first = necklace_of(pair.first), second = necklace_of(pair.second);
    return asks_of(first, second) && (first != second || pair.second - pair.first >= apart);
  }

  /// Returns whether one bead is in group 0 and the other in group 1. True without groups.
  [[nodiscard]] bool joins_groups(const BeadPair& pair) const {
    return groups.empty() || joins(groups[pair.first], groups[pair.second]);
  }
  /// Takes the groups of two beads, or the groups that occur in two sets of beads.
  [[nodiscard]] static constexpr bool joins(unsigned one, unsigned other) {
    return ((one & (other >> 1U)) | ((one >> 1U) & other)) % 2 != 0;
  }
};

/// Throws std::invalid_argument if there are groups, but not those of all beads of the necklaces, or if
/// `at_rest` is neither empty nor of all necklaces.
void check_groups(const PairsAsked& asked);
/// Throws std::invalid_argument if there are groups. For a `method` that looks at all pairs.
void refuse_groups(const PairsAsked& asked, std::string_view method);

/// A symmetric set of pairs of beads as flat adjacency lists: the neighbours of each bead in ascending order.
/// The set holds the edges of a diagram or the family of beads that may meet. No bead is its own neighbour.
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
