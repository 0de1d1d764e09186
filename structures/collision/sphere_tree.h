#pragma once
// The spheres of a hierarchy as a search over pairs of nodes wants them: beads are nodes too, and all lie in
// one flat array, each with its children.
//
// A sphere has the hierarchy's centre as it was rounded, and its radius is measured from there: the farthest
// point of a bead (wrapped) or of a child's sphere (layered), rounded up. So it holds all beads of the node,
// wherever rounding has put the centre, and spheres that are disjoint prove beads disjoint. Up to rounding it
// is the hierarchy's sphere. Where squares overflow the radius is infinite; where they underflow it is 2^-500
// too large: then spheres prove less, and beads themselves are looked at.

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
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 2> hierarchy_names{"wrapped", "layered"};

template <int Dimension>
struct TreeSphere {
  Point<Dimension> center;
  double radius;
  std::uint32_t left, right;  ///< of a bead itself
  BeadId first, last;

  [[nodiscard]] bool is_bead() const { return first == last; }
  [[nodiscard]] BeadId bead_count() const { return last - first + 1; }
};

template <int Dimension>
class SphereTree {
 public:
  SphereTree(Hierarchy kind, std::span<const BeadRange> necklaces);

  /// From scratch.
  void build(const Balls<Dimension>& balls);

  /// Nodes of the hierarchy, then all beads, in their order. A bead's sphere is the bead, exactly.
  [[nodiscard]] std::span<const TreeSphere<Dimension>> spheres() const { return spheres_; }
  /// Of each necklace.
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
