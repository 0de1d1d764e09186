#pragma once
// A Verlet list, what molecular dynamics finds near pairs with from frame to frame: pairs that are at most
// the skin apart, from a cell list, looked through at every frame until some bead has moved by more than half
// the skin. The baseline for slow motion.
//
// Exact: until then two balls that meet were at most the skin apart when the list was made. That no bead has
// moved by more is told in doubles, with room for their rounding: squares err by less than 2^-50, and the
// limit is smaller by 2^-40. Where its square is not a number far from underflow and overflow (below 2^-900,
// above 2^900) the list is made anew at every frame.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "structures/collision/cell_list.h"

namespace kds {

template <int Dimension>
class VerletList {
 public:
  /// A skin of one radius is usual.
  VerletList(PairsAsked asked, double skin) : cells_(std::move(asked)), skin_(skin) {}

  /// All pairs asked about that meet, in order. Valid until the next call. Frame after frame of the same
  /// beads, whose radii stay the same.
  const std::vector<BeadPair>& pairs(const Balls<Dimension>& balls);

  [[nodiscard]] std::uint64_t rebuilds() const { return rebuilds_; }
  [[nodiscard]] std::size_t size() const { return others_.size(); }

 private:
  static constexpr auto dimension = static_cast<std::size_t>(Dimension);
  [[nodiscard]] bool holds(const Balls<Dimension>& balls) const;
  void rebuild(const Balls<Dimension>& balls);

  CellList<Dimension> cells_;
  double skin_;
  std::array<std::vector<double>, dimension> made_at_;
  // The beads near each, after it: others_[starts_[b]] .. others_[starts_[b + 1]], ascending.
  std::vector<std::uint32_t> starts_;
  std::vector<BeadId> others_;
  std::vector<BeadPair> near_, pairs_;
  PairSorter sorter_;
  std::uint64_t rebuilds_ = 0;
};

}  // namespace kds
