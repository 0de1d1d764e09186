#pragma once
// The spheres of a hierarchy in the form that a search over pairs of nodes needs. Beads are nodes too, and
// all nodes lie in one flat array, each with its children.
//
// A sphere has the hierarchy's rounded centre. The radius is measured from this centre to the farthest point
// of a bead (wrapped) or of a child's sphere (layered), and rounded up. The sphere therefore holds all beads
// of its node, however its centre was rounded, and disjoint spheres prove beads disjoint. Up to rounding it
// is the hierarchy's sphere. If squares overflow, the radius is infinite; if they underflow, it is 2^-500 too
// large. Then spheres prove less, and beads themselves are tested.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"

namespace kds {

enum class Hierarchy : std::uint8_t { wrapped, layered };
/// Names of the hierarchies, in the order of the enumerators.
inline constexpr std::array<std::string_view, 2> hierarchy_names{"wrapped", "layered"};

template <int Dimension>
struct TreeSphere {
  Point<Dimension> center;
  double radius;
  std::uint32_t left, right;  ///< children; a bead names itself
  BeadId first, last;

  [[nodiscard]] bool is_bead() const { return first == last; }
  [[nodiscard]] BeadId bead_count() const { return last - first + 1; }
};

template <int Dimension>
class SphereTree {
 public:
  SphereTree(Hierarchy kind, std::span<const BeadRange> necklaces);

  /// Builds the tree from scratch.
  void build(const Balls<Dimension>& balls);

  /// Returns the nodes of the hierarchy, then all beads, in their order. A bead's sphere is exactly the bead.
  [[nodiscard]] std::span<const TreeSphere<Dimension>> spheres() const { return spheres_; }
  /// The root of each necklace.
  [[nodiscard]] std::span<const std::uint32_t> roots() const { return roots_; }
  [[nodiscard]] BeadRange beads(std::uint32_t node) const {
    return {spheres_[node].first, spheres_[node].last};
  }

 private:
  void measure(const StaticWrappedHierarchy<Dimension>& hierarchy, const Balls<Dimension>& balls);
  void measure(const LayeredHierarchy<Dimension>& hierarchy, const Balls<Dimension>& balls);

  std::variant<StaticWrappedHierarchy<Dimension>, LayeredHierarchy<Dimension>> hierarchy_;
  std::vector<TreeSphere<Dimension>> spheres_;
  std::vector<std::uint32_t> roots_;
};

}  // namespace kds
