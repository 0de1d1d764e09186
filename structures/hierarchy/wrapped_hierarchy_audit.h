#pragma once
// Kinetic wrapped hierarchy: replayed changes, and the bases of a frame proved by their definition.

#include "structures/hierarchy/wrapped_hierarchy.h"

namespace kds {

template <Motion M, Kernel K, Radii radii>
void WrappedHierarchy<M, K, radii>::apply(const Change& change) {
  if (change.size < 3 || change.size > 2 + full)
    throw std::invalid_argument("a basis has one to " + std::to_string(full) + " beads");
  const auto node = tree_.find({change.ids[0], change.ids[1]});
  if (!node) throw std::invalid_argument("the hierarchy has no such node");
  if (!keeps(*node)) throw std::invalid_argument("the hierarchy does not keep this node");
  const Basis basis(std::span(change.ids).subspan(2, change.size - 2U));
  for (const BeadId b : basis) {
    if (b < change.ids[0] || b > change.ids[1])
      throw std::invalid_argument("a basis bead is not of its node");
  }
  if (std::adjacent_find(basis.begin(), basis.end()) != basis.end())
    throw std::invalid_argument("a basis bead stands twice");
  nodes_[*node].basis = basis;
  resting_.forget(*node);
}

template <Motion M, Kernel K, Radii radii>
std::vector<Basis> WrappedHierarchy<M, K, radii>::bases_at(const Dyadic& time) const {
  const IntegerBalls<dimension> whole = integer_balls_at(motion_, time);
  std::vector<Basis> bases(nodes_.size());
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    if (keeps(id)) bases[id] = proper_part(nodes_[id].basis, whole);
  }
  return bases;
}

/// The sphere of a basis that encloses all beads and has no bead to spare is the minimum enclosing one, and
/// the only one: checking both on integers is as good as building it. Nothing of it comes from certificates.
template <Motion M, Kernel K, Radii radii>
std::optional<std::string> WrappedHierarchy<M, K, radii>::audit(const Dyadic& time) {
  const IntegerBalls<dimension> whole = integer_balls_at(motion_, time);
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    if (!keeps(id)) continue;
    const Basis basis = proper_part(nodes_[id].basis, whole);
    const std::string where = name_of(id) + " with basis " +
                              bead_names(std::span(nodes_[id].basis.begin(), nodes_[id].basis.end()));
    if (const auto bead = bead_outside(basis, tree_.range(id), whole))
      return where + ": bead " + std::to_string(*bead) + " sticks out";
  }
  return std::nullopt;
}

}  // namespace kds
