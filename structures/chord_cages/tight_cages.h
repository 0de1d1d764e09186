#pragma once
// Chord cages whose radii are proved to be within 1 + eps of the smallest at all times of a step: the step of
// a node that is not proved tight is halved, with the smallest sphere at its middle, until all parts are. The
// parts hold all beads like the whole: the rounding of a curve's part is added to their radii.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "structures/chord_cages/chord_cages.h"
#include "structures/chord_cages/radius_bound.h"

namespace kds {

template <int Dimension>
class TightCages {
 public:
  /// A part of a step is halved at most so often in a row: only where the smallest radius comes near 0, or
  /// the bound near the rounding, that is not enough. Lengths beyond 2^400 or below 2^-400 are not judged.
  static constexpr int most_halvings = 24;
  /// Nor has a node more parts than this.
  static constexpr std::size_t most_parts = 1024;

  explicit TightCages(double tightness) : tightness_(tightness) {}

  /// For the step of these cages, which keep their bases.
  void prove(const ChordCages<StaticWrappedHierarchy<Dimension>>& cages, const Curves<Dimension>& curves);

  /// The parts of a node's step in their order; none where the whole step's sphere is tight.
  [[nodiscard]] std::span<const CagePiece<Dimension>> parts(NodeId node) const;
  /// Of the step: how many parts were halved, and how many are not proved tight.
  [[nodiscard]] std::uint64_t bisections() const { return bisections_; }
  [[nodiscard]] std::uint64_t unproved() const { return unproved_; }

 private:
  struct Parts {
    NodeId node;
    std::size_t first, end;  // of parts_
  };

  void bisect(NodeId node, const BeadRange& range, const CagePiece<Dimension>& whole,
              const Curves<Dimension>& curves);
  [[nodiscard]] Cage<Dimension> cage_at(const BeadRange& range, const Curves<Dimension>& curves, double from,
                                        double to, int k, double error, Basis& basis);

  double tightness_;
  std::uint64_t bisections_ = 0, unproved_ = 0;
  std::vector<NodeId> loose_;
  Balls<Dimension> there_;       // of the node that is looked at, in the middle of a part
  std::vector<Parts> bisected_;  // ascending
  std::vector<CagePiece<Dimension>> parts_;
};

}  // namespace kds
