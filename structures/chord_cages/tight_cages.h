#pragma once
// Chord cages whose radii are proved to be within 1 + eps of the smallest at all times of a step. If a node
// is not proved tight, its step is halved, with the smallest sphere at the middle, until all parts are
// proved. The parts hold all beads just like the whole: the rounding error of a curve's part is added to
// their radii.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motions/curves/curves.h"
#include "structures/chord_cages/chord_cages.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

/// The moving sphere of a node over a part of a step.
template <int Dimension>
struct CagePiece {
  double from = 0, to = 1;             ///< whole multiples of 2^-25
  std::vector<Cage<Dimension>> cages;  ///< at the control points of the part
  std::array<Basis, 2> bases;          ///< for the smallest spheres at its ends
};

template <int Dimension>
class TightCages {
 public:
  /// Maximum number of successive halvings of a part. More would be needed only if the smallest radius comes
  /// near 0, or if the bound comes near the rounding error. Lengths beyond 2^400 or below 2^-400 are not
  /// judged.
  static constexpr int most_halvings = 24;
  /// Maximum number of parts of a node.
  static constexpr std::size_t most_parts = 1024;

  explicit TightCages(double tightness) : tightness_(tightness) {}

  /// Proves the step of these cages, which must keep their bases.
  void prove(const ChordCages<StaticWrappedHierarchy<Dimension>>& cages, const Curves<Dimension>& curves);

  /// Returns the parts of a node's step in order, empty if the whole step's sphere is tight.
  [[nodiscard]] std::span<const CagePiece<Dimension>> parts(NodeId node) const;
  /// Return for the step how many parts were halved and how many are not proved tight.
  [[nodiscard]] std::uint64_t bisections() const { return bisections_; }
  [[nodiscard]] std::uint64_t unproved() const { return unproved_; }

 private:
  struct Parts {
    NodeId node;
    std::size_t first, end;  // the node's range of indices in parts_
  };

  void bisect(NodeId node, const BeadRange& range, const CagePiece<Dimension>& whole,
              const Curves<Dimension>& curves);
  [[nodiscard]] Cage<Dimension> cage_at(const BeadRange& range, const Curves<Dimension>& curves, double from,
                                        double to, int k, double error, Basis& basis);

  double tightness_;
  std::uint64_t bisections_ = 0, unproved_ = 0;
  std::vector<NodeId> loose_;
  Balls<Dimension> there_;       // balls of the node under test, in the middle of a part
  std::vector<Parts> bisected_;  // ascending
  std::vector<CagePiece<Dimension>> parts_;
};

}  // namespace kds
