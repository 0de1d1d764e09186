#pragma once
// Lists and counts the pairs of beads that a query asks about, for methods that look at all of them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Takes time and memory that grow with the number of beads, and then time for each pair in question only.
class PairsInQuestion {
 public:
  /// `asked` must outlive this object. Throws std::invalid_argument like check_groups.
  explicit PairsInQuestion(const PairsAsked& asked);

  [[nodiscard]] std::uint64_t count() const;

  /// Calls visit(i, j) for each pair, in ascending order, i < j.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t n = 0; n < asked_->necklaces.size(); ++n)
      for (BeadId i = asked_->necklaces[n].first; i <= asked_->necklaces[n].last; ++i)
        for (const std::span<const BeadId> run : partners(i, n))
          for (const BeadId j : run) visit(i, j);
  }

 private:
  /// Returns the later beads that form pairs with a bead of this necklace, in ascending runs: those within
  /// it, and those of later necklaces.
  [[nodiscard]] std::vector<std::span<const BeadId>> partners(BeadId bead, std::size_t necklace) const;

  const PairsAsked* asked_;
  std::array<std::vector<BeadId>, 4> partners_;  ///< by the groups of the first bead; only 0 without groups
};

}  // namespace kds
