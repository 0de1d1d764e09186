#pragma once
// How much a structure differs from one frame to the next, whatever happened in between.

#include <cstdint>
#include <optional>

#include "structures/session/structure_spec.h"

namespace kds {

/// Places (CombinatorialElements) that hold something else, or that only one of the two has: of a wrapped
/// hierarchy the nodes with another basis, of a power diagram the cells of one frame that are not in the
/// other, of contacts the pairs that meet in one frame only, of a sorted list the ranks with another bead,
/// of a box the ends with another bead, of a hull the corners of one frame alone, and of closest pairs
/// another pair.
[[nodiscard]] std::uint64_t net_changes(CombinatorialElements before, CombinatorialElements after);

/// Adds them up over the frames of a run, of which it keeps the last.
class NetChanges {
 public:
  /// The next frame; none: this structure is not compared.
  void add(std::optional<CombinatorialElements> frame);
  /// None where a frame could not be compared.
  [[nodiscard]] std::optional<std::uint64_t> count() const {
    return last_ ? std::optional(count_) : std::nullopt;
  }

 private:
  std::optional<CombinatorialElements> last_;
  std::uint64_t count_ = 0;
};

}  // namespace kds
