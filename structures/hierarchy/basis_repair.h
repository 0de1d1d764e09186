#pragma once
// The next basis of a node of a wrapped hierarchy when one of its certificates has failed: by what the
// sphere's path proves, or by the signs just after.

#include <optional>

#include "certificates/types/radii.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/hierarchy/node_proofs.h"
#include "structures/hierarchy/signs_just_after.h"

namespace kds {

template <int Dimension>
class BasisRepair {
 public:
  /// `relaxed`: beads escape when they are out by a share of the radius.
  BasisRepair(Kernel kernel, Radii radii, bool relaxed, NodeProofs<Dimension>& proofs,
              SignsJustAfter<Dimension>& signs)
      : kernel_(kernel), radii_(radii), relaxed_(relaxed), proofs_(proofs), signs_(signs) {}

  /// The basis just after now of the beads of `old`, of which one may be to spare, and of a bead that has
  /// escaped from its sphere, or none. `failed`: the bead is the one whose certificate fails now. Nothing
  /// only where doubles contradict themselves, as those of `fast` may.
  [[nodiscard]] std::optional<Basis> next_basis(const Basis& old, BeadId bead, bool failed);

 private:
  static constexpr std::size_t full = Dimension + 1;

  [[nodiscard]] std::optional<Basis> proved_next_basis(const Basis& old, BeadId bead);
  [[nodiscard]] std::optional<Basis> basis_just_after(std::span<const BeadId> among, const Basis& old,
                                                      BeadId escaped);

  Kernel kernel_;
  Radii radii_;
  bool relaxed_;
  NodeProofs<Dimension>& proofs_;
  SignsJustAfter<Dimension>& signs_;
};

}  // namespace kds
