#pragma once
// Finds the next basis of a node of a wrapped hierarchy when one of its certificates has failed. Uses proofs
// from the sphere's path or, if they do not decide, the signs just after the event.

#include <optional>

#include "certificates/types/radii.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/hierarchy/node_proofs.h"
#include "structures/hierarchy/signs_just_after.h"

namespace kds {

template <int Dimension>
class BasisRepair {
 public:
  /// If `relaxed`, a bead escapes only when it is out by a share of the radius.
  BasisRepair(Kernel kernel, Radii radii, bool relaxed, NodeProofs<Dimension>& proofs,
              SignsJustAfter<Dimension>& signs)
      : kernel_(kernel), radii_(radii), relaxed_(relaxed), proofs_(proofs), signs_(signs) {}

  /// Returns the basis, just after now, of the beads of `old`, one of which may be superfluous, and of
  /// `bead`. `bead` has escaped from the sphere of `old`, or is no_bead. `failed` tells that `bead` is the
  /// bead whose certificate fails now. Returns none only if doubles contradict themselves, which the kernel
  /// `fast` may do.
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
