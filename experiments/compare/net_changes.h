#pragma once
// Counts how a structure differs from one frame to the next, whatever happened in between.

#include <cstdint>
#include <optional>

#include "structures/session/structure_spec.h"

namespace kds {

/// Returns the number of places (CombinatorialElements) whose content differs or that only one of the two
/// frames has. The places depend on the structure:
/// - wrapped hierarchy: nodes with another basis;
/// - power diagram: cells of one frame that the other does not have;
/// - contacts: pairs that meet in only one of the frames;
/// - sorted list: ranks with another bead;
/// - box: ends with another bead;
/// - hull: corners of only one frame;
/// - closest pair: another pair.
[[nodiscard]] std::uint64_t net_changes(CombinatorialElements before, CombinatorialElements after);

/// Sums the net changes over the frames of a run. Keeps only the last frame.
class NetChanges {
 public:
  /// Adds the next frame. No value means that this structure is not compared.
  void add(std::optional<CombinatorialElements> frame);
  /// Returns the sum, or nothing if a frame could not be compared.
  [[nodiscard]] std::optional<std::uint64_t> count() const {
    return last_ ? std::optional(count_) : std::nullopt;
  }

 private:
  std::optional<CombinatorialElements> last_;
  std::uint64_t count_ = 0;
};

}  // namespace kds
