#include "structures/hierarchy/signs_just_after.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "structures/enclosing_sphere/basis.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

template <int Dimension>
struct SignsJustAfter<Dimension>::Sign {
  const SignsJustAfter& self;

  int operator()(const Orientation<Dimension>& c) const {
    return self.orientations_->sign_just_after(kernel(), c, self.simulator_.now(), self.stages_);
  }
  template <class Certificate>
  int operator()(const Certificate& c) const {
    const auto& failed = self.present;
    if (failed && failed->is_of(c)) return c.side() == failed->side ? -1 : 1;
    const CertificateSearch<Certificate>& search = self.tables_.template of<Certificate>().search();
    if constexpr (std::same_as<Certificate, typename PresentFailure<Dimension>::OfFull>) {
      if (kernel() == Kernel::filtered && failed && failed->shares_root_with(c)) {
        const int sign = search.sign_after_failure(c, *failed->of_full, self.simulator_.now(), self.stages_);
        if (sign != 0) return sign;
      }
    }
    return search.sign_just_after(kernel(), c, self.simulator_.now(), self.stages_);
  }
  [[nodiscard]] Kernel kernel() const { return self.simulator_.kernel(); }
};

template <int Dimension>
int SignsJustAfter<Dimension>::membership(const Basis& basis, BeadId bead, bool inside,
                                          int orientation) const {
  return MembershipSigns<Dimension, Sign>(curves_, radii_, {*this})
      .membership(basis, bead, inside, orientation);
}

template <int Dimension>
int SignsJustAfter<Dimension>::orientation(const Basis& basis) const {
  return MembershipSigns<Dimension, Sign>(curves_, radii_, {*this}).orientation(basis);
}

template class SignsJustAfter<2>;
template class SignsJustAfter<3>;

template <int Dimension>
std::optional<Basis> BasisRepair<Dimension>::basis_just_after(std::span<const BeadId> among, const Basis& old,
                                                              BeadId escaped) {
  if (radii_ == Radii::any) return BasisOfBalls(among, signs_).find();
  BasisHint hint{std::max<std::size_t>(1, old.size - 1U)};
  if (escaped != no_bead) hint = {old.size, escaped};  // it is outside the sphere of all others
  auto basis = basis_of_points(among, signs_, hint);
  return basis || escaped == no_bead ? basis : basis_of_points(among, signs_);
}

/// Returns the next basis when the bead's certificate fails now, if the sphere's path proves it.
template <int Dimension>
std::optional<Basis> BasisRepair<Dimension>::proved_next_basis(const Basis& old, BeadId bead) {
  if (old.contains(bead)) {  // it is inside the sphere of the other basis beads now
    const Basis rest = without(old, bead);
    return proofs_.proved_bases({&rest, 1}, no_bead) == 0 ? std::nullopt : std::optional(rest);
  }
  // The bead is outside the sphere of the others now. If their barycentric coordinates are positive and the
  // path's other conditions are proved, the bead's own coordinate is positive too.
  std::array<Basis, full> next;
  if (old.size < full) {
    next[0] = old;
    insert_bead(next[0], bead);
    return proofs_.proved_bases({next.data(), 1}, bead) == 0 ? std::nullopt : std::optional(next[0]);
  }
  for (std::size_t index = 0; index < full; ++index) {
    next[index] = old;
    erase_bead_at(next[index], index);
    insert_bead(next[index], bead);
  }
  const unsigned proved = proofs_.proved_bases(next, no_bead);
  for (std::size_t index = 0; index < full; ++index) {
    if ((proved >> index & 1U) != 0 &&
        is_inside(next[index], old.beads[index], orientation_of(next[index], signs_), signs_))
      return next[index];
  }
  return std::nullopt;
}

template <int Dimension>
Basis BasisRepair<Dimension>::next_basis(const Basis& old, BeadId bead, bool failed) {
  std::array<BeadId, Basis::max_size + 1> all{};
  std::copy(old.begin(), old.end(), all.begin());
  std::size_t count = old.size;
  const bool escaped = bead != no_bead && !old.contains(bead);
  if (escaped) {
    std::size_t index = count++;
    for (; index > 0 && all[index - 1] > bead; --index) all[index] = all[index - 1];
    all[index] = bead;
  }
  const auto among = std::span(all).first(count);
  std::optional<Basis> next;
  if (failed && proofs_.proves_bases()) next = proved_next_basis(old, bead);
  if (!next) next = basis_just_after(among, old, escaped ? bead : no_bead);
  if (!next) throw std::logic_error("no basis among beads " + bead_names(among));
  return *next;
}

template class BasisRepair<2>;
template class BasisRepair<3>;

}  // namespace kds
