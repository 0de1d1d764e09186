#pragma once
// Kinetic hierarchy of boxes, in the plane and in space, for equal or unequal radii: bounding volumes with
// fixed directions over the same balanced tree as the wrapped hierarchy. With the directions of the axes, a
// node's volume is the smallest axis-aligned box around its balls. With more directions, it is a discrete
// oriented polytope (k-DOP, Klosowski et al. 1998): the smallest intersection of slabs across these
// directions. k counts the sides, two for each direction: 7 directions make 14-DOPs, and 13 make 26-DOPs.
//
// A node stores, for each end of each direction, its support: the bead whose ball reaches furthest that way.
// A node's support is the support of one of its children, so the tree is a kinetic tournament for each end
// (tournament.h). A certificate of a node compares the supports of its children (reaches_further.h). The
// slabs are those of the balls themselves: supports are exact for unequal radii too.
//
// If several balls tie for the rest of a step, the least bead is the support. If several supports change at
// one time, each changes at most once: changes are recorded after all events at that time, ascending by node
// and side. The result is exact.
//
// With n beads of one necklace and s sides there are (n - 1) s certificates, all of which are made at the
// start of each step. At most s certificates on each level name a bead. An event costs one certificate at its
// node and at most one on each level above the node. A bead that is inserted, erased or changes course costs
// the contests on one path to the root, for each side. Memory grows with n s.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/base/radical.h"
#include "certificates/types/reaches_further.h"
#include "kds/structure_base.h"
#include "motions/curves/motion_ref.h"
#include "structures/hierarchy/bottom_up_order.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

template <int Dimension>
class SupportTables;

/// The numbers of directions that a hierarchy of boxes may have, ascending. In space 3, 7 or 13: the axes,
/// then the four diagonals through corners of a cube, then the six diagonals through its edges. In the plane
/// 2 or 4: the axes, then the two diagonals.
template <int Dimension>
[[nodiscard]] std::span<const int> box_direction_counts();

/// Returns the first `count` directions of the order above. Each is canonical. Throws std::invalid_argument
/// if `count` is none of box_direction_counts.
template <int Dimension>
[[nodiscard]] std::vector<SlabDirection> box_directions(int count);

template <int Dimension>
class BoxHierarchy final : public EditableBase {
  static_assert(Dimension == 2 || Dimension == 3);

 public:
  static constexpr int dimension = Dimension;

  /// Ids of `support`: the node's first and last bead, the side, the previous and the new support; no_bead
  /// stands for the support of a node whose beads are all absent. Ids of an edit: the bead; the changes of
  /// supports follow as separate changes.
  enum Kind : std::uint8_t { support_changes, inserts, erases, changes };

  /// Maintains all nodes and reports the selected ones. `radii` is a promise for all steps; if it promises
  /// equal radii, the motion may be lifted. `directions`: one of box_direction_counts. Throws
  /// std::invalid_argument if there is no such number of directions, or if the motion is lifted and radii are
  /// unequal.
  BoxHierarchy(Simulator& simulator, const MotionRef<Dimension>& motion, std::span<const BeadRange> necklaces,
               Radii radii, int directions = Dimension, const NodeSelection& selection = {});
  ~BoxHierarchy() override;

  [[nodiscard]] const NecklaceTree& tree() const { return tree_; }
  /// Returns whether the node is selected. Throws std::invalid_argument if there is no such node.
  [[nodiscard]] bool keeps(NodeId node) const;
  [[nodiscard]] std::span<const SlabDirection> directions() const { return directions_; }
  /// Returns the number of sides, two for each direction: side 2k is the low end of direction k, and side
  /// 2k+1 the high end.
  [[nodiscard]] std::uint32_t side_count() const {
    return static_cast<std::uint32_t>(2 * directions_.size());
  }
  /// Returns the supports of a selected node, one for each side. Each support is no_bead if all beads of the
  /// node are absent, and before the structure is built. Throws std::invalid_argument if there is no such
  /// node.
  [[nodiscard]] std::span<const BeadId> supports(NodeId node) const;

  /// From the next step on, notes the beads whose number of certificates may have grown (count_certificates).
  void follow_certificates() { follows_certificates_ = true; }
  /// Updates statistics.certificates.per_bead_max, the largest number of certificates on one bead. The start
  /// of a step needs no call. Costs O(height) per side for each support that has changed since the last call,
  /// and for each bead after an edit.
  void count_certificates();

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void after_batch() override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  class Contests;

  /// Returns the direction in which the ball of a support reaches furthest.
  [[nodiscard]] SlabDirection outward(std::uint32_t side) const;
  void release(std::span<const BeadId> beads) override;
  void follow(std::span<const BeadId> beads) override;
  void edit(std::uint8_t kind, BeadId bead) override;
  /// Notes that the supports of a node and of all nodes above it may have changed, for one side.
  void look_from(std::uint32_t node, std::uint32_t side);
  [[nodiscard]] std::uint64_t certificates_of(BeadId bead) const;

  MotionRef<Dimension> motion_;
  Radii radii_;
  std::vector<SlabDirection> directions_;
  NecklaceTree tree_;
  BottomUpOrder order_;
  std::vector<std::uint8_t> keeps_;     // one flag per node
  std::vector<std::uint32_t> parents_;  // of nodes, then of beads
  std::unique_ptr<SupportTables<Dimension>> tables_;
  std::unique_ptr<Contests> contests_;
  std::vector<BeadId> supports_;        // reported, at node * side_count() + side
  std::vector<std::uint32_t> changed_;  // indices in supports_ that may differ from the contests' winners
  bool follows_certificates_ = false;
  std::vector<BeadId> risen_;  // beads that may have more certificates than when they were last counted
};

static_assert(EditableStructure<BoxHierarchy<2>>);

extern template class BoxHierarchy<2>;
extern template class BoxHierarchy<3>;

}  // namespace kds
