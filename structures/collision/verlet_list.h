#pragma once
// A Verlet list, the method by which molecular dynamics finds near pairs from frame to frame. A cell list
// finds all pairs that are at most the skin apart. These pairs are tested at every frame until some bead has
// moved by more than half the skin. This method is the baseline for slow motion.
//
// The result is exact: until then, two balls that meet were at most the skin apart when the list was made.
// The displacement test runs in doubles with room for rounding: squares have relative errors below 2^-50, and
// the limit is smaller by 2^-40. If the squared limit is near underflow or overflow
// (below 2^-900 or above 2^900), the list is made anew at every frame.

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

  /// Returns all pairs asked about that meet, in order. The result is valid until the next call. Successive
  /// calls are frames of the same beads with unchanged radii.
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
  // The later beads near bead b: others_[starts_[b]] .. others_[starts_[b + 1]], ascending.
  std::vector<std::uint32_t> starts_;
  std::vector<BeadId> others_;
  std::vector<BeadPair> near_, pairs_;
  PairSorter sorter_;
  std::uint64_t rebuilds_ = 0;
};

}  // namespace kds
